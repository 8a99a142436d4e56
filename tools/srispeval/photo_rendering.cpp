// SPDX-License-Identifier: Apache-2.0
#include "photo_rendering.h"

#include <algorithm>

#include "../common/temporary_folder.h"
#include "base/hashes.h"
#include "base/output_file.h"
#include "converter.h"
#include "reference/embedded_preview.h"
#include "rendering/test_rendering.h"

namespace srisp::tool {

namespace {

// What the numbers of one purpose are drawn for.
constexpr std::uint64_t kRenderingStream = 1, kCameraGainStream = 2;

Pixels our_own(const std::string& kind, const RawPicture& raw, const std::string& name, std::uint64_t seed)
{
    const RawScene scene{ raw.pixels.view(), raw.colors.white_balance, raw.colors.to_srgb };
    const Random random(seeded_hash(seed, name), kRenderingStream);
    TestRendering rendering;
    if (kind == "fixed") {
        rendering = fixed_rendering(scene);
    } else if (kind == "random") {
        rendering = random_rendering(scene, dnd_camera_to_rgb(), random);
    } else {
        const Random of_camera(seeded_hash(seed, raw.camera), kCameraGainStream);
        rendering = camera_rendering(scene, dnd_camera_to_rgb(), draw_camera_gain(of_camera), random);
    }
    Pixels photo(raw.pixels.width, raw.pixels.height);
    render(rendering, raw.pixels.view(), photo.mutable_view());
    return photo;
}

/// A JPEG that says how it is turned is; another lies as the sensor does.
Expected<Pixels> embedded_photo(const std::string& path, const RawPicture& raw)
{
    const auto jpeg = embedded_preview(path, true);
    if (!jpeg)
        return jpeg.error();
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "preview.jpg").string();
    if (const Status written = write_output_file(file, jpeg->data(), jpeg->size()); !written)
        return written.error();
    const int width = raw.pixels.width, height = raw.pixels.height, orientation = raw.orientation;
    auto upright = load_photo(file, width, height, 0);
    if (upright || orientation < 5)
        return upright;
    const auto stored = load_photo(file, height, width, 0);
    return stored ? oriented(*stored, orientation) : upright;
}

} // namespace

const std::vector<RenderingKind>& rendering_kinds()
{
    static const std::vector<RenderingKind> kinds{
        { "fixed", nullptr, "exposed afterwards to a fixed target, true white balance, sRGB's curve" },
        { "random", nullptr, "random white balance, exposure, matrix, gamma and tone curve" },
        { "camera", nullptr,
          "as cameras do it: one gain for each camera and one curve for each image, whatever the scene" },
        { "embedded", nullptr, "the JPEG that the camera put into its file" },
        { "libraw", nullptr, "LibRaw's own picture" },
        { "dcraw", "dcraw", "dcraw as it is" },
        { "rawtherapee", "rawtherapee-cli", "RawTherapee as it is" },
        { "darktable", "darktable-cli", "darktable as it is" },
    };
    return kinds;
}

const RenderingKind& rendering_kind(const std::string& name)
{
    return *std::find_if(rendering_kinds().begin(), rendering_kinds().end(),
                         [&](const RenderingKind& kind) { return kind.name == name; });
}

bool is_our_own(const RenderingKind& kind)
{
    const std::string name = kind.name;
    return name == "fixed" || name == "random" || name == "camera";
}

Expected<Pixels> photo_of_raw(const RenderingKind& kind, const std::string& path, const RawPicture& raw,
                              const std::string& name, std::uint64_t seed)
{
    const std::string wanted = kind.name;
    const int width = raw.pixels.width, height = raw.pixels.height;
    if (wanted == "embedded")
        return embedded_photo(path, raw);
    if (wanted == "libraw")
        return load_photo(path, width, height, 0);
    if (is_our_own(kind))
        return our_own(wanted, raw, name, seed);
    const TemporaryFolder folder;
    const auto photo = convert_raw(kind.program, path, folder.path());
    return photo ? load_photo(*photo, width, height, 0) : photo.error();
}

} // namespace srisp::tool
