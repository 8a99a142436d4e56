// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdint>
#include <ctime>
#include <string>

#include "fuzz_target.h"

namespace srisp::fuzz {

/// A file in memory, for readers that take a path. One for each process, whose bytes are replaced.
class MemoryFile {
public:
    MemoryFile() : m_file(::memfd_create("input", MFD_CLOEXEC))
    {
        must_hold(m_file >= 0, "a file in memory can be made");
    }
    ~MemoryFile() { ::close(m_file); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    /// The path of the file, which holds just these bytes now. Its time is another each time, as that of a file which
    /// was replaced: readers keep what they know of a file as long as that stays (file_state).
    const std::string& holding(const std::uint8_t* data, std::size_t size)
    {
        const timespec times[2] = { { 0, UTIME_OMIT }, { ++m_second, 0 } };
        const bool written = ::ftruncate(m_file, 0) == 0 && ::pwrite(m_file, data, size, 0) == ssize_t(size) &&
                             ::futimens(m_file, times) == 0;
        must_hold(written, "a file in memory can be written");
        return m_path;
    }
    const std::string& holding(const std::string& bytes)
    {
        return holding(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    }

private:
    int m_file;
    std::time_t m_second = 0;
    std::string m_path = "/proc/self/fd/" + std::to_string(m_file);
};

} // namespace srisp::fuzz
