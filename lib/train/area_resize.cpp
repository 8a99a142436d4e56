// SPDX-License-Identifier: Apache-2.0
#include "area_resize.h"

#include <algorithm>

namespace srisp::train {

namespace {

/// Writes the [cells, count] matrix that averages the span low … high (fractions) of `count` inputs into equal cells.
void write_coverage(float* matrix, std::int64_t count, int cells, double low, double high)
{
    const double start = low * count, cell_length = (high - low) * count / cells;
    std::fill(matrix, matrix + cells * count, 0.0f);
    for (int cell = 0; cell < cells; ++cell) {
        const double from = start + cell * cell_length, to = from + cell_length;
        const auto first = std::clamp<std::int64_t>(static_cast<std::int64_t>(from), 0, count - 1);
        for (std::int64_t i = first; i < count && i < to; ++i) {
            const double covered = std::min(to, i + 1.0) - std::max(from, static_cast<double>(i));
            matrix[cell * count + i] = static_cast<float>(std::max(covered, 0.0) / cell_length);
        }
    }
}

torch::Tensor coverage(std::int64_t count, int cells, double low, double high)
{
    auto matrix = torch::empty({ cells, count });
    write_coverage(matrix.data_ptr<float>(), count, cells, low, high);
    return matrix;
}

} // namespace

torch::Tensor area_resize(const torch::Tensor& images, int height, int width)
{
    const auto down = coverage(images.size(2), height, 0, 1).to(images.options());
    const auto across = coverage(images.size(3), width, 0, 1).to(images.options());
    return torch::matmul(down, torch::matmul(images, across.t()));
}

torch::Tensor area_crop(const torch::Tensor& images, const std::vector<Window>& windows, int height, int width)
{
    const auto count = images.size(0), rows = images.size(2), columns = images.size(3);
    TORCH_CHECK(static_cast<std::int64_t>(windows.size()) == count, "area_crop: ", windows.size(), " windows for ",
                count, " images");
    auto down = torch::empty({ count, 1, height, rows }), across = torch::empty({ count, 1, width, columns });
    for (std::int64_t n = 0; n < count; ++n) {
        const Window& w = windows[n];
        write_coverage(down.data_ptr<float>() + n * height * rows, rows, height, w.top, w.bottom);
        write_coverage(across.data_ptr<float>() + n * width * columns, columns, width, w.left, w.right);
    }
    down = down.to(images.options());
    across = across.to(images.options());
    return torch::matmul(down, torch::matmul(images, across.transpose(2, 3)));
}

} // namespace srisp::train
