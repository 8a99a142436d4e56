// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <fstream>

#include "container/file_description.h"

namespace srisp {

namespace {

std::uint32_t read_number(std::ifstream& file, int bytes)
{
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i)
        value = value << 8 | (static_cast<std::uint32_t>(file.get()) & 0xff);
    return value;
}

} // namespace

/// Image resource 1057 says whether the merged picture is a real one; Photoshop may have been told to save none, and
/// then writes white.
void describe_psd(const std::string& path, OIIO::ImageSpec& spec)
{
    constexpr std::uint32_t version_info = 1057, resource_mark = 0x3842494d; // "8BIM"
    std::ifstream file(path, std::ios::binary);
    file.seekg(26);
    file.seekg(read_number(file, 4), std::ios::cur); // the palette
    const std::uint32_t length = read_number(file, 4);
    const std::streamoff end = std::streamoff(file.tellg()) + length;
    while (file && file.tellg() < end && read_number(file, 4) == resource_mark) {
        const std::uint32_t id = read_number(file, 2);
        const std::uint32_t name = read_number(file, 1);
        file.seekg(name | 1u, std::ios::cur); // with its length even
        const std::uint32_t size = read_number(file, 4);
        const std::streamoff data = file.tellg();
        if (id == version_info && size >= 5) {
            file.seekg(4, std::ios::cur);
            if (read_number(file, 1) == 0 && file)
                add_note(spec, "was saved without a merged picture (Photoshop: Maximize Compatibility); what is shown "
                               "may be blank");
            return;
        }
        file.seekg(data + std::streamoff(size) + (size & 1));
    }
}

} // namespace srisp
