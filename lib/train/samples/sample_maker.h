// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <srisp/expected.h>

#include "train/samples/packed_images.h"
#include "train/samples/sample_geometry.h"
#include "train/samples/samples.h"

namespace srisp::train {

/// What samples are made of, as in a TrainingPack; `owner` keeps the pixels alive.
struct SampleSources {
    PackedImages photos, raws;
    PackedCameras cameras;
    std::shared_ptr<const void> owner;
};

/// Samples of a pack's training images and cameras, made on `device` (pixels are unpacked and random numbers drawn on
/// the CPU). Errors: the pack has nothing to make them of. Threads: one caller at a time.
Expected<std::unique_ptr<Samples>> make_samples(const DataSettings& settings, std::shared_ptr<const TrainingPack> pack,
                                                std::uint64_t seed, const torch::Device& device = torch::kCPU);
Expected<std::unique_ptr<Samples>> make_samples(const DataSettings& settings, const SampleSources& sources,
                                                std::uint64_t seed, const torch::Device& device = torch::kCPU);

/// Makes batches, each when it is asked for. Use make_samples, which checks that there is something to make them of.
class SampleMaker : public Samples {
public:
    SampleMaker(const DataSettings& settings, const SampleSources& sources, std::uint64_t seed,
                const torch::Device& device);
    bool has_unpaired() const override { return !m_photos.empty(); }
    Batch batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired) override;

    /// Pairs before they are cropped.
    struct Scenes {
        torch::Tensor raw;           ///< [N, 3, H, W]
        torch::Tensor reference_raw; ///< the same scene or another one, in the same camera, light and exposure
        torch::Tensor rendered;      ///< display-encoded
        std::vector<SampleGeometry> geometry;
    };
    Scenes scenes(std::int64_t step, int first, int count) const;

    /// Errors: what the settings ask for and the sources lack.
    Status check() const;

private:
    struct Exposures;
    /// Exposes a scene for each generator, and a second one for those with `other_scene`.
    Exposures expose_scenes(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    Exposures simulated(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    Exposures real(const Randoms& randoms, const std::vector<bool>& other_scene) const;
    torch::Tensor render(const Exposures& exposures, const Randoms& randoms) const;

    DataSettings m_settings;
    SampleSources m_sources;
    std::uint64_t m_seed;
    torch::Device m_device;
    SceneSource m_photos, m_raws;
    SimulatedCameras m_cameras;
};

} // namespace srisp::train
