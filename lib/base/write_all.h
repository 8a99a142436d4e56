// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cerrno>
#include <string_view>

#include <sys/types.h>

namespace srisp {

/// Writes all bytes by calls that may write fewer, or be interrupted: write(data, size) as write(2). False: it failed,
/// and errno says why.
template<class Write> bool write_all(std::string_view bytes, const Write& write)
{
    while (!bytes.empty()) {
        const ssize_t count = write(bytes.data(), bytes.size());
        if (count < 0 && errno != EINTR)
            return false;
        if (count > 0)
            bytes.remove_prefix(std::size_t(count));
    }
    return true;
}

} // namespace srisp
