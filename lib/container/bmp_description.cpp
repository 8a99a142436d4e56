// SPDX-License-Identifier: Apache-2.0
#include <cstdint>
#include <fstream>

#include "container/file_description.h"

namespace srisp {

namespace {

// Offsets from the start of the file, whose header of 14 bytes comes before the picture's. [BITMAPV5HEADER]
constexpr std::size_t kFileHeader = 14, kSpaceAt = kFileHeader + 56, kEndpointsAt = kFileHeader + 60,
                      kGammasAt = kFileHeader + 96, kProfileAt = kFileHeader + 112, kHeadBytes = kFileHeader + 124;

std::uint32_t little_endian(const std::string& bytes, std::size_t at)
{
    std::uint32_t value = 0;
    for (int i = 3; i >= 0; --i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

std::string read_at(std::ifstream& file, std::size_t offset, std::size_t count)
{
    std::string bytes(count, '\0');
    file.clear();
    file.seekg(static_cast<std::streamoff>(offset));
    file.read(bytes.data(), static_cast<std::streamsize>(count));
    bytes.resize(static_cast<std::size_t>(file.gcount()));
    return bytes;
}

/// Primaries as XYZ whose sum is white, and one exponent for all channels; not used where they are empty.
void describe_calibration(const std::string& head, OIIO::ImageSpec& spec)
{
    std::array<float, 8> chromaticities{};
    double sum[3] = {};
    for (int color = 0; color < 3; ++color) {
        double xyz[3], total = 0;
        for (int i = 0; i < 3; ++i) {
            xyz[i] = little_endian(head, kEndpointsAt + color * 12 + i * 4) / double(1 << 30);
            total += xyz[i];
            sum[i] += xyz[i];
        }
        if (total <= 0)
            return;
        chromaticities[color * 2] = static_cast<float>(xyz[0] / total);
        chromaticities[color * 2 + 1] = static_cast<float>(xyz[1] / total);
    }
    const double total = sum[0] + sum[1] + sum[2];
    chromaticities[6] = static_cast<float>(sum[0] / total);
    chromaticities[7] = static_cast<float>(sum[1] / total);
    const std::uint32_t gamma = little_endian(head, kGammasAt + 4);
    if (gamma == 0)
        return;
    set_gamma(spec, gamma / 65536.0);
    set_chromaticities(spec, chromaticities);
}

} // namespace

void describe_bmp(const std::string& path, OIIO::ImageSpec& spec)
{
    constexpr std::uint32_t calibrated = 0, embedded = 0x4d424544; // "MBED"
    constexpr std::uint32_t kMostProfileBytes = 1 << 26;
    std::ifstream file(path, std::ios::binary);
    const std::string head = read_at(file, 0, kHeadBytes);
    if (head.size() < kHeadBytes)
        return;
    const std::uint32_t header_bytes = little_endian(head, kFileHeader);
    if (header_bytes >= 108 && little_endian(head, kSpaceAt) == calibrated)
        describe_calibration(head, spec);
    if (header_bytes < 124 || little_endian(head, kSpaceAt) != embedded)
        return;
    const std::size_t start = std::size_t(little_endian(head, kProfileAt)) + kFileHeader;
    const std::uint32_t size = little_endian(head, kProfileAt + 4);
    const std::string profile = size > kMostProfileBytes ? "" : read_at(file, start, size);
    if (profile.size() == size && size > 0)
        set_icc_profile(spec, profile.data(), profile.size());
    else
        add_note(spec, "its ICC profile is damaged; it was ignored");
}

} // namespace srisp
