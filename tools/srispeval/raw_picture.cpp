// SPDX-License-Identifier: Apache-2.0
#include "raw_picture.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/strutil.h>
#include <srisp/srisp.h>

#include "camera/camera_color.h"
#include "recipe/recipe.h"
#include "result/recipe_source.h"

namespace srisp::tool {

namespace {

constexpr double kShapeTolerance = 0.02; // cameras and converters cut some pixels off

/// The size of an upright image whose stored size this is.
std::array<int, 2> upright_size(std::array<int, 2> size, int orientation)
{
    return orientation > 4 ? std::array<int, 2>{ size[1], size[0] } : size;
}

} // namespace

std::string camera_name(const CameraFacts& facts)
{
    if (facts.make.empty() && facts.model.empty())
        return "unknown camera";
    if (facts.make.empty() || OIIO::Strutil::istarts_with(facts.model, facts.make))
        return facts.model;
    return facts.model.empty() ? facts.make : facts.make + " " + facts.model;
}

RawColors colors_of(const CameraFacts& facts, const std::array<double, 3>& means)
{
    RawColors colors;
    colors.white_balance = white_balance_of(facts, means);
    colors.to_srgb = balanced_to_srgb(facts);
    if (const auto* matrix = facts.daylight_matrix(); matrix && has_camera_color(facts))
        colors.to_xyz = inverse(matrix->xyz_to_camera);
    return colors;
}

Expected<RawPicture> load_raw_picture(const std::string& path, int longest)
{
    RawPicture picture;
    const auto file = load_reference_cached(path);
    if (!file)
        return file.error();
    picture.camera = camera_name((*file)->facts);
    picture.orientation = (*file)->facts.orientation;
    picture.notes = (*file)->notes;
    Recipe recipe;
    recipe.source = path;
    recipe.action = Recipe::Action::develop; // a camera's file comes demosaiced, and not as a photo
    const auto source = open_recipe_source(recipe, {}, nullptr);
    if (!source)
        return source.error();
    const auto spec = (*source)->find_level(0, 0);
    if (!spec || spec->nchannels < 3)
        return Error{ (*source)->name() + ": has no R, G, B" };
    const auto size = reduced_size(spec->width, spec->height, longest);
    AreaReducer reducer(spec->width, spec->height, size[0], size[1]);
    const int band = std::max(1, (1 << 20) / spec->width);
    std::vector<float> rows;
    for (int y = 0; y < spec->height; y += band) {
        const int end = std::min(y + band, spec->height);
        rows.resize(std::size_t(end - y) * std::size_t(spec->width) * std::size_t(spec->nchannels));
        if (const Status read = (*source)->read_rows(0, 0, y, end, rows.data()); !read)
            return read.error();
        for (float& value : rows)
            value = std::clamp(value, 0.0f, 1.0f);
        reducer.add_rows(rows.data(), end - y, spec->nchannels);
    }
    picture.pixels = oriented(reducer.take(), spec->get_int_attribute("Orientation", 1));
    picture.colors = colors_of((*file)->facts, picture.pixels.means());
    return picture;
}

Expected<Pixels> load_photo(const std::string& path, int width, int height, int longest)
{
    std::optional<AreaReducer> reducer;
    int channels = 0, orientation = 1;
    ImageSink sink;
    sink.begin = [&](const OIIO::ImageSpec& spec) -> Status {
        channels = spec.nchannels;
        orientation = spec.get_int_attribute("Orientation", 1);
        const auto whole = upright_size({ spec.width, spec.height }, orientation);
        const double shape = double(whole[0]) / whole[1];
        if (width > 0 && std::fabs(shape * height / width - 1) > kShapeTolerance)
            return Error{ "photo '" + path + "': has another shape than its RAW image: " + std::to_string(whole[0]) +
                          " x " + std::to_string(whole[1]) + " against " + std::to_string(width) + " x " +
                          std::to_string(height) };
        const auto wanted = width > 0 ? std::array<int, 2>{ width, height } : reduced_size(whole[0], whole[1], longest);
        const auto stored = upright_size(wanted, orientation);
        reducer.emplace(spec.width, spec.height, stored[0], stored[1]);
        return {};
    };
    sink.rows = [&](const float* rows, int count) -> Status {
        reducer->add_rows(rows, count, channels);
        return {};
    };
    Options options;
    options.threads = 1;
    if (const Status read = read_photo(path, options, sink); !read)
        return read.error();
    return oriented(reducer->take(), orientation);
}

} // namespace srisp::tool
