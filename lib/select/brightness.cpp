// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <srisp/select.h>

#include "base/guarded.h"
#include "base/hashes.h"
#include "base/shown_text.h"
#include "noise/philox.h"

namespace srisp {

namespace {

std::string ev_text(double ev)
{
    return shown_decimals(ev, 2) + " EV";
}
std::string signed_text(double ev, const std::string& number)
{
    return (ev < 0 ? "" : "+") + number + " EV";
}

/// Of a normal distribution with mean 0 and deviation 1.
double draw(std::uint64_t seed, const std::string& photo_name)
{
    constexpr double kTwoPi = 6.283185307179586;
    const auto words = philox({ 0, 0, std::uint32_t(NoiseStream::brightness), 0 }, seeded_hash(seed, photo_name));
    const auto uniform = [&](std::size_t i) { return (words[i] + 0.5) * 0x1p-32; };
    return std::sqrt(-2 * std::log(uniform(0))) * std::cos(kTwoPi * uniform(1));
}

} // namespace

std::string brightness_note(const Parameters& parameters)
{
    constexpr float kUnsure = 0.7f;
    if (!(parameters.brightness_sd_ev.value_or(0.0f) > kUnsure))
        return {};
    return "the brightness is unsure, its standard deviation is " + ev_text(*parameters.brightness_sd_ev) +
           "; brightness=EV makes the result that much brighter, or darker below 0";
}

Status choose_brightness(Parameters& parameters, const Brightness& brightness, std::uint64_t seed,
                         const std::string& photo_name, std::vector<std::string>* notes)
{
    return guarded("brightness", {}, [&]() -> Status {
        double ev = brightness.ev;
        if (brightness.sample) {
            if (!parameters.brightness_sd_ev)
                return Error{ "brightness 'sample' has no standard deviation to draw from: model '" +
                              shown_text(parameters.model_name) +
                              "' tells none, or the parameters lack brightness_sd_ev; brightness=EV gives a number" };
            const double most = kLargestBrightnessEv;
            ev = std::clamp(draw(seed, photo_name) * *parameters.brightness_sd_ev, -most, most);
            if (notes)
                notes->push_back("a brightness of " + signed_text(ev, shown_decimals(ev, 4)) +
                                 " was drawn (standard deviation " + ev_text(*parameters.brightness_sd_ev) + ", seed " +
                                 std::to_string(seed) + ")");
        }
        parameters.gain = static_cast<float>(parameters.gain / std::exp2(ev));
        parameters.brightness_ev = static_cast<float>(parameters.brightness_ev + ev);
        if (!(std::isnormal(parameters.gain)))
            return Error{ "brightness of " + signed_text(ev, shown_number(ev)) + ": the gain becomes " +
                          shown_number(parameters.gain) };
        return {};
    });
}

} // namespace srisp
