// SPDX-License-Identifier: Apache-2.0
#include "train/network/unprocessor.h"

#include <algorithm>

#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// Pixels of a batch: the tone map's 32 channels of them, a few times over, stay well below 1 GB.
constexpr std::int64_t kBatchPixels = 1 << 18;

torch::Tensor reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference, int size,
                      ChosenParameters& choice)
{
    if (size == 0)
        return method.reverse(source, reference, &choice);
    method.reverse(area_resize(source, size, size), area_resize(reference, size, size), &choice);
    return method.apply_reverse(source, choice);
}

} // namespace

torch::Tensor batched_reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference,
                              int thumbnail_px, torch::Tensor* log_deviations)
{
    const torch::NoGradGuard no_gradients;
    const auto parameters = method.parameters();
    const auto device = parameters.empty() ? torch::Device(torch::kCPU) : parameters.front().device();
    const std::int64_t size = thumbnail_px == 0 ? method.selection_size() : thumbnail_px;
    const std::int64_t pixels =
        std::max({ source.size(2) * source.size(3), reference.size(2) * reference.size(3), size * size });
    const std::int64_t batch = std::max<std::int64_t>(1, kBatchPixels / pixels);
    std::vector<torch::Tensor> results, deviations;
    for (std::int64_t first = 0; first < source.size(0); first += batch) {
        const std::int64_t end = std::min(first + batch, source.size(0));
        ChosenParameters choice;
        results.push_back(reverse(method, source.slice(0, first, end).to(device),
                                  reference.slice(0, first, end).to(device), static_cast<int>(size), choice)
                              .to(torch::kCPU));
        if (choice.log_deviation.defined())
            deviations.push_back(choice.log_deviation.to(torch::kCPU));
    }
    if (log_deviations && !deviations.empty())
        *log_deviations = torch::cat(deviations);
    return torch::cat(results);
}

} // namespace srisp::train
