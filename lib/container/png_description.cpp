// SPDX-License-Identifier: Apache-2.0
#include <fstream>
#include <map>

#include "container/file_description.h"

namespace srisp {

namespace {

using Chunks = std::map<std::string, std::string>;

unsigned big_endian(const std::string& bytes, std::size_t at)
{
    unsigned value = 0;
    for (std::size_t i = at; i < at + 4; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[i]);
    return value;
}

/// The chunks that say something about the picture; the first of each kind. Pixels are passed over.
Chunks read_chunks(const std::string& path)
{
    constexpr unsigned kMostBytes = 1 << 24;
    std::ifstream file(path, std::ios::binary);
    file.seekg(8);
    Chunks chunks;
    for (std::string head(8, '\0'); file.read(head.data(), 8);) {
        const unsigned length = big_endian(head, 0);
        const std::string type = head.substr(4);
        if (type == "IEND" || length > 0x7fffffff)
            break;
        std::string data;
        if (type != "IDAT" && length <= kMostBytes) {
            data.resize(length);
            if (!file.read(data.data(), length))
                break;
            chunks.emplace(type, data);
            file.seekg(4, std::ios::cur); // the checksum
        } else {
            file.seekg(std::streamoff(length) + 4, std::ios::cur);
        }
    }
    return chunks;
}

const std::string* find_chunk(const Chunks& chunks, const char* type, std::size_t least_bytes)
{
    const auto found = chunks.find(type);
    return found == chunks.end() || found->second.size() < least_bytes ? nullptr : &found->second;
}

/// White, red, green, blue in the file; white is last in a spec.
std::array<float, 8> chromaticities_of(const std::string& chrm)
{
    std::array<float, 8> numbers;
    for (std::size_t i = 0; i < 8; ++i)
        numbers[(i + 6) % 8] = static_cast<float>(big_endian(chrm, i * 4) / 100000.0);
    return numbers;
}

} // namespace

/// In the order that the PNG specification (third edition, 4.3) gives them: cICP, iCCP, sRGB, gAMA and cHRM.
void describe_png(const std::string& path, OIIO::ImageSpec& spec)
{
    const Chunks chunks = read_chunks(path);
    const OIIO::ParamValue* icc = spec.find_attribute("ICCProfile");
    if (const std::string* cicp = find_chunk(chunks, "cICP", 4)) {
        const auto number = [&](std::size_t i) { return int(static_cast<unsigned char>((*cicp)[i])); };
        set_cicp(spec, { number(0), number(1), number(2), number(3) });
    } else if (icc) {
        const std::vector<unsigned char> profile(static_cast<const unsigned char*>(icc->data()),
                                                 static_cast<const unsigned char*>(icc->data()) + icc->type().size());
        set_icc_profile(spec, profile.data(), profile.size());
    } else if (find_chunk(chunks, "sRGB", 1)) {
        set_color_space(spec, "sRGB");
    } else {
        const std::string* gama = find_chunk(chunks, "gAMA", 4);
        if (gama && big_endian(*gama, 0) > 0)
            set_gamma(spec, 100000.0 / big_endian(*gama, 0));
        else
            set_color_space(spec, "sRGB");
        if (const std::string* chrm = find_chunk(chunks, "cHRM", 32))
            set_chromaticities(spec, chromaticities_of(*chrm));
    }
    if (find_chunk(chunks, "iCCP", 1) && !icc && !find_chunk(chunks, "cICP", 4))
        add_note(spec, "its ICC profile is damaged; it was ignored");
    if (const std::string* exif = find_chunk(chunks, "eXIf", 8))
        add_exif(spec, exif->data(), exif->size());
    if (find_chunk(chunks, "acTL", 8))
        add_note(spec, "is animated; the still picture in it was taken");
}

} // namespace srisp
