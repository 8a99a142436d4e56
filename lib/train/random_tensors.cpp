// SPDX-License-Identifier: Apache-2.0
#include "random_tensors.h"

#include <algorithm>
#include <cmath>

#include <ATen/Parallel.h>

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

std::vector<torch::Tensor> row_quantiles(const torch::Tensor& rows, const std::vector<double>& quantiles)
{
    std::vector<torch::Tensor> result;
    std::vector<std::int64_t> ranks;
    for (const double q : quantiles)
        ranks.push_back(static_cast<std::int64_t>(std::lround(q * (rows.size(1) - 1))));
    if (!rows.is_cpu()) {
        for (const std::int64_t rank : ranks)
            result.push_back(std::get<0>(rows.kthvalue(rank + 1, 1)));
        return result;
    }
    // The same values, several times faster.
    result.resize(ranks.size());
    for (torch::Tensor& values : result)
        values = torch::empty({ rows.size(0) });
    const auto scratch = rows.clone(at::MemoryFormat::Contiguous);
    at::parallel_for(0, rows.size(0), 1, [&](std::int64_t begin, std::int64_t end) {
        for (std::int64_t i = begin; i < end; ++i) {
            float* row = scratch.data_ptr<float>() + i * rows.size(1);
            std::int64_t sorted = 0; // what lies before is no larger than all behind it
            for (std::size_t k = 0; k < ranks.size(); ++k) {
                std::nth_element(row + sorted, row + ranks[k], row + rows.size(1));
                result[k].data_ptr<float>()[i] = row[ranks[k]];
                sorted = ranks[k];
            }
        }
    });
    return result;
}

torch::Tensor row_quantile(const torch::Tensor& rows, double q)
{
    return row_quantiles(rows, { q }).front();
}

} // namespace srisp::train
