// SPDX-License-Identifier: Apache-2.0
#include "test_renderings.h"

#include "dnd_cameras.h"
#include "random_isp.h"
#include "simulated_camera.h"

namespace srisp::train {

namespace {

// Apart from all other draws of the evaluation.
constexpr std::uint64_t kLightStream = 0x6c69676874, kRenderingStream = 0x72656e646572;

/// Method.md section 4 and the second series of section 6, written out so that other defaults change no score.
RandomIspSettings random_test_isp()
{
    RandomIspSettings isp;
    isp.true_white_balance = 0.5;
    isp.white_balance_error = 0.04;
    isp.auto_exposure = 0.75;
    isp.lowest_target = 0.5;
    isp.highest_target = 1.2;
    isp.average_metering = 0;
    isp.lowest_gain = 1;
    isp.highest_gain = 2;
    isp.mixed_matrices = 3;
    isp.linear_saturation = 0;
    isp.shoulder = 0;
    isp.lowest_gamma = 2.0;
    isp.highest_gamma = 3.2;
    isp.smoothstep = "random";
    isp.smoothstep_share = 0.4;
    isp.local_contrast = 0;
    isp.channel_curves = 0;
    return isp;
}

} // namespace

torch::Tensor test_matrices(const TrainingPack& pack, int seed)
{
    const SimulatedCameras cameras(pack.cameras());
    std::vector<torch::Tensor> matrices;
    for (int camera = 0; camera < cameras.count(); ++camera) {
        if (cameras.validation()[camera])
            continue;
        Random random(seed, kLightStream, camera);
        const CameraColor color = camera_color(cameras.to_camera(camera, cameras.draw_light(LightSettings(), random)));
        matrices.push_back(torch::tensor(at::ArrayRef<float>(color.color)).view({ 3, 3 }));
    }
    return matrices.empty() ? torch::inverse(dnd_rgb_to_camera()) : torch::stack(matrices);
}

torch::Tensor random_rendering(const TestScenes& scenes, const torch::Tensor& matrices, int seed)
{
    Randoms randoms;
    for (std::int64_t n = 0; n < scenes.raw.size(0); ++n)
        randoms.emplace_back(seed, kRenderingStream, n);
    return render_random(random_test_isp(), scenes.raw, scenes.white_balance, matrices.unsqueeze(0), randoms);
}

torch::Tensor fixed_rendering(const TestScenes& scenes, const torch::Tensor& matrices)
{
    return render_fixed(scenes.raw, scenes.white_balance, known_colors(scenes.color, matrices), torch::tensor(0.9));
}

torch::Tensor known_colors(const torch::Tensor& colors, const torch::Tensor& matrices)
{
    const auto known = colors.abs().sum({ 1, 2 }, true) > 0;
    return torch::where(known, colors, matrices.mean(0, true));
}

} // namespace srisp::train
