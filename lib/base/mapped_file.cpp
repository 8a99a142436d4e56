// SPDX-License-Identifier: Apache-2.0
#include "base/mapped_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

Expected<MappedFile> MappedFile::open(const std::string& path)
{
    const auto failure = [&](const std::string& why) { return Error{ "'" + path + "' " + why }; };
    // O_NONBLOCK: a FIFO must not hang us; it is refused below.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0)
        return failure(std::string("cannot be opened: ") + std::strerror(errno));
    struct stat info;
    void* data = MAP_FAILED;
    std::string why;
    if (::fstat(descriptor, &info) != 0)
        why = std::string("cannot be read: ") + std::strerror(errno);
    else if (!S_ISREG(info.st_mode))
        why = "is not a regular file";
    else if (info.st_size == 0)
        why = "is empty";
    else if ((data = ::mmap(nullptr, std::size_t(info.st_size), PROT_READ, MAP_SHARED, descriptor, 0)) == MAP_FAILED)
        why = std::string("cannot be mapped: ") + std::strerror(errno);
    ::close(descriptor);
    if (!why.empty())
        return failure(why);
    MappedFile file;
    file.m_data = static_cast<const char*>(data);
    file.m_size = std::size_t(info.st_size);
    return file;
}

MappedFile::~MappedFile()
{
    if (m_data)
        ::munmap(const_cast<char*>(m_data), m_size);
}

MappedFile::MappedFile(MappedFile&& other) noexcept
    : m_data(std::exchange(other.m_data, nullptr)), m_size(std::exchange(other.m_size, 0))
{
}

MappedFile& MappedFile::operator=(MappedFile&& other) noexcept
{
    std::swap(m_data, other.m_data);
    std::swap(m_size, other.m_size);
    return *this;
}

} // namespace srisp
