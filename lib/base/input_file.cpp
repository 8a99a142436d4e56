// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <cerrno>
#include <cstring>

#include "base/regular_file.h"

namespace srisp {

Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where)
{
    const auto file = RegularFile::open(path);
    if (!file)
        return Error{ where + ": " +
                      (says_what_it_is(file.error()) ? "'" + path + "' " : "cannot open '" + path + "': ") +
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
    if (file->size() > most)
        return failed("has more than " + std::to_string(most) + " bytes");
    std::string text(file->size(), '\0');
    const long long count = file->read(text.data(), 0, text.size());
    if (count < 0)
        return failed(std::strerror(errno));
    text.resize(std::size_t(count));
    return text;
}

} // namespace srisp
