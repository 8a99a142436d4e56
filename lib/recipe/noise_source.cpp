// SPDX-License-Identifier: Apache-2.0
#include "recipe/noise_source.h"

#include <optional>
#include <string_view>
#include <vector>

#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

const char kKnown[] = "noise comes from reference, iso=N, shot=S,read=R or upi";

Error wrong(const std::string& text, const std::string& why)
{
    return { "noise '" + shown_text(text) + "': " + why };
}

std::vector<std::string_view> parts(std::string_view text)
{
    std::vector<std::string_view> list;
    for (;;) {
        const std::size_t comma = text.find(',');
        list.push_back(text.substr(0, comma));
        if (comma == std::string_view::npos)
            return list;
        text.remove_prefix(comma + 1);
    }
}

/// One figure for all colours, or one for each.
bool spread(const std::vector<double>& figures, std::array<double, 3>& target)
{
    if (figures.size() != 1 && figures.size() != 3)
        return false;
    for (std::size_t c = 0; c < 3; ++c)
        target[c] = figures[figures.size() == 1 ? 0 : c];
    return true;
}

/// `shot=…,read=…` in either order; a figure without a name belongs to the name before it.
Status parse_figures(const std::string& text, NoiseSource& source)
{
    std::vector<double> shot, read, *target = nullptr;
    for (std::string_view part : parts(text)) {
        for (const auto& [name, figures] : { std::pair{ std::string_view("shot="), &shot }, { "read=", &read } })
            if (part.substr(0, name.size()) == name) {
                if (!figures->empty())
                    return wrong(text, std::string(name) + " is said twice");
                target = figures;
                part.remove_prefix(name.size());
            }
        const auto figure = parsed_number<double>(part);
        if (!target || !figure)
            return wrong(text, "'" + shown_text(std::string(part)) + "' is not a number; " + kKnown);
        if (!(*figure >= 0 && *figure <= 1))
            return wrong(text, shown_text(std::string(part)) + " is not in [0,1]");
        target->push_back(*figure);
    }
    if (!spread(shot, source.shot) || !spread(read, source.read))
        return wrong(text, "shot= and read= need one figure each, or three for R, G, B");
    return {};
}

} // namespace

Expected<NoiseSource> parse_noise_source(const std::string& text)
{
    NoiseSource source;
    const std::string iso = "iso=";
    if (text == "reference")
        return source;
    if (text == "upi") {
        source.kind = NoiseSource::Kind::upi;
    } else if (text.compare(0, iso.size(), iso) == 0) {
        const auto value = parsed_number<double>(std::string_view(text).substr(iso.size()));
        if (!value || !(*value > 0 && *value < 1e9))
            return wrong(text, "the ISO is a number above 0");
        source.kind = NoiseSource::Kind::iso;
        source.iso = *value;
    } else if (text.find("shot=") == 0 || text.find("read=") == 0) {
        source.kind = NoiseSource::Kind::figures;
        if (const Status parsed = parse_figures(text, source); !parsed)
            return parsed.error();
    } else {
        return wrong(text, kKnown);
    }
    return source;
}

} // namespace srisp
