// SPDX-License-Identifier: Apache-2.0
#include "train/learning/dictionary_augmentation.h"

#include <vector>

#include "train/tensors/random.h"

namespace srisp::train {

namespace {

/// Weights of `atoms` atoms: random numbers, divided by their sum.
std::vector<float> convex_weights(std::int64_t atoms, Random& random)
{
    std::vector<float> weights;
    double sum = 0;
    for (std::int64_t i = 0; i < atoms; ++i) {
        const double value = random.uniform(1e-6, 1);
        weights.push_back(static_cast<float>(value));
        sum += value;
    }
    for (float& weight : weights)
        weight = static_cast<float>(weight / sum);
    return weights;
}

/// Mixtures of `atoms` [K, …] for each of `images` generators: [N, …].
torch::Tensor random_mixtures(const torch::Tensor& atoms, std::vector<Random>& randoms)
{
    std::vector<float> weights;
    for (Random& random : randoms)
        for (const float weight : convex_weights(atoms.size(0), random))
            weights.push_back(weight);
    const auto images = static_cast<std::int64_t>(randoms.size());
    const torch::Tensor matrix = torch::tensor(weights).view({ images, atoms.size(0) }).to(atoms.device());
    std::vector<std::int64_t> shape = atoms.sizes().vec();
    shape[0] = images;
    return matrix.matmul(atoms.flatten(1)).view(shape);
}

} // namespace

torch::Tensor augment_by_dictionaries(Unprocessor& model, const torch::Tensor& source, const torch::Tensor& truth,
                                      const torch::Tensor& reference, double share, std::uint64_t seed,
                                      std::int64_t step, int first)
{
    const torch::NoGradGuard no_gradient;
    const auto parameters = model.named_parameters();
    const torch::Tensor* color = parameters.find("dictionary.color");
    const torch::Tensor* white_balance = parameters.find("dictionary.white_balance");
    if (!color || !white_balance || share <= 0)
        return source;
    constexpr std::uint64_t kPurpose = 0x64696374; // "dict": no other draw of this step and sample
    std::vector<Random> randoms;
    std::vector<float> chosen;
    for (std::int64_t i = 0; i < source.size(0); ++i) {
        randoms.push_back(
            Random(seed + kPurpose, static_cast<std::uint64_t>(step), static_cast<std::uint64_t>(first + i)));
        chosen.push_back(randoms.back().chance(share) ? 1.f : 0.f);
    }
    ChosenParameters choice;
    model.reverse(source, reference, &choice);
    choice.color = random_mixtures(*color / color->sum(2, true), randoms);
    const torch::Tensor gains = random_mixtures(*white_balance, randoms);
    // Two numbers are those of red and blue; three carry the gain, too.
    choice.white_balance =
        gains.size(1) == 3
            ? gains
            : torch::stack({ gains.select(1, 0), torch::ones_like(gains.select(1, 0)), gains.select(1, 1) }, 1) *
                  (choice.base / choice.base.slice(1, 1, 2));
    const torch::Tensor photo = model.process(truth, choice);
    if (!photo.defined())
        return source;
    const torch::Tensor mask = torch::tensor(chosen).to(source.device()).view({ -1, 1, 1, 1 });
    return torch::where(mask > 0, photo.clamp(0, 1), source);
}

} // namespace srisp::train
