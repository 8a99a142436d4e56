// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include <algorithm>
#include <filesystem>

#include <srisp/thumbnail.h>

#include "base/file_bytes.h"
#include "base/guarded.h"
#include "base/hashes.h"
#include "base/shown_text.h"
#include "container/image_file.h"
#include "raw_file/dng_head.h"
#include "recipe/reference_pattern.h"
#include "reference/decoders.h"
#include "reference/raw_reference.h"
#include "reference/reference_type.h"
#include "reference/sample_layout.h"
#include "reference/tiff_raw.h"

namespace srisp {

namespace {

// Below this a frame holds noise, which says nothing of the light.
constexpr float kDarkest = 0.005f;

/// By the 98th percentile of all values, the three channels together.
Status check_brightness(const Thumbnail& thumbnail)
{
    const std::vector<float>& all = thumbnail.rgb;
    const auto place = std::ptrdiff_t(double(all.size() - 1) * 0.98);
    if (std::count_if(all.begin(), all.end(), [](float v) { return v < kDarkest; }) <= place)
        return {};
    std::vector<float> values = all;
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return Error{ "is a black frame: 98 % of its values are at or below " +
                  shown_decimals(values[std::size_t(place)], 5) + ", the limit is " + shown_decimals(kDarkest, 3) };
}

/// All but name and path, from an EXR, or from a TIFF that srisp wrote. `format`: OpenImageIO's name.
Expected<Reference> load_linear(const std::string& path, const std::string& format)
{
    const auto image = read_linear_reference(path, format);
    if (!image)
        return image.error();
    const auto hash = hash_of_file(path);
    if (!hash)
        return hash.error();
    return Reference{ "", "", *hash, image->thumbnail, image->facts, image->notes };
}

/// From a TIFF without the extension of a RAW file.
Expected<Reference> load_tiff(const std::string& path, bool isolate)
{
    if (dng_head(path) == DngHead::yes)
        return load_raw(path, isolate);
    // A TIFF of ours is no RAW whatever LibRaw thinks.
    auto linear = load_linear(path, "tiff");
    if (linear)
        return linear;
    auto raw = load_raw(path, isolate);
    if (raw)
        return raw;
    const auto file = read_whole_file(path);
    return file && !tiff_raw_name(*file).empty() ? raw : linear;
}

/// Why a photo is refused.
Error refuse_photo(const FileType& type, const std::string& path)
{
    if (const auto file = ImageFile::open(path, {}, "reference"))
        if (const Status status = check_no_mosaic((*file)->spec()); !status)
            return status.error();
    return Error{ "is a " + type.name +
                  " file, which is display-encoded and cannot be a reference: give a RAW file (DNG, NEF, CR2, ...)" };
}

/// From plain samples that a file beside them describes.
Expected<Reference> load_samples(const std::string& path)
{
    const auto layout = needed_sample_layout(path);
    if (!layout)
        return layout.error();
    const auto raw = read_samples(path, *layout);
    return raw ? Expected<Reference>(reference_of(*raw)) : raw.error();
}

Expected<Reference> load_by_type(const FileType& type, const std::string& path, bool isolate)
{
    switch (type.kind) {
    case FileKind::display_encoded:
        return refuse_photo(type, path);
    case FileKind::foveon:
        return Error{ "Foveon sensor (three layers, no mosaic): not supported" };
    case FileKind::exr:
        return load_linear(path, "openexr");
    case FileKind::tiff:
        // Most RAW formats are TIFF inside, some (Canon 1D) even by name.
        return has_raw_extension(path) ? load_raw(path, isolate) : load_tiff(path, isolate);
    case FileKind::headerless:
        return load_samples(path);
    case FileKind::raw:
        break;
    }
    return load_raw(path, isolate);
}

} // namespace

Expected<std::shared_ptr<const Reference>> load_reference(const std::string& path, bool isolate)
{
    const auto fail = [&](const std::string& reason) { return Error{ "reference '" + path + "': " + reason }; };
    return guarded("reference", path, [&]() -> Expected<std::shared_ptr<const Reference>> {
        const auto type = reference_type(path);
        if (!type)
            return fail(type.error().message);
        auto reference = load_by_type(*type, path, isolate);
        if (!reference)
            return fail(reference.error().message);
        if (Status status = check_brightness(reference->thumbnail); !status)
            return fail(status.error().message);
        reference->path = path;
        reference->name = std::filesystem::path(path).filename().string();
        return std::make_shared<const Reference>(std::move(*reference));
    });
}

Expected<std::string> choose_reference(const std::vector<std::string>& patterns, std::uint64_t seed,
                                       const std::string& photo_name)
{
    return guarded("choosing a reference", {}, [&]() -> Expected<std::string> {
        const auto files = expand_references(patterns);
        if (!files)
            return files.error();
        const std::string name = std::filesystem::path(photo_name).filename().string();
        return (*files)[std::size_t(seeded_hash(seed, name) % files->size())];
    });
}

Expected<std::string> choose_reference(const std::string& pattern, std::uint64_t seed, const std::string& photo_name)
{
    return guarded("choosing a reference", {}, [&]() -> Expected<std::string> {
        const auto items = split_references(pattern);
        return items ? choose_reference(*items, seed, photo_name) : items.error();
    });
}

} // namespace srisp
