// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include <srisp/noise.h>

#include "base/guarded.h"
#include "base/shown_text.h"
#include "noise/philox.h"

namespace srisp {

Status check_noise(const NoiseModel& noise)
{
    for (const auto& [name, figures] : { std::pair{ "shot", noise.shot }, std::pair{ "read", noise.read } })
        for (const double figure : figures)
            if (!(figure >= 0 && figure <= 1))
                return Error{ std::string(name) + " noise " + shown_number(figure) + " is not in [0,1]" };
    return {};
}

Expected<NoiseModel> profile_noise(const CameraFacts& facts)
{
    return guarded("noise", {}, [&]() -> Expected<NoiseModel> {
        const std::vector<double>& profile = facts.noise_profile;
        if (profile.empty())
            return Error{ "no NoiseProfile" };
        if (profile.size() != 2 && profile.size() != 6)
            return Error{ "NoiseProfile of " + std::to_string(profile.size()) + " numbers: 2 or 6 are needed" };
        NoiseModel noise;
        for (std::size_t c = 0; c < 3; ++c) {
            const std::size_t pair = profile.size() == 2 ? 0 : 2 * c;
            noise.shot[c] = profile[pair];
            noise.read[c] = profile[pair + 1];
        }
        if (const Status possible = check_noise(noise); !possible)
            return Error{ "NoiseProfile: " + possible.error().message };
        return noise;
    });
}

NoiseModel upi_noise(std::uint64_t seed)
{
    constexpr double kLeastShot = 1e-4, kMostShot = 0.012, kTwoPi = 6.283185307179586;
    const auto words = philox({ 0, 0, std::uint32_t(NoiseStream::model), 0 }, seed);
    const auto uniform = [&](int i) { return (words[std::size_t(i)] + 0.5) * 0x1p-32; };
    const double log_shot = std::log(kLeastShot) + uniform(0) * std::log(kMostShot / kLeastShot);
    const double normal = std::sqrt(-2 * std::log(uniform(1))) * std::cos(kTwoPi * uniform(2));
    NoiseModel noise;
    noise.shot.fill(std::exp(log_shot));
    noise.read.fill(std::exp(2.18 * log_shot + 1.20 + 0.26 * normal));
    return noise;
}

} // namespace srisp
