// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <sys/mman.h>

#include "base/regular_file.h"

namespace srisp {

/// Whether RegularFile says what the thing is, rather than what the system said.
static bool is_kind(const Error& error)
{
    return error.message.rfind("is ", 0) == 0;
}

Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where)
{
    const auto file = RegularFile::open(path);
    if (!file)
        return Error{ where + ": " + (is_kind(file.error()) ? "'" + path + "' " : "cannot open '" + path + "': ") +
                      file.error().message };
    if (file->size() > max_bytes)
        return Error{ where + ": file has " + std::to_string(file->size()) + " bytes, limit " +
                      std::to_string(max_bytes) };
    std::string bytes(file->size(), '\0');
    const long long count = file->read(bytes.data(), 0, bytes.size());
    if (count < 0)
        return Error{ where + ": cannot be read: " + std::strerror(errno) };
    if (std::size_t(count) != bytes.size())
        return Error{ where + ": read " + std::to_string(count) + " of " + std::to_string(bytes.size()) + " bytes" };
    return bytes;
}

Expected<std::string> read_text_file(const std::string& path, std::size_t most)
{
    const auto failed = [&](const std::string& reason) { return Error{ "'" + path + "': " + reason }; };
    const auto file = RegularFile::open(path);
    if (!file)
        return failed(file.error().message);
    std::string text(most + 1, '\0');
    const long long count = file->read(text.data(), 0, text.size());
    if (count < 0)
        return failed(std::strerror(errno));
    text.resize(std::size_t(count));
    if (text.size() > most)
        return failed("has more than " + std::to_string(most) + " bytes");
    return text;
}

Expected<MappedFile> MappedFile::open(const std::string& path)
{
    const auto failure = [&](const std::string& reason) { return Error{ "'" + path + "' " + reason }; };
    const auto opened = RegularFile::open(path);
    if (!opened)
        return failure((is_kind(opened.error()) ? "" : "cannot be opened: ") + opened.error().message);
    if (opened->size() == 0)
        return failure("is empty");
    void* const data = ::mmap(nullptr, opened->size(), PROT_READ, MAP_SHARED, opened->descriptor(), 0);
    if (data == MAP_FAILED)
        return failure(std::string("cannot be mapped: ") + std::strerror(errno));
    MappedFile file;
    file.m_data = static_cast<const char*>(data);
    file.m_size = opened->size();
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
