// SPDX-License-Identifier: Apache-2.0
#include "result/notes.h"

namespace srisp {

std::vector<std::string> notes_of(const PhotoCounts& counts)
{
    std::vector<std::string> notes;
    const std::string of_all = " of " + std::to_string(counts.values) + " colour values ";
    if (counts.clipped)
        notes.push_back(std::to_string(counts.clipped) + of_all + "lay outside sRGB's 0 to 1 and were clipped");
    if (counts.replaced)
        notes.push_back(std::to_string(counts.replaced) + of_all + "were not numbers and became 0");
    return notes;
}

} // namespace srisp
