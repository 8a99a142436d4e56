// SPDX-License-Identifier: Apache-2.0
#include "reference/sample_layout.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <libraw/libraw_version.h>

#include "base/input_file.h"
#include "base/json_object.h"
#include "base/near_names.h"
#include "base/shown_text.h"
#include "recipe/reference_pattern.h"

namespace srisp {

namespace {

constexpr std::size_t kMostText = 1 << 16; // bytes; 200 are usual
constexpr std::int64_t kLargestSide = 65535, kLargestFile = std::int64_t(2) << 30;

/// Takes one key after the other; the reader keeps the first error.
class LayoutReader {
public:
    LayoutReader(const nlohmann::json& object, const std::string& where) : m_reader(object, where) {}

    Expected<SampleLayout> read()
    {
        read_size();
        read_filters();
        read_levels();
        read_storage();
        read_camera();
        if (Status status = m_reader.finish(); !status)
            return status.error();
        describe_levels(m_layout.pixels, m_layout.facts);
        return m_layout;
    }

private:
    using json = nlohmann::json;

    std::int64_t whole(const json& value, const std::string& key, std::int64_t least, std::int64_t most)
    {
        if (value.is_number_integer() && value >= least && value <= most)
            return value.get<std::int64_t>();
        m_reader.fail("'" + key + "' must be a whole number from " + std::to_string(least) + " to " +
                      std::to_string(most) + ", has " + shown_json(value));
        return least;
    }
    std::int64_t whole(const std::string& key, std::int64_t least, std::int64_t most)
    {
        return whole(m_reader.take(key), key, least, most);
    }
    std::int64_t optional_whole(const std::string& key, std::int64_t least, std::int64_t most, std::int64_t otherwise)
    {
        const json* value = m_reader.take_optional(key);
        return value ? whole(*value, key, least, most) : otherwise;
    }

    void read_size()
    {
        m_layout.pixels.width = int(whole("width", 2, kLargestSide));
        m_layout.pixels.height = int(whole("height", 2, kLargestSide));
        m_layout.bits = int(whole("bits", 1, 16));
    }

    void read_filters()
    {
        const std::string letters = m_reader.take_text("cfa");
        const std::vector<std::string> known = { "RGGB", "GRBG", "GBRG", "BGGR" };
        if (std::find(known.begin(), known.end(), letters) == known.end())
            m_reader.fail("'cfa' must be RGGB, GRBG, GBRG or BGGR, has '" + shown_text(letters) + "'");
        m_layout.pixels.cfa = { 2, 2, letters };
    }

    /// One black level, or one for each of the four sites.
    void read_levels()
    {
        BlackLevels& black = m_layout.pixels.black;
        const json& value = m_reader.take("black");
        std::vector<float> levels =
            value.is_array() ? m_reader.take_list("black") : std::vector<float>{ m_reader.take_number("black") };
        if (levels.size() != 1 && levels.size() != 4) {
            m_reader.fail("'black' must be one number or four, has " + shown_json(value));
            levels = { 0 };
        }
        black.rows = black.columns = levels.size() == 4 ? 2 : 1;
        black.pattern = levels;
        const float white = m_reader.take_number("white"), most = std::exp2(float(m_layout.bits)) - 1;
        m_layout.pixels.white.fill(white);
        if (!(white > 0 && white <= most) || *std::min_element(levels.begin(), levels.end()) < 0)
            m_reader.fail("'black' and 'white' must be from 0 to " + std::to_string(int(most)) + " for " +
                          std::to_string(m_layout.bits) + " bits");
        if (Status status = check_levels(m_layout.pixels); !status)
            m_reader.fail("has levels that cannot be: " + status.error().message);
    }

    void read_storage()
    {
        const std::vector<std::string> packings = { "none", "mipi" };
        if (m_reader.take_optional("packed")) {
            const std::string packed = m_reader.take_text("packed");
            if (std::find(packings.begin(), packings.end(), packed) == packings.end())
                m_reader.fail("has an unknown value '" + shown_text(packed) + "' of 'packed'" +
                              near_names(packed, packings));
            m_layout.packed = packed == "mipi";
        }
        const std::int64_t width = m_layout.pixels.width, bits = m_layout.bits;
        if (m_layout.packed && bits != 10 && bits != 12)
            m_reader.fail("'packed': 'mipi' needs 10 or 12 bits, has " + std::to_string(bits));
        if (m_layout.packed && width % (bits == 10 ? 4 : 2) != 0)
            m_reader.fail("'width' of " + std::to_string(width) + " must be a multiple of " + (bits == 10 ? "4" : "2") +
                          " for packed samples of " + std::to_string(bits) + " bits");
        const std::int64_t least = m_layout.packed ? width * bits / 8 : width * (bits > 8 ? 2 : 1);
        m_layout.row_bytes = std::uint64_t(optional_whole("row_bytes", least, kLargestFile, least));
        m_layout.offset = std::uint64_t(optional_whole("offset", 0, kLargestFile, 0));
    }

    void read_camera()
    {
        if (m_reader.take_optional("camera"))
            m_layout.facts.model = m_reader.take_text("camera");
        m_layout.facts.orientation = int(optional_whole("orientation", 1, 8, 1));
        if (!m_reader.take_optional("neutral"))
            return;
        const std::vector<float> neutral = m_reader.take_list("neutral");
        if (neutral.size() != 3 || !(*std::min_element(neutral.begin(), neutral.end()) > 0))
            return m_reader.fail("'neutral' must be three numbers above 0: the camera's R, G, B of a neutral surface");
        m_layout.facts.as_shot_neutral = { neutral[0] / neutral[1], 1, neutral[2] / neutral[1] };
    }

    JsonObjectReader m_reader;
    SampleLayout m_layout;
};

} // namespace

Expected<SampleLayout> parse_sample_layout(const std::string& text, const std::string& path)
{
    const std::string where = "description '" + path + "'";
    const auto object = parse_json_object(text, where, "the text");
    if (!object)
        return object.error();
    auto layout = LayoutReader(*object, where).read();
    if (layout) {
        layout->path = path;
        layout->text = text;
    }
    return layout;
}

Expected<std::optional<SampleLayout>> find_sample_layout(const std::string& path)
{
    for (const std::string& candidate : layout_paths(path)) {
        std::error_code ignored;
        if (candidate == path || !std::filesystem::exists(candidate, ignored))
            continue;
        const auto text = read_text_file(candidate, kMostText);
        if (!text)
            return Error{ "description " + text.error().message };
        auto layout = parse_sample_layout(*text, candidate);
        if (!layout)
            return layout.error();
        return std::optional<SampleLayout>(std::move(*layout));
    }
    return std::optional<SampleLayout>();
}

Expected<SampleLayout> needed_sample_layout(const std::string& path)
{
    auto layout = find_sample_layout(path);
    if (!layout)
        return layout.error();
    if (*layout)
        return std::move(**layout);
    return Error{ "is not a RAW file that LibRaw " + std::string(LIBRAW_VERSION_STR) +
                  " knows by its first bytes. If it holds plain samples, describe them in '" + path +
                  ".json': {\"width\": 4032, \"height\": 3024, \"cfa\": \"RGGB\", \"bits\": 10, \"black\": 64, "
                  "\"white\": 1023}" };
}

} // namespace srisp
