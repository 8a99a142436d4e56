// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <filesystem>

#include <OpenImageIO/strutil.h>

#include "../common/csv_table.h"
#include "../common/failure.h"
#include "base/shown_text.h"
#include "protocol.h"

namespace srisp::tool {

namespace {

/// A line of the table.
struct Pair {
    std::string photo, raw, reference; ///< paths
    std::string name;                  ///< of the photo, as the table has it
    std::string rendering;
};

Expected<TestImages> load_pair(const Pair& pair, const EvalOptions& options, const AskForMemory& ask)
{
    const auto reference = load_reference_cached(pair.reference);
    if (!reference)
        return reference.error();
    auto truth = load_raw_picture(pair.raw, options.size, ask);
    if (!truth)
        return truth.error();
    TestImage image;
    auto photo = load_photo(pair.photo, truth->pixels.width, truth->pixels.height, 0);
    if (!photo)
        return photo.error();
    image.photo = std::move(*photo);
    image.truth = std::move(truth->pixels);
    image.reference = pixels_of_reference(**reference);
    // Colours are those of the camera that is imitated; what is white, the scene says.
    image.colors = colors_of((*reference)->facts, image.reference.means());
    image.colors.white_balance = truth->colors.white_balance;
    image.score.image = pair.name;
    image.score.rendering = pair.rendering;
    image.score.camera = camera_name((*reference)->facts);
    image.score.reference = (*reference)->name;
    image.score.notes = (*reference)->notes;
    TestImages result;
    result.images.push_back(std::move(image));
    return result;
}

/// "RAW" and " raw" are "raw".
std::string plain(const std::string& name)
{
    return OIIO::Strutil::lower(OIIO::Strutil::strip(name));
}

std::vector<Pair> read_pairs(const std::string& path)
{
    CsvTable table = read_csv(path);
    std::transform(table.columns.begin(), table.columns.end(), table.columns.begin(), plain);
    const auto column = [&](const std::string& name, bool needed) {
        const auto found = std::find(table.columns.begin(), table.columns.end(), name);
        if (found == table.columns.end() && needed)
            fail("'" + shown_text(path) + "' has no column '" + name + "'; it needs photo,raw,reference");
        return std::size_t(found - table.columns.begin());
    };
    for (const std::string& name : table.columns)
        if (name != "photo" && name != "raw" && name != "reference" && name != "rendering")
            fail("'" + shown_text(path) + "' has an unknown column '" + shown_text(name) +
                 "'; known: photo, raw, reference, rendering");
    const std::size_t photo = column("photo", true), raw = column("raw", true), reference = column("reference", true),
                      rendering = column("rendering", false);
    const std::filesystem::path folder = std::filesystem::path(path).parent_path();
    std::vector<Pair> pairs;
    const auto field = [](const auto& row, std::size_t at) {
        return at < row.size() ? std::string(OIIO::Strutil::strip(row[at])) : "";
    };
    for (const auto& row : table.rows) {
        const std::string name = field(row, photo), kind = field(row, rendering);
        pairs.push_back({ (folder / name).string(), (folder / field(row, raw)).string(),
                          (folder / field(row, reference)).string(), name, kind.empty() ? "photo" : kind });
    }
    if (pairs.empty())
        fail("'" + shown_text(path) + "' has no pairs");
    return pairs;
}

} // namespace

Protocol pairs_protocol(const EvalOptions& options)
{
    Protocol protocol;
    protocol.name = "pairs";
    protocol.text = {
        "Pairs: each photo is unprocessed with its reference and held against the RAW file that shows the "
        "same, which is linear. The photo is brought to the size of the RAW; their shapes must agree "
        "within 2 %."
    };
    for (const Pair& pair : read_pairs(options.inputs[0]))
        protocol.tasks.push_back(
            { pair.name,
              reference_state(pair.photo) + reference_state(pair.raw) + reference_state(pair.reference),
              { pair.photo, pair.raw, pair.reference },
              [pair, &options](const AskForMemory& ask) { return load_pair(pair, options, ask); } });
    return protocol;
}

} // namespace srisp::tool
