// SPDX-License-Identifier: Apache-2.0
#include "query.h"

#include <OpenImageIO/strutil.h>

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

const std::string kExtension = ".srisp";
const std::string kHintPrefix = "srisp:";

int hex_digit(char c)
{
    const std::size_t value = std::string("0123456789abcdef").find(Strutil::lower(std::string(1, c)));
    return value == std::string::npos ? -1 : static_cast<int>(value);
}

Expected<std::string> percent_decoded(const std::string& text)
{
    std::string decoded;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0)
            return Error{ "'" + text.substr(i, 3) + "' in the query is no percent code (write %25 for %)" };
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

} // namespace

bool parse_name(const std::string& name, QueryName& parts)
{
    const std::string lower = Strutil::lower(name);
    std::size_t end = lower.find(kExtension + "?");
    if (end == std::string::npos) {
        if (!Strutil::ends_with(lower, kExtension))
            return false;
        end = name.size() - kExtension.size();
    } else {
        parts.query = name.substr(end + kExtension.size() + 1);
    }
    parts.source = name.substr(0, end);
    parts.file = name.substr(0, end + kExtension.size());
    return !parts.source.empty();
}

Status apply_query(Recipe& recipe, const std::string& query)
{
    for (std::size_t start = 0; start < query.size();) {
        const std::size_t end = std::min(query.find('&', start), query.size());
        const std::string item = query.substr(start, end - start);
        start = end + 1;
        const std::size_t equals = item.find('=');
        if (equals == std::string::npos)
            return Error{ "'" + item + "' in the query is not key=value" };
        const auto key = percent_decoded(item.substr(0, equals));
        const auto value = percent_decoded(item.substr(equals + 1));
        if (!key || !value)
            return key ? value.error() : key.error();
        if (const Status set = set_by_text(recipe, *key, *value); !set)
            return set;
    }
    return {};
}

Status apply_hints(Recipe& recipe, const OIIO::ImageSpec& config)
{
    for (const OIIO::ParamValue& hint : config.extra_attribs) {
        const std::string name = hint.name().string();
        if (!Strutil::istarts_with(name, kHintPrefix))
            continue;
        if (const Status set = set_by_text(recipe, name.substr(kHintPrefix.size()), hint.get_string()); !set)
            return Error{ "configuration hint '" + name + "': " + set.error().message };
    }
    return {};
}

} // namespace srisp
