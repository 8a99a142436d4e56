// SPDX-License-Identifier: Apache-2.0
#include "recipe/white_balance.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "base/parsed_number.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

constexpr double kLowestKelvin = 1000, kHighestKelvin = 25000, kMostTint = 200, kLeastMultiplier = 1e-5,
                 kMostMultiplier = 1e5, kMostExposure = 20;

std::vector<double> parse_numbers(std::string_view text)
{
    std::vector<double> numbers;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        const auto number = parsed_signed_number<double>(text.substr(begin, end - begin));
        if (!number)
            return {};
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

bool within(double low, double value, double high)
{
    return value >= low && value <= high;
}

} // namespace

Expected<WhiteBalance> parse_white_balance(const std::string& text)
{
    using Kind = WhiteBalance::Kind;
    WhiteBalance balance;
    if (text == "scene")
        return balance;
    if (text == "reference") {
        balance.kind = Kind::reference;
        return balance;
    }
    const std::vector<double> numbers = parse_numbers(text);
    if (numbers.size() == 1 || numbers.size() == 2) {
        const double tint = numbers.size() == 2 ? numbers[1] : 0;
        if (within(kLowestKelvin, numbers[0], kHighestKelvin) && within(-kMostTint, tint, kMostTint))
            return WhiteBalance{ Kind::light, float(numbers[0]), float(tint), {} };
    } else if (numbers.size() == 3) {
        balance.kind = Kind::multipliers;
        std::copy(numbers.begin(), numbers.end(), balance.multipliers.begin());
        if (std::all_of(numbers.begin(), numbers.end(),
                        [](double v) { return within(kLeastMultiplier, v, kMostMultiplier); }))
            return balance;
    }
    return Error{
        "whitebalance '" + shown_text(text) +
        "' is none of: scene; reference; a temperature of 1000 to 25000 K, with a comma and a tint of -200 to "
        "200 or without; three multipliers R,G,B of 0.00001 to 100000"
    };
}

Expected<double> parse_exposure(const std::string& text)
{
    const auto number = parsed_signed_number<double>(text);
    if (number && std::fabs(*number) <= kMostExposure)
        return *number;
    return Error{ "exposure '" + shown_text(text) + "' is no number of EV from -20 to 20" };
}

} // namespace srisp
