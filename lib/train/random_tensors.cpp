// SPDX-License-Identifier: Apache-2.0
#include "random_tensors.h"

#include <cmath>

namespace srisp::train {

Randoms fork(const Randoms& randoms, std::uint64_t purpose)
{
    Randoms forks;
    for (const Random& random : randoms)
        forks.push_back(random.fork(purpose));
    return forks;
}

torch::Tensor noise(Randoms& randoms, at::IntArrayRef sizes)
{
    std::vector<std::int64_t> shape = { static_cast<std::int64_t>(randoms.size()) };
    shape.insert(shape.end(), sizes.begin(), sizes.end());
    const auto values = torch::empty(shape);
    const std::int64_t count = randoms.empty() ? 0 : values.numel() / shape[0];
    // Four numbers of 16 bits: their sum has mean 2 · 65535 and variance 4 (65536² − 1) / 12.
    const float scale = static_cast<float>(1 / std::sqrt((65536.0 * 65536.0 - 1) / 3));
    float* value = values.data_ptr<float>();
    for (Random& random : randoms)
        for (std::int64_t i = 0; i < count; ++i) {
            const std::uint64_t bits = random.bits();
            const auto sum = (bits & 0xffff) + (bits >> 16 & 0xffff) + (bits >> 32 & 0xffff) + (bits >> 48);
            *value++ = (static_cast<float>(sum) - 131070.0f) * scale;
        }
    return values;
}

torch::Tensor row_quantile(const torch::Tensor& rows, double q)
{
    const auto rank = static_cast<std::int64_t>(std::lround(q * (rows.size(1) - 1))) + 1;
    return std::get<0>(rows.kthvalue(rank, 1));
}

} // namespace srisp::train
