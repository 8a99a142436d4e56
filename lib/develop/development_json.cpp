// SPDX-License-Identifier: Apache-2.0
// A development as text, in a result's record.
#include <algorithm>
#include <cmath>

#include <srisp/develop.h>

#include "base/guarded.h"
#include "base/json_object.h"
#include "base/matrix3.h"
#include "base/scene_linear_space.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr const char* kHighlightNames[] = { "clip", "blend", "keep" };

/// Takes a list of as many numbers as the target has.
template<std::size_t Count>
void take_numbers(JsonObjectReader& reader, const char* key, std::array<float, Count>& target)
{
    const std::vector<float> numbers = reader.take_list(key);
    if (numbers.size() == Count)
        std::copy(numbers.begin(), numbers.end(), target.begin());
    else
        reader.fail(std::string("'") + key + "' must have " + std::to_string(Count) + " numbers, has " +
                    std::to_string(numbers.size()));
}

} // namespace

std::string to_json(const Development& development)
{
    const nlohmann::ordered_json object = { { "space", development.space },
                                            { "multipliers", development.multipliers },
                                            { "matrix", development.matrix },
                                            { "white", development.white },
                                            { "highlights", kHighlightNames[int(development.highlights)] } };
    return object.dump();
}

Expected<Development> development_from_json(const std::string& text, const std::string& where)
{
    return guarded("development", {}, [&]() -> Expected<Development> {
        const std::string what = "development in " + where;
        const auto parsed = parse_json<nlohmann::json>(text);
        if (!parsed)
            return Error{ what + ": " + parsed.error().message };
        JsonObjectReader reader(*parsed, what);
        Development development;
        const std::string space = reader.take_text("space");
        if (const SceneLinearSpace* const known = find_scene_linear_space(space))
            development.space = known->name;
        else
            reader.fail("'space' is '" + shown_text(space) + "', which is not known");
        take_numbers(reader, "multipliers", development.multipliers);
        take_numbers(reader, "matrix", development.matrix);
        development.white = reader.take_number("white");
        if (!(development.white > 0))
            reader.fail("'white' must be above 0");
        const std::string highlights = reader.take_text("highlights");
        const auto name = std::find(std::begin(kHighlightNames), std::end(kHighlightNames), highlights);
        if (name == std::end(kHighlightNames))
            reader.fail("'highlights' is '" + shown_text(highlights) + "', must be clip, blend or keep");
        else
            development.highlights = Highlights(name - std::begin(kHighlightNames));
        if (!(std::fabs(determinant(product(development.matrix, diagonal(development.multipliers)))) > 1e-12))
            reader.fail("'matrix' has no inverse");
        if (const Status whole = reader.finish(); !whole)
            return whole.error();
        return development;
    });
}

} // namespace srisp
