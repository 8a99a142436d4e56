// SPDX-License-Identifier: Apache-2.0
#include "result/camera_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <srisp/metadata.h>
#include <srisp/reference.h>

#include "camera/camera_color.h"
#include "container/file_description.h"
#include "container/own_dng_input.h"
#include "record/record.h"

namespace srisp {

namespace {

/// By what LibRaw multiplies R, G and B.
using Scales = std::array<float, 3>;

/// White balance, as shot or else for daylight, without which it would not demosaic well; limited to what light can ask
/// for.
Scales balance_of(const CameraFacts& facts)
{
    constexpr float kMost = 16;
    const bool as_shot = facts.as_shot_neutral[1] > 0;
    const std::array<float, 3> neutral =
        as_shot || !has_camera_color(facts) ? facts.as_shot_neutral : neutral_under(facts, kD65);
    Scales balance{ 1, 1, 1 };
    for (std::size_t c = 0; c < 3; ++c)
        if (neutral[c] > 0 && std::isfinite(neutral[c]))
            balance[c] = std::clamp(1 / neutral[c], 1 / kMost, kMost);
    return balance;
}

/// Asks LibRaw for linear camera RGB, balanced; returns what undoes that.
Scales ask_for_camera_rgb(const CameraFacts& facts, OIIO::ImageSpec& hints)
{
    const Scales balance = balance_of(facts);
    FilterFactors ranges{}, factors{};
    for (std::size_t i = 0; i < ranges.size(); ++i)
        ranges[i] = facts.white_level - facts.black_level[i];
    const float widest = *std::max_element(ranges.begin(), ranges.end());
    for (std::size_t i = 0; i < factors.size(); ++i)
        factors[i] = balance[i == 3 ? 1 : i] * widest / ranges[i];
    // LibRaw divides the factors by the least of them, and clips at the level that it is told: so much higher, nothing
    // is clipped.
    const auto [least, most] = std::minmax_element(factors.begin(), factors.end());
    const float level = std::round(widest * *most / *least);
    ask_for_linear_rgb("AHD", int(level), factors, hints);
    const float scale = level * *least / widest;
    return { scale / balance[0], scale / balance[1], scale / balance[2] };
}

class CameraFile : public PixelSource {
public:
    CameraFile(std::unique_ptr<PixelSource> file, std::shared_ptr<const Reference> camera, const Scales& scales)
        : m_file(std::move(file)), m_camera(std::move(camera)), m_scales(scales)
    {
    }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        auto spec = m_file->find_level(subimage, miplevel);
        if (!spec)
            return spec;
        const CameraFacts& facts = m_camera->facts;
        spec->set_format(OIIO::TypeFloat);
        spec->attribute("Orientation", facts.orientation);
        set_color_space(*spec, kCameraColorSpace);
        write_camera(*spec, facts);
        if (facts.as_shot_neutral[1] > 0)
            spec->attribute(attribute::kNeutral, OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 3),
                            facts.as_shot_neutral.data());
        m_values = std::size_t(spec->width) * std::size_t(spec->nchannels);
        m_channels = std::size_t(spec->nchannels);
        return spec;
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        const Status read = m_file->read_rows(subimage, miplevel, y0, y1, rows);
        if (read && m_channels == 3)
            for (std::size_t i = 0; i < m_values * std::size_t(y1 - y0); ++i)
                rows[i] *= m_scales[i % 3];
        return read;
    }

    const std::string& name() const override { return m_file->name(); }
    const std::string& key() const override { return m_file->key(); }
    const std::vector<std::string>& notes() const override { return m_camera->notes; }

private:
    std::unique_ptr<PixelSource> m_file;
    std::shared_ptr<const Reference> m_camera;
    Scales m_scales;
    std::size_t m_values = 0, m_channels = 0; ///< of a row, of a pixel
};

} // namespace

Expected<std::unique_ptr<PixelSource>> open_camera_file(const std::string& path, const OIIO::ImageSpec& config,
                                                        bool isolate)
{
    const std::string where = "image '" + path + "': ";
    auto camera = load_reference_cached(path, isolate);
    if (!camera)
        return Error{ camera.error().message };
    const CameraFacts& facts = (*camera)->facts;
    if (!facts.has_integer_levels())
        return Error{ where +
                      "is a RAW file that LibRaw does not develop (its levels are no integers of 8 to 16 bits)" };
    OIIO::ImageSpec hints = config;
    const Scales scales = ask_for_camera_rgb(facts, hints);
    auto file = open_file_source(path, "image", hints);
    if (!file)
        return file.error();
    return std::unique_ptr<PixelSource>(std::make_unique<CameraFile>(std::move(*file), std::move(*camera), scales));
}

} // namespace srisp
