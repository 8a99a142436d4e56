// SPDX-License-Identifier: Apache-2.0
#include "base/shown_reason.h"

#include "base/shown_text.h"

namespace srisp {

std::string shown_reason(std::string reason)
{
    const std::string thrown = "std::bad_alloc"; // what OpenEXR says, and through it OpenImageIO
    if (const std::size_t at = reason.find(thrown); at != std::string::npos)
        reason.replace(at, thrown.size(), "not enough memory");
    reason.erase(reason.find_last_not_of(" \n") + 1);
    for (std::size_t at; (at = reason.find('\n')) != std::string::npos;)
        reason.replace(at, 1, "; ");
    return shown_text(reason, kLongestReason);
}

} // namespace srisp
