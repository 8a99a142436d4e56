// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <iterator>

#include <OpenImageIO/imageio.h>
#include <srisp/metadata.h>

#include "icc_profiles.h"
#include "scratch_folder.h"
#include "seed_folder.h"
#include "ultra_hdr_jpeg.h"

using namespace srisp;

namespace {

std::string bytes_of_file(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

/// A small picture in the format of the name's ending.
std::string made_image(const std::string& name, OIIO::TypeDesc type, OIIO::ImageSpec spec = OIIO::ImageSpec())
{
    const ScratchFolder scratch;
    const std::string path = scratch.path(name);
    spec.width = spec.full_width = 8;
    spec.height = spec.full_height = 6;
    spec.nchannels = 3;
    spec.set_format(type);
    spec.default_channel_names();
    std::vector<float> pixels;
    for (int i = 0; i < 8 * 6 * 3; ++i)
        pixels.push_back(float(i % 50) / 49);
    auto output = OIIO::ImageOutput::create(path);
    if (!output || !output->open(path, spec) || !output->write_image(OIIO::TypeFloat, pixels.data()) ||
        !output->close()) {
        std::fprintf(stderr, "%s cannot be written\n", name.c_str());
        std::exit(1);
    }
    return bytes_of_file(path);
}

OIIO::ImageSpec result_spec()
{
    OIIO::ImageSpec spec;
    Parameters parameters;
    parameters.model_name = "m";
    CameraFacts facts;
    facts.color_matrices = { { { 0.9f, -0.2f, -0.1f, -0.4f, 1.2f, 0.2f, -0.1f, 0.2f, 0.6f }, 21 } };
    record_result(spec, parameters, &facts, Direction::reverse);
    return spec;
}

void make_containers(const SeedFolder& seeds)
{
    const OIIO::ImageSpec result = result_spec();
    seeds.add("linear_reference", "half", made_image("a.exr", OIIO::TypeHalf));
    OIIO::ImageSpec zip = result;
    zip.attribute("compression", "zip");
    seeds.add("linear_reference", "result", made_image("a.exr", OIIO::TypeFloat, zip));
    seeds.add("linear_reference", "tiff", made_image("a.tif", OIIO::TypeUInt16, result));
    OIIO::ImageSpec raw = result;
    raw.attribute("compression", "none");
    seeds.add("linear_reference", "tiff_float", made_image("a.tif", OIIO::TypeFloat, raw));
    OIIO::ImageSpec colors;
    const auto profile = adobe_rgb();
    colors.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(profile.size())), profile.data());
    seeds.add("file_description", "png", made_image("a.png", OIIO::TypeUInt8, colors));
    seeds.add("file_description", "bmp", made_image("a.bmp", OIIO::TypeUInt8));
    seeds.add("file_description", "gif", made_image("a.gif", OIIO::TypeUInt8));
    seeds.add("file_description", "jpeg", made_image("a.jpg", OIIO::TypeUInt8));
    seeds.add("file_description", "psd",
              literal("8BPS\0\1\0\0\0\0\0\0\0\3\0\0\0\1\0\0\0\1\0\x8\0\3") +
                  literal("\0\0\0\0\0\0\0\x10"
                          "8BIM\4\xf\0\0\0\0\0\4abcd\0\0\0\0\0\0"));
    seeds.add("file_description", "heif",
              literal("\0\0\0\x18"
                      "ftypheic\0\0\0\0mif1heic\0\0\0\x28meta\0\0\0\0\0\0\0\x1c"
                      "iprp\0\0\0\x14ispe\0\0\0\0\0\0\0\x8\0\0\0\6"));
}

/// One of each kind, and what else is read with a photo.
void make_photos(const SeedFolder& seeds)
{
    OIIO::ImageSpec colors;
    const auto profile = adobe_rgb();
    colors.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(profile.size())), profile.data());
    colors.attribute("Orientation", 6);
    colors.attribute("Exif:FNumber", 2.8f);
    for (const char* ending : { "bmp", "dpx", "avif", "fits", "gif", "hdr", "heic", "ico", "iff", "jp2", "jpg", "png",
                                "ppm", "rla", "sgi", "tga", "webp" })
        seeds.add("photo", ending, made_image(std::string("a.") + ending, OIIO::TypeUInt8, colors));
    for (const char* compression : { "none", "lzw", "zip", "packbits", "jpeg" }) {
        OIIO::ImageSpec spec;
        spec.attribute("compression", compression);
        seeds.add("photo", std::string("tif_") + compression, made_image("a.tif", OIIO::TypeUInt8, spec));
    }
    for (const char* compression : { "none", "rle", "zip", "piz", "pxr24", "b44", "dwaa" }) {
        OIIO::ImageSpec spec;
        spec.attribute("compression", compression);
        seeds.add("photo", std::string("exr_") + compression, made_image("a.exr", OIIO::TypeHalf, spec));
    }
    UltraHdrJpeg gain_map;
    gain_map.width = gain_map.map_width = 8;
    gain_map.height = gain_map.map_height = 8;
    seeds.add("photo", "gain_map", gain_map.bytes());
    seeds.add("photo", "progressive",
              jpeg_of(32, 24, 3, [](int x, int y, int c) { return (x * 7 + y * 3 + c * 50) % 256; }));
}

void make_profiles(const SeedFolder& seeds)
{
    const auto add = [&](const char* name, char kind, const std::vector<unsigned char>& bytes) {
        seeds.add("icc", name, std::string(1, kind) + std::string(bytes.begin(), bytes.end()));
    };
    add("adobe", 'c', adobe_rgb());
    add("grey", 'g', grey_gamma(2.2));
    add("srgb", 'c', profile_bytes(cmsCreate_sRGBProfile()));
    add("lab", 'c', profile_bytes(cmsCreateLab4Profile(nullptr)));
    cmsHPROFILE device_link = cmsCreateBCHSWabstractProfile(3, 1, 1, 1, 1, 5000, 6000);
    add("abstract", 'c', profile_bytes(device_link));
}

void make_gain_maps(const SeedFolder& seeds)
{
    UltraHdrJpeg plain, colors, iso, index_only, container_only;
    for (UltraHdrJpeg* one : { &plain, &colors, &iso, &index_only, &container_only }) {
        one->width = one->map_width = 8;
        one->height = one->map_height = 8;
    }
    colors.map_channels = 3;
    colors.map_elements = "<hdrgm:Gamma><rdf:Seq><rdf:li>1</rdf:li><rdf:li>2</rdf:li><rdf:li>3</rdf:li></rdf:Seq>"
                          "</hdrgm:Gamma>";
    iso.map_iso = iso_segment(0x40, { 0, 1, 2, 1, 0, 1, 2, 1, 1, 1, 1, 64, 1, 64 });
    iso.map_has_xmp = false;
    index_only.has_container = false;
    index_only.big_endian = false;
    container_only.has_index = false;
    seeds.add("gain_map", "plain", plain.bytes());
    seeds.add("gain_map", "colors", colors.bytes());
    seeds.add("gain_map", "iso", iso.bytes());
    seeds.add("gain_map", "index", index_only.bytes());
    seeds.add("gain_map", "container", container_only.bytes());
    seeds.add("gain_map", "xmp", xmp_segment(plain.map_attributes, colors.map_elements).substr(29));
    seeds.add("gain_map", "iso_metadata", iso.map_iso);
}

} // namespace

void make_image_seeds(const SeedFolder& seeds)
{
    make_containers(seeds);
    make_photos(seeds);
    make_profiles(seeds);
    make_gain_maps(seeds);
}
