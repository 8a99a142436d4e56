// SPDX-License-Identifier: Apache-2.0
#include "relu_with_border.h"

#include <algorithm>

#include <ATen/Parallel.h>

namespace srisp::train {

namespace {

/// One channel: rows × columns become (rows + 2) × (columns + 2).
void forward_plane(const float* in, float* out, std::int64_t rows, std::int64_t columns)
{
    const std::int64_t stride = columns + 2;
    for (std::int64_t y = 0; y < rows; ++y, in += columns) {
        float* const row = out + (y + 1) * stride;
        for (std::int64_t x = 0; x < columns; ++x)
            row[x + 1] = in[x] < 0 ? 0 : in[x]; // NaN stays NaN
        row[0] = row[1];
        row[columns + 1] = row[columns];
    }
    std::copy_n(out + stride, stride, out);
    std::copy_n(out + rows * stride, stride, out + (rows + 1) * stride);
}

/// Gradients of the border go to the pixels that it replicates; `out` is what forward_plane wrote.
void backward_plane(const float* out, const float* out_gradient, float* gradient, std::int64_t rows,
                    std::int64_t columns)
{
    const std::int64_t stride = columns + 2;
    std::vector<float> sum(static_cast<std::size_t>(stride));
    for (std::int64_t y = 0; y < rows; ++y, gradient += columns) {
        const auto add = [&](std::int64_t padded_row) {
            const float* const row = out_gradient + padded_row * stride;
            for (std::int64_t x = 0; x < stride; ++x)
                sum[x] += row[x];
        };
        std::copy_n(out_gradient + (y + 1) * stride, stride, sum.begin());
        if (y == 0)
            add(0);
        if (y == rows - 1)
            add(rows + 1);
        sum[1] += sum[0];
        sum[columns] += sum[columns + 1];
        const float* const values = out + (y + 1) * stride + 1;
        for (std::int64_t x = 0; x < columns; ++x)
            gradient[x] = values[x] > 0 ? sum[x + 1] : 0;
    }
}

struct ReluWithBorder : torch::autograd::Function<ReluWithBorder> {
    static torch::Tensor forward(torch::autograd::AutogradContext* context, const torch::Tensor& input)
    {
        const torch::Tensor x = input.contiguous();
        const std::int64_t rows = x.size(2), columns = x.size(3);
        torch::Tensor out = torch::empty({ x.size(0), x.size(1), rows + 2, columns + 2 }, x.options());
        const float* const in = x.data_ptr<float>();
        float* const values = out.data_ptr<float>();
        at::parallel_for(0, x.size(0) * x.size(1), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t c = begin; c < end; ++c)
                forward_plane(in + c * rows * columns, values + c * (rows + 2) * (columns + 2), rows, columns);
        });
        context->save_for_backward({ out });
        return out;
    }

    static torch::autograd::variable_list backward(torch::autograd::AutogradContext* context,
                                                   const torch::autograd::variable_list& gradients)
    {
        const torch::Tensor out = context->get_saved_variables()[0], out_gradient = gradients[0].contiguous();
        const std::int64_t rows = out.size(2) - 2, columns = out.size(3) - 2;
        torch::Tensor gradient = torch::empty({ out.size(0), out.size(1), rows, columns }, out.options());
        const float *const values = out.data_ptr<float>(), *const given = out_gradient.data_ptr<float>();
        float* const result = gradient.data_ptr<float>();
        at::parallel_for(0, out.size(0) * out.size(1), 1, [&](std::int64_t begin, std::int64_t end) {
            for (std::int64_t c = begin; c < end; ++c) {
                const std::int64_t padded = c * (rows + 2) * (columns + 2);
                backward_plane(values + padded, given + padded, result + c * rows * columns, rows, columns);
            }
        });
        return { gradient };
    }
};

} // namespace

torch::Tensor relu_with_border(const torch::Tensor& x)
{
    if (!x.is_cpu() || x.scalar_type() != torch::kFloat32)
        return torch::replication_pad2d(torch::relu(x), { 1, 1, 1, 1 });
    return ReluWithBorder::apply(x);
}

} // namespace srisp::train
