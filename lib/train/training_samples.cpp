// SPDX-License-Identifier: Apache-2.0
#include "training_samples.h"

#include "sample_maker.h"

namespace srisp::train {

std::unique_ptr<Samples> make_samples(const DataSettings& settings, const SampleSources& sources, std::uint64_t seed,
                                      const torch::Device& device)
{
    return std::make_unique<SampleMaker>(settings, sources, seed, device);
}

std::unique_ptr<Samples> make_samples(const DataSettings& settings, std::shared_ptr<const TrainingPack> pack,
                                      std::uint64_t seed, const torch::Device& device)
{
    return make_samples(settings, SampleSources{ pack->photos(), pack->raws(), pack->cameras(), pack }, seed, device);
}

} // namespace srisp::train
