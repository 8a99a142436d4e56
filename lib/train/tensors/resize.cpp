// SPDX-License-Identifier: Apache-2.0
#include "train/tensors/resize.h"

#include <algorithm>

#include <ATen/Parallel.h>

namespace srisp::train {

namespace {

/// Which inputs each of some equal cells along an axis averages, and with what weights.
struct Coverage {
    struct Cell {
        std::int64_t first = 0; ///< input; those after it follow
        std::vector<float> weights;
    };
    std::vector<Cell> cells;

    /// The span low … high (fractions) of `count` inputs, cut into cells.
    Coverage(std::int64_t count, int cell_count, double low, double high) : cells(cell_count)
    {
        const double start = low * count, length = (high - low) * count / cell_count;
        for (int i = 0; i < cell_count; ++i) {
            const double from = start + i * length, to = from + length;
            cells[i].first = std::clamp<std::int64_t>(static_cast<std::int64_t>(from), 0, count - 1);
            for (std::int64_t k = cells[i].first; k < count && k < to; ++k) {
                const double covered = std::min(to, k + 1.0) - std::max(from, static_cast<double>(k));
                cells[i].weights.push_back(static_cast<float>(std::max(covered, 0.0) / length));
            }
        }
    }

    /// The same as a matrix [cells, count].
    torch::Tensor matrix(std::int64_t count) const
    {
        auto result = torch::zeros({ static_cast<std::int64_t>(cells.size()), count });
        for (std::size_t i = 0; i < cells.size(); ++i)
            std::copy(cells[i].weights.begin(), cells[i].weights.end(),
                      result.data_ptr<float>() + i * count + cells[i].first);
        return result;
    }
};

/// How an image is squashed: rows, then columns.
struct Squash {
    Coverage down, across;
};

/// One plane; `row` holds one row of the input.
void squash_plane(const Squash& squash, const float* plane, std::int64_t width, std::vector<float>& row, float* result)
{
    for (const Coverage::Cell& cell : squash.down.cells) {
        std::fill(row.begin(), row.end(), 0.0f);
        for (std::size_t k = 0; k < cell.weights.size(); ++k) {
            const float* input = plane + (cell.first + k) * width;
            for (std::int64_t x = 0; x < width; ++x)
                row[x] += cell.weights[k] * input[x];
        }
        for (const Coverage::Cell& column : squash.across.cells) {
            float sum = 0;
            for (std::size_t k = 0; k < column.weights.size(); ++k)
                sum += column.weights[k] * row[column.first + k];
            *result++ = sum;
        }
    }
}

/// On the CPU, where the matrices are nearly all zeros and a BLAS may be slow: 20 times faster than their products.
torch::Tensor squash_on_cpu(const torch::Tensor& images, const std::vector<Squash>& squashes, int height, int width)
{
    const auto input = images.contiguous();
    const auto channels = input.size(1), rows = input.size(2), columns = input.size(3);
    auto result = torch::empty({ input.size(0), channels, height, width });
    const float* from = input.data_ptr<float>();
    float* to = result.data_ptr<float>();
    at::parallel_for(0, input.size(0) * channels, 1, [&](std::int64_t begin, std::int64_t end) {
        std::vector<float> row(columns);
        for (std::int64_t plane = begin; plane < end; ++plane)
            squash_plane(squashes[squashes.size() == 1 ? 0 : plane / channels], from + plane * rows * columns, columns,
                         row, to + plane * height * width);
    });
    return result;
}

/// Two matrix products, on any device, with gradients.
torch::Tensor squash_by_products(const torch::Tensor& images, const std::vector<Squash>& squashes)
{
    std::vector<torch::Tensor> down, across;
    for (const Squash& squash : squashes) {
        down.push_back(squash.down.matrix(images.size(2)));
        across.push_back(squash.across.matrix(images.size(3)).t());
    }
    return torch::matmul(torch::stack(down).unsqueeze(1).to(images.options()),
                         torch::matmul(images, torch::stack(across).unsqueeze(1).to(images.options())));
}

torch::Tensor squash(const torch::Tensor& images, const std::vector<Squash>& squashes, int height, int width)
{
    const bool gradients = torch::GradMode::is_enabled() && images.requires_grad();
    if (images.is_cpu() && images.scalar_type() == torch::kFloat32 && !gradients)
        return squash_on_cpu(images, squashes, height, width);
    return squash_by_products(images, squashes);
}

} // namespace

torch::Tensor area_resize(const torch::Tensor& images, int height, int width)
{
    return squash(images, { { { images.size(2), height, 0, 1 }, { images.size(3), width, 0, 1 } } }, height, width);
}

torch::Tensor area_crop(const torch::Tensor& images, const std::vector<Window>& windows, int height, int width)
{
    TORCH_CHECK(static_cast<std::int64_t>(windows.size()) == images.size(0), "area_crop: ", windows.size(),
                " windows for ", images.size(0), " images");
    if (windows.empty())
        return images.new_empty({ 0, images.size(1), height, width });
    std::vector<Squash> squashes;
    for (const Window& w : windows)
        squashes.push_back({ { images.size(2), height, w.top, w.bottom }, { images.size(3), width, w.left, w.right } });
    return squash(images, squashes, height, width);
}

} // namespace srisp::train
