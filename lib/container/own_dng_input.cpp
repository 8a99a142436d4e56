// SPDX-License-Identifier: Apache-2.0
#include "container/own_dng_input.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <OpenImageIO/strutil.h>
#include <srisp/metadata.h>

#include "container/file_description.h"
#include "record/record.h"

namespace srisp {

namespace {

/// A TIFF file as if another of its folders were the first.
class FolderFile final : public OIIO::Filesystem::IOFile {
public:
    FolderFile(const std::string& path, std::uint32_t folder) : IOFile(path, Read)
    {
        char order = 0;
        IOFile::pread(&order, 1, 0);
        for (int i = 0; i < kOffsetBytes; ++i)
            m_offset[order == 'I' ? i : kOffsetBytes - 1 - i] = static_cast<unsigned char>(folder >> 8 * i);
    }

    std::size_t read(void* buffer, std::size_t size) override
    {
        const std::int64_t at = tell();
        return patched(buffer, IOFile::read(buffer, size), at);
    }
    std::size_t pread(void* buffer, std::size_t size, std::int64_t at) override
    {
        return patched(buffer, IOFile::pread(buffer, size, at), at);
    }

private:
    static constexpr int kOffsetAt = 4, kOffsetBytes = 4; // in the header

    std::size_t patched(void* buffer, std::size_t size, std::int64_t at) const
    {
        for (int i = 0; i < kOffsetBytes; ++i) {
            const std::int64_t place = kOffsetAt + i - at;
            if (place >= 0 && place < std::int64_t(size))
                static_cast<unsigned char*>(buffer)[place] = m_offset[i];
        }
        return size;
    }

    unsigned char m_offset[kOffsetBytes];
};

} // namespace

void ask_for_linear_rgb(const char* demosaic, int level, const FilterFactors& factors, OIIO::ImageSpec& hints)
{
    auto& all = hints.extra_attribs;
    all.erase(std::remove_if(all.begin(), all.end(),
                             [](const auto& hint) { return OIIO::Strutil::istarts_with(hint.name(), "raw:"); }),
              all.end());
    hints.attribute("raw:ColorSpace", "raw");
    hints.attribute("raw:use_camera_wb", 0);
    hints.attribute("raw:use_camera_matrix", 0);
    hints.attribute("raw:user_flip", 0);
    hints.attribute("raw:Demosaic", demosaic);
    hints.attribute("raw:user_sat", level);
    hints.attribute("raw:user_mul", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, int(factors.size())), factors.data());
}

void ask_for_camera_rgb(const OwnDng& dng, OIIO::ImageSpec& hints)
{
    // LibRaw scales all by one range, that of its level.
    const float widest = *std::max_element(dng.ranges.begin(), dng.ranges.end());
    FilterFactors factors{};
    for (std::size_t i = 0; i < factors.size(); ++i)
        factors[i] = widest / dng.ranges[i];
    // The others of LibRaw weigh differences of colours, which are right in balanced images only; this one, ratios.
    ask_for_linear_rgb("DHT", int(std::lround(widest)), factors, hints);
}

std::unique_ptr<OIIO::Filesystem::IOProxy> ask_for_main_image(const OwnDng& dng, const std::string& path,
                                                              OIIO::ImageSpec& hints)
{
    std::unique_ptr<OIIO::Filesystem::IOProxy> file = std::make_unique<FolderFile>(path, dng.image_folder);
    OIIO::Filesystem::IOProxy* const pointer = file.get();
    hints.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &pointer);
    return file;
}

void describe_own_dng(const OwnDng& dng, OIIO::ImageSpec& spec)
{
    spec.attribute("ImageDescription", dng.description);
    spec.attribute("Orientation", dng.facts.orientation);
    CameraFacts facts = dng.facts;
    if (facts.as_shot_neutral[1] > 0)
        spec.attribute(attribute::kNeutral, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3), facts.as_shot_neutral.data());
    facts.as_shot_neutral = {}; // what follows is of the reference, not of the scene
    facts.noise_profile.clear();
    write_camera(spec, facts);
    set_color_space(spec, kCameraColorSpace);
}

} // namespace srisp
