// SPDX-License-Identifier: Apache-2.0
#include "result/noise_choice.h"

#include <filesystem>
#include <memory>

#include <srisp/reference.h>

#include "base/recently_kept.h"
#include "recipe/noise_source.h"

namespace srisp {

namespace {

using KeptNoise = std::shared_ptr<const NoiseModel>;

const char kGiven[] = "; shot=S,read=R gives the figures";

Expected<KeptNoise> kept_noise(const Expected<NoiseModel>& noise)
{
    if (!noise)
        return noise.error();
    return std::make_shared<const NoiseModel>(*noise);
}

Expected<NoiseModel> noise_of_reference(const Recipe& recipe, const CameraFacts& sensor, const std::string& photo_name,
                                        KeptResults& kept)
{
    if (recipe.references.empty()) {
        const auto noise = profile_noise(sensor);
        if (!noise)
            return Error{ "the image tells of its reference " + noise.error().message + kGiven };
        return noise;
    }
    const auto path = choose_reference(recipe.references, recipe.seed, photo_name);
    if (!path)
        return path.error();
    const auto found = kept.noises.get(reference_state(*path), [&]() -> Expected<KeptNoise> {
        const auto reference = load_reference_cached(*path, recipe.isolate);
        return reference ? kept_noise(reference_noise(**reference, recipe.isolate)) : reference.error();
    });
    if (!found)
        return found.error();
    return **found;
}

/// Where Debian's darktable, and one that was built by hand, keep it.
std::string installed_profiles()
{
    for (const char* path :
         { "/usr/share/darktable/noiseprofiles.json", "/usr/local/share/darktable/noiseprofiles.json" }) {
        std::error_code ignored;
        if (std::filesystem::exists(path, ignored))
            return path;
    }
    return {};
}

Expected<NoiseModel> noise_of_iso(const Recipe& recipe, double iso, const CameraFacts& sensor, KeptResults& kept)
{
    const std::string path = recipe.profile.empty() ? installed_profiles() : recipe.profile;
    if (path.empty())
        return Error{ "darktable is not installed here; profile=FILE names its noiseprofiles.json" };
    if (sensor.make.empty() && sensor.model.empty())
        return Error{ "the image does not say which camera it is to come from" + std::string(kGiven) };
    const std::string key = file_state(path) + "\n" + sensor.make + "\n" + sensor.model + "\n" + std::to_string(iso);
    const auto found =
        kept.noises.get(key, [&] { return kept_noise(darktable_noise(path, sensor.make, sensor.model, iso)); });
    if (!found)
        return found.error();
    return **found;
}

} // namespace

Expected<NoiseModel> choose_noise(const Recipe& recipe, const CameraFacts& sensor, const std::string& photo_name,
                                  std::uint64_t seed, KeptResults& kept)
{
    const auto source = parse_noise_source(recipe.noise);
    if (!source)
        return source.error();
    switch (source->kind) {
    case NoiseSource::Kind::reference:
        return noise_of_reference(recipe, sensor, photo_name, kept);
    case NoiseSource::Kind::iso:
        return noise_of_iso(recipe, source->iso, sensor, kept);
    case NoiseSource::Kind::figures:
        return NoiseModel{ source->shot, source->read };
    case NoiseSource::Kind::upi:
        break;
    }
    return upi_noise(seed);
}

} // namespace srisp
