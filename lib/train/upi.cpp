// SPDX-License-Identifier: Apache-2.0
#include "upi.h"

#include "dnd_cameras.h"
#include "pipeline_blocks.h"
#include "random.h"

namespace srisp::train {

torch::Tensor inverse_smoothstep(const torch::Tensor& image)
{
    return 0.5 - torch::sin(torch::asin(1 - 2 * image.clamp(0, 1)) / 3);
}

Choice Upi::next_choice(std::int64_t images)
{
    const torch::Tensor cameras = dnd_rgb_to_camera();
    std::vector<torch::Tensor> rgb_to_camera, gains;
    for (std::int64_t i = 0; i < images; ++i) {
        Random random(m_seed, m_images_seen++);
        torch::Tensor weights = torch::empty({ cameras.size(0) });
        for (std::int64_t k = 0; k < weights.size(0); ++k)
            weights[k] = random.uniform(1e-3, 1);
        rgb_to_camera.push_back(torch::tensordot(weights / weights.sum(), cameras, { 0 }, { 0 }));
        const double gain = 1 / (0.8 + 0.1 * random.normal());
        gains.push_back(torch::tensor({ gain * random.uniform(1.9, 2.4), gain, gain * random.uniform(1.5, 1.9) }));
    }
    Choice choice;
    choice.gamma = torch::full({ images }, 2.2);
    choice.color = inverse3x3(torch::stack(rgb_to_camera));
    choice.white_balance = torch::stack(gains).to(torch::kFloat32);
    choice.gain = torch::ones({ images });
    return choice;
}

torch::Tensor Upi::reverse(const torch::Tensor& source, const torch::Tensor&, Choice* choice)
{
    Choice own = next_choice(source.size(0));
    for (torch::Tensor* value : { &own.gamma, &own.color, &own.white_balance, &own.gain })
        *value = value->to(source.device());
    if (choice)
        *choice = own;
    return apply_reverse(source, own);
}

torch::Tensor Upi::apply_reverse(const torch::Tensor& image, const Choice& choice)
{
    const torch::Tensor linear = power(inverse_smoothstep(image), choice.gamma);
    const torch::Tensor camera = torch::bmm(inverse3x3(choice.color), linear.flatten(2)).view_as(image);
    return inverse_gain(camera, choice.white_balance).clamp(0, 1);
}

torch::Tensor Upi::process(const torch::Tensor& raw, const Choice& choice)
{
    torch::Tensor v = (raw * choice.white_balance.view({ -1, 3, 1, 1 })).clamp(0, 1);
    v = power(color_transform(v, choice.color), choice.gamma.reciprocal());
    return 3 * v.square() - 2 * v.pow(3);
}

} // namespace srisp::train
