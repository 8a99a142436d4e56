// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include <srisp/expected.h>

namespace srisp {

/// Whether a name is a URL ("http://…"), which nothing here opens: we read files.
bool is_url(std::string_view name);

constexpr char kIsUrl[] = "is a URL; only files are read", kIsFolder[] = "is a folder, not a file",
               kIsNoRegularFile[] = "is not a regular file";

/// Whether an error of RegularFile::open says what the thing is ("is a folder…"), rather than what the system said.
bool says_what_it_is(const Error& error);

/// A regular file, open for reading; closes itself. All files that we read ourselves are opened here, so that a FIFO or
/// a device hangs nothing.
class RegularFile {
public:
    /// Errors, without the file's name: one of the texts above, or what the system says.
    static Expected<RegularFile> open(const std::string& path);
    RegularFile(RegularFile&& other) noexcept;
    RegularFile& operator=(RegularFile&& other) noexcept;
    ~RegularFile();

    int descriptor() const { return m_descriptor; }
    /// As it was opened.
    std::size_t size() const { return m_size; }
    /// Reads from `offset` until `size` bytes or the end; the number read, or -1 (errno). Threads: safe.
    long long read(void* target, std::size_t offset, std::size_t size) const;

private:
    explicit RegularFile(int descriptor) : m_descriptor(descriptor) {}

    int m_descriptor;
    std::size_t m_size = 0;
};

} // namespace srisp
