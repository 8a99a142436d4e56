// SPDX-License-Identifier: Apache-2.0
#include "result/recipe_source.h"

#include <filesystem>

#include <srisp/reference.h>

#include "base/file_bytes.h"
#include "container/own_dng.h"
#include "container/reader_name.h"
#include "result/camera_file.h"
#include "result/resized_source.h"

namespace srisp {

namespace {

/// Whether LibRaw reads a file that srisp did not write. What cannot be read is told by what opens it.
bool is_camera_file(const std::string& path)
{
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored))
        return false;
    const auto head = read_head(path, kReaderHeadBytes);
    if (!head || reader_name(*head, path) != kRawReader)
        return false;
    const auto own = find_own_dng(path, true);
    return own && !*own;
}

} // namespace

Expected<std::unique_ptr<PixelSource>> open_recipe_source(const Recipe& recipe, const OIIO::ImageSpec& config,
                                                          const MemoryImage* memory)
{
    const bool photo = recipe.direction == Direction::reverse &&
                       (recipe.action == Recipe::Action::apply || recipe.action == Recipe::Action::print);
    const std::string kind = photo ? "photo" : "image";
    const OIIO::ImageSpec hints = reading_hints(recipe, config);
    const bool camera = !memory && recipe.action == Recipe::Action::develop && is_camera_file(recipe.source);
    auto source = memory   ? open_memory_source(*memory, kind)
                  : camera ? open_camera_file(recipe.source, hints, recipe.isolate)
                           : open_file_source(recipe.source, kind, hints);
    const bool whole = recipe.resize.empty() && recipe.crop.empty();
    return whole || !source ? std::move(source) : resized_source(std::move(*source), recipe);
}

} // namespace srisp
