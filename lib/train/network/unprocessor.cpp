// SPDX-License-Identifier: Apache-2.0
#include "train/network/unprocessor.h"

#include <algorithm>

#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// Pixels of a batch: the tone map's 32 channels of them, a few times over, stay well below 1 GB.
constexpr std::int64_t kBatchPixels = 1 << 18;

torch::Tensor reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference,
                      int thumbnail_px)
{
    if (thumbnail_px == 0)
        return method.reverse(source, reference);
    ChosenParameters choice;
    method.reverse(area_resize(source, thumbnail_px, thumbnail_px), area_resize(reference, thumbnail_px, thumbnail_px),
                   &choice);
    return method.apply_reverse(source, choice);
}

} // namespace

torch::Tensor batched_reverse(Unprocessor& method, const torch::Tensor& source, const torch::Tensor& reference,
                              int thumbnail_px)
{
    const torch::NoGradGuard no_gradients;
    const auto parameters = method.parameters();
    const auto device = parameters.empty() ? torch::Device(torch::kCPU) : parameters.front().device();
    const std::int64_t thumbnail = std::int64_t(thumbnail_px) * thumbnail_px;
    const std::int64_t pixels =
        std::max({ source.size(2) * source.size(3), reference.size(2) * reference.size(3), thumbnail });
    const std::int64_t batch = std::max<std::int64_t>(1, kBatchPixels / pixels);
    std::vector<torch::Tensor> results;
    for (std::int64_t first = 0; first < source.size(0); first += batch) {
        const std::int64_t end = std::min(first + batch, source.size(0));
        results.push_back(reverse(method, source.slice(0, first, end).to(device),
                                  reference.slice(0, first, end).to(device), thumbnail_px)
                              .to(torch::kCPU));
    }
    return torch::cat(results);
}

} // namespace srisp::train
