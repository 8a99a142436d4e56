// SPDX-License-Identifier: Apache-2.0
#include "packed_raws.h"

#include <algorithm>

#include "base/random.h"
#include "rendering/rendering_steps.h"
#include "rendering/test_rendering.h"

namespace srisp::tool {

namespace {

constexpr std::uint64_t kExposureStream = 0x7265616c; // that of the trainer's tests
constexpr double kLowestWide = 0.03, kLowestByEye = 0.15, kHighest = 1.25;

Matrix3 mean_of(const std::vector<Matrix3>& matrices)
{
    Matrix3 mean{};
    for (const Matrix3& matrix : matrices)
        for (std::size_t i = 0; i < mean.size(); ++i)
            mean[i] += matrix[i] / float(matrices.size());
    return mean;
}

/// Puts the 98th percentile of the pixels' largest channel at this level; 1 is where a sensor clips.
void expose(Pixels& pixels, double level)
{
    const float bright = quantile(
        of_pixels(pixels.view(), [](const Vector3& v) { return *std::max_element(v.begin(), v.end()); }), 0.98);
    const auto gain = float(level / std::max(double(bright), 1e-4));
    for (float& value : pixels.rgb)
        value = std::clamp(value * gain, 0.0f, 1.0f);
}

} // namespace

std::vector<std::size_t> packed_test_images(const TrainingPack& pack)
{
    const std::vector<PackEntry>& entries = pack.raws().entries;
    std::vector<std::size_t> whole;
    for (std::size_t i = 0; i < entries.size(); ++i)
        if (entries[i].validation && (i == 0 || entries[i - 1].scene != entries[i].scene))
            whole.push_back(i);
    return whole;
}

Expected<RawPicture> packed_raw_picture(const TrainingPack& pack, std::size_t entry, bool as_exposed_by_eye,
                                        std::uint64_t seed)
{
    const PackedImages& raws = pack.raws();
    const auto values = raws.image(entry);
    if (!values)
        return values.error();
    const PackEntry& facts = raws.entries[entry];
    RawPicture picture;
    picture.camera = facts.group;
    picture.pixels = Pixels(raws.size, raws.size);
    const std::size_t count = picture.pixels.rgb.size() / 3;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            picture.pixels.rgb[i * 3 + c] = float((*values)[c * count + i]) / 65535;
    Random random(seed, kExposureStream, entry);
    expose(picture.pixels, random.log_uniform(as_exposed_by_eye ? kLowestByEye : kLowestWide, kHighest));

    RawColors& colors = picture.colors;
    colors.white_balance = facts.white_balance;
    if (facts.white_balance[1] <= 0) {
        const auto means = picture.pixels.means();
        for (std::size_t c = 0; c < 3; ++c)
            colors.white_balance[c] = float(std::max(means[1], 1e-4) / std::max(means[c], 1e-4));
    }
    const bool is_known = std::any_of(facts.color.begin(), facts.color.end(), [](float v) { return v != 0; });
    colors.to_srgb = is_known ? facts.color : mean_of(dnd_camera_to_rgb());
    if (is_known)
        colors.to_xyz = product(kSrgbToXyz, product(colors.to_srgb, diagonal(colors.white_balance)));
    return picture;
}

} // namespace srisp::tool
