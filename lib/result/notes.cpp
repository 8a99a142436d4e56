// SPDX-License-Identifier: Apache-2.0
#include "result/notes.h"

#include <cstdio>
#include <mutex>
#include <set>

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

void print_notes(const std::string& image, const std::vector<std::string>& notes)
{
    constexpr std::size_t kMostRemembered = 10000;
    static std::mutex& mutex = *new std::mutex;
    static std::set<std::string>& printed = *new std::set<std::string>;
    const std::lock_guard<std::mutex> lock(mutex);
    if (printed.size() > kMostRemembered)
        printed.clear();
    for (const std::string& note : notes) {
        const std::string line = "srisp: note: " + image + ": " + note + "\n";
        if (printed.insert(line).second)
            std::fputs(line.c_str(), stderr);
    }
}

} // namespace srisp
