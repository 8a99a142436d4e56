// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "sample_geometry.h"
#include "scene_source.h"

namespace srisp::train {

/// Makes batches, each when it is asked for. [training_samples.h]
class SampleMaker : public Samples {
public:
    SampleMaker(const DataSettings& settings, const SampleSources& sources, std::uint64_t seed,
                const torch::Device& device);
    Batch batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired) override;

    /// Pairs before they are cropped.
    struct Scenes {
        torch::Tensor raw;           ///< [N, 3, H, W]
        torch::Tensor reference_raw; ///< the same scene or another one, in the same camera, light and exposure
        torch::Tensor rendered;      ///< display-encoded
        std::vector<SampleGeometry> geometry;
    };
    Scenes scenes(std::int64_t step, int first, int count) const;

private:
    struct Exposures;
    /// Exposes a scene for each generator, and a second one for those with `other_scene`.
    Exposures expose_scenes(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    Exposures simulated(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    Exposures real(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    torch::Tensor render(const Exposures& exposures, const Randoms& randoms) const;
    void check() const;

    DataSettings m_settings;
    SampleSources m_sources;
    std::uint64_t m_seed;
    torch::Device m_device;
    SceneSource m_photos, m_raws;
    SimulatedCameras m_cameras;
};

} // namespace srisp::train
