// SPDX-License-Identifier: Apache-2.0
#include <srisp/noise.h>

#include "base/guarded.h"
#include "noise/file_noise.h"

namespace srisp {

namespace {

/// From the pixels of the file that the reference was made of.
Expected<NoiseModel> estimated(const Reference& reference, bool isolate)
{
    if (reference.facts.cfa_pattern.empty())
        return Error{ "it is no mosaic as a sensor has it, and demosaicing mixes the noise of neighbours" };
    if (reference.path.empty())
        return Error{ "it was not read from a file" };
    const auto file = estimate_file_noise(reference.path, isolate);
    if (!file)
        return file.error();
    if (file->hash != reference.hash)
        return Error{ "the file has changed since it became the reference" };
    return file->noise;
}

} // namespace

Expected<NoiseModel> reference_noise(const Reference& reference, bool isolate)
{
    return guarded("noise of reference", reference.path, [&]() -> Expected<NoiseModel> {
        const auto profile = profile_noise(reference.facts);
        if (profile)
            return profile;
        const auto noise = estimated(reference, isolate);
        if (noise)
            return noise;
        const std::string& name = reference.path.empty() ? reference.name : reference.path;
        return Error{ "reference '" + name + "': " + profile.error().message +
                      ", and noise cannot be estimated from it: " + noise.error().message };
    });
}

} // namespace srisp
