// SPDX-License-Identifier: Apache-2.0
#include "protocol.h"

#include <algorithm>

#include <OpenImageIO/strutil.h>

#include "container/image_memory.h"
#include "recipe/reference_pattern.h"

namespace srisp::tool {

std::vector<ListedFile> list_raw_files(const std::vector<std::string>& words)
{
    static const FileKind kind{ "RAW file", "RAW files", [](const std::filesystem::path& path) {
                                   return has_raw_extension(path.string()) ||
                                          OIIO::Strutil::iequals(path.extension().string(), ".exr");
                               } };
    return list_files(words, kind);
}

Pixels pixels_of_reference(const Reference& reference)
{
    const Thumbnail& thumbnail = reference.thumbnail;
    Pixels square(kThumbnailSize, kThumbnailSize);
    square.rgb = thumbnail.rgb;
    const CameraFacts& facts = reference.facts;
    if (facts.width < 1 || facts.height < 1)
        return square;
    const bool turned = facts.orientation > 4;
    const auto size =
        reduced_size(turned ? facts.height : facts.width, turned ? facts.width : facts.height, kThumbnailSize);
    return resized(square, size[0], size[1]);
}

Expected<RawPicture> load_raw_picture(const std::string& path, int longest, const AskForMemory& ask)
{
    // LibRaw's samples, its demosaiced image of four 16-bit values, a copy in OpenImageIO, and bands of floats.
    constexpr int kChannels = 3;
    const auto file = load_reference_cached(path);
    if (!file)
        return file.error();
    const std::uint64_t pixels = std::uint64_t((*file)->facts.width) * std::uint64_t((*file)->facts.height);
    if (const Status fits = check_memory(pixels, kChannels); !fits)
        return Error{ "reference '" + path + "': " + fits.error().message };
    ask(image_memory(pixels, kChannels));
    return load_raw_picture(path, longest);
}

} // namespace srisp::tool
