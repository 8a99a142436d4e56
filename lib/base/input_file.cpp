// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

namespace srisp {

Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where)
{
    struct stat info;
    if (::stat(path.c_str(), &info) != 0)
        return Error{ where + ": cannot open '" + path + "': " + std::strerror(errno) };
    if (S_ISDIR(info.st_mode))
        return Error{ where + ": '" + path + "' is a folder, not a file" };
    std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file)
        return Error{ where + ": cannot open '" + path + "': " + std::strerror(errno) };
    if (static_cast<std::uint64_t>(info.st_size) > max_bytes)
        return Error{ where + ": file has " + std::to_string(info.st_size) + " bytes, limit " +
                      std::to_string(max_bytes) };
    std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (count != bytes.size())
        return Error{ where + ": read " + std::to_string(count) + " of " + std::to_string(bytes.size()) + " bytes" };
    return bytes;
}

Expected<std::string> read_text_file(const std::string& path, std::size_t most)
{
    const auto failed = [&](const std::string& reason) { return Error{ "'" + path + "': " + reason }; };
    const std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file)
        return failed(std::strerror(errno));
    std::string text(most + 1, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), file.get()));
    if (std::ferror(file.get()))
        return failed(std::strerror(errno));
    if (text.size() > most)
        return failed("has more than " + std::to_string(most) + " bytes");
    return text;
}

Expected<MappedFile> MappedFile::open(const std::string& path)
{
    const auto failure = [&](const std::string& reason) { return Error{ "'" + path + "' " + reason }; };
    const auto failed_call = [&](const char* doing) {
        return failure(std::string("cannot be ") + doing + ": " + std::strerror(errno));
    };
    // O_NONBLOCK: a FIFO must not hang us; it is refused below.
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor < 0)
        return failed_call("opened");
    const struct Closing {
        int descriptor;
        ~Closing() { ::close(descriptor); }
    } closing{ descriptor };
    struct stat info;
    if (::fstat(descriptor, &info) != 0)
        return failed_call("read");
    if (!S_ISREG(info.st_mode))
        return failure("is not a regular file");
    if (info.st_size == 0)
        return failure("is empty");
    void* const data = ::mmap(nullptr, std::size_t(info.st_size), PROT_READ, MAP_SHARED, descriptor, 0);
    if (data == MAP_FAILED)
        return failed_call("mapped");
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
