// SPDX-License-Identifier: Apache-2.0
#include "base/regular_file.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

bool is_url(std::string_view name)
{
    const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
    const auto may_follow = [&](char c) {
        return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.';
    };
    const std::string_view scheme = name.substr(0, name.find("://"));
    return scheme.size() < name.size() && !scheme.empty() && is_letter(scheme[0]) &&
           std::all_of(scheme.begin(), scheme.end(), may_follow);
}

bool says_what_it_is(const Error& error)
{
    return error.message.rfind("is ", 0) == 0;
}

Expected<RegularFile> RegularFile::open(const std::string& path)
{
    if (is_url(path))
        return Error{ kIsUrl };
    // O_NONBLOCK: a FIFO without a writer must not hang us; it is refused below.
    RegularFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    struct stat status;
    if (file.m_descriptor < 0 || ::fstat(file.m_descriptor, &status) != 0)
        return Error{ std::strerror(errno) };
    if (S_ISDIR(status.st_mode))
        return Error{ kIsFolder };
    if (!S_ISREG(status.st_mode))
        return Error{ kIsNoRegularFile };
    file.m_size = std::size_t(status.st_size);
    return file;
}

RegularFile::RegularFile(RegularFile&& other) noexcept
    : m_descriptor(std::exchange(other.m_descriptor, -1)), m_size(other.m_size)
{
}

RegularFile& RegularFile::operator=(RegularFile&& other) noexcept
{
    std::swap(m_descriptor, other.m_descriptor);
    std::swap(m_size, other.m_size);
    return *this;
}

RegularFile::~RegularFile()
{
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

long long RegularFile::read(void* target, std::size_t offset, std::size_t size) const
{
    std::size_t done = 0;
    while (done < size) {
        const ssize_t n = ::pread(m_descriptor, static_cast<char*>(target) + done, size - done, off_t(offset + done));
        if (n < 0 && errno == EINTR)
            continue;
        if (n < 0)
            return -1;
        if (n == 0)
            break;
        done += std::size_t(n);
    }
    return static_cast<long long>(done);
}

} // namespace srisp
