// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/color.h"

#include <algorithm>
#include <cmath>

#include <ATen/Parallel.h>

#include "rendering/test_rendering.h"

namespace srisp::train {

torch::Tensor inverse3x3(const torch::Tensor& matrix)
{
    const auto row = [&](int i) { return matrix.select(-2, i); };
    // Columns of the adjugate are cross products of the rows.
    const torch::Tensor first = torch::cross(row(1), row(2), -1);
    const torch::Tensor determinant = (row(0) * first).sum(-1, true).unsqueeze(-1);
    return torch::stack({ first, torch::cross(row(2), row(0), -1), torch::cross(row(0), row(1), -1) }, -1) /
           determinant;
}

torch::Tensor row_normalized(const torch::Tensor& matrix)
{
    return matrix / matrix.sum(-1, true);
}

torch::Tensor luminance(const torch::Tensor& rgb)
{
    const auto channels = rgb.unbind(1);
    return (0.2126 * channels[0] + 0.7152 * channels[1] + 0.0722 * channels[2]).unsqueeze(1);
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

torch::Tensor srgb_encoded(const torch::Tensor& linear)
{
    return torch::where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear.clamp_min(0.0031308).pow(1 / 2.4) - 0.055);
}

torch::Tensor eight_bit(const torch::Tensor& v)
{
    return (v * 255 + 0.5).floor() / 255;
}

torch::Tensor inverse_smoothstep(const torch::Tensor& v)
{
    return 0.5 - torch::sin(torch::asin(1 - 2 * v.clamp(0, 1)) / 3);
}

torch::Tensor dnd_rgb_to_camera()
{
    std::vector<torch::Tensor> matrices;
    for (const Matrix3& matrix : srisp::dnd_rgb_to_camera())
        matrices.push_back(torch::tensor(at::ArrayRef<float>(matrix)).view({ 3, 3 }));
    return torch::stack(matrices);
}

torch::Tensor dnd_color_matrices(int count, Randoms& randoms)
{
    const torch::Tensor matrices = inverse3x3(dnd_rgb_to_camera());
    std::vector<std::int64_t> chosen;
    for (Random& random : randoms) {
        std::vector<std::int64_t> order{ 0, 1, 2, 3 };
        for (int k = 0; k < count; ++k) {
            const std::size_t place = k % order.size();
            std::swap(order[place], order[place + random.integer(order.size() - place)]);
            chosen.push_back(order[place]);
        }
    }
    const auto images = static_cast<std::int64_t>(randoms.size());
    return matrices.index_select(0, torch::tensor(chosen, torch::kLong)).view({ images, count, 3, 3 });
}

} // namespace srisp::train
