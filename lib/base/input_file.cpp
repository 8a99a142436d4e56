// SPDX-License-Identifier: Apache-2.0
#include "base/input_file.h"

#include <algorithm>
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
    // Room for one byte more than there are; files of /proc say that they have none.
    constexpr std::size_t kLeastRoom = 4096;
    std::string text(std::min(std::max(file->size(), kLeastRoom), most) + 1, '\0');
    for (std::size_t got = 0; got < text.size();) {
        const long long count = file->read(text.data() + got, got, text.size() - got);
        if (count < 0)
            return failed(std::strerror(errno));
        got += std::size_t(count);
        const bool more = got == text.size() && got <= most;
        text.resize(more ? std::min(2 * got, most) + 1 : got);
    }
    if (text.size() > most)
        return failed("has more than " + std::to_string(most) + " bytes");
    return text;
}

} // namespace srisp
