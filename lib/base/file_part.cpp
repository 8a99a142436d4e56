// SPDX-License-Identifier: Apache-2.0
#include "base/file_part.h"

#include <cerrno>
#include <cstring>

namespace srisp {

Expected<RegularFile> open_for_parts(const std::string& path)
{
    auto file = RegularFile::open(path);
    if (!file)
        return Error{ "'" + path + "' " + (says_what_it_is(file.error()) ? "" : "cannot be opened: ") +
                      file.error().message };
    return file->size() == 0 ? Expected<RegularFile>(Error{ "'" + path + "' is empty" }) : std::move(file);
}

Status read_bytes(const RegularFile& file, void* target, std::size_t offset, std::size_t size)
{
    const long long got = file.read(target, offset, size);
    if (got < 0)
        return Error{ std::string("cannot be read: ") + std::strerror(errno) };
    if (std::size_t(got) < size)
        return Error{ "was made shorter while it was read: it had " + std::to_string(file.size()) +
                      " bytes, and ends at " + std::to_string(offset + std::size_t(got)) };
    return {};
}

} // namespace srisp
