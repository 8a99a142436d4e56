// SPDX-License-Identifier: Apache-2.0
// The renderings of tests, which know no LibTorch, against those of training, set to the same.
#include "rendering/test_rendering.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "lib/train/tensor_tools.h"

#include "train/evaluation/measure.h"
#include "train/samples/camera_isp.h"
#include "train/samples/random_isp.h"
#include "train/tensors/color.h"

using namespace srisp::train;
using srisp::Matrix3;
using srisp::Vector3;

namespace {

constexpr double kLargest = 1.01 / 255; // one code: where a value lies between two, both may round it their way

RandomIspSettings random_settings()
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
    isp.lowest_gamma = 2.0;
    isp.highest_gamma = 3.2;
    isp.smoothstep = "random";
    isp.smoothstep_share = 0.4;
    return isp;
}

CameraIspSettings camera_settings()
{
    CameraIspSettings isp;
    isp.plain = 0;
    isp.gain = 1.3;
    isp.gain_spread = 0.3;
    return isp;
}

/// Sixteen images of smooth colours, some of them clipped.
struct Images {
    torch::Tensor raw, balance, color, others;

    Images()
    {
        torch::manual_seed(3);
        raw = enlarge_noise(torch::rand({ 16, 3, 4, 4 })).clamp(0, 1);
        balance = torch::rand({ 16, 3 }) + 1;
        balance.select(1, 1).fill_(1);
        others = torch::inverse(srisp::train::dnd_rgb_to_camera());
        color = others.mean(0).expand({ 16, 3, 3 }).contiguous();
    }

    static torch::Tensor enlarge_noise(const torch::Tensor& noise)
    {
        return torch::upsample_bicubic2d(noise * 1.2, at::IntArrayRef{ 24, 24 }, false);
    }

    template<class Array> static Array values(const torch::Tensor& tensor)
    {
        const auto contiguous = tensor.contiguous();
        Array result;
        std::copy_n(contiguous.data_ptr<float>(), result.size(), result.begin());
        return result;
    }

    std::vector<Matrix3> other_matrices() const
    {
        std::vector<Matrix3> result;
        for (int k = 0; k < others.size(0); ++k)
            result.push_back(values<Matrix3>(others[k]));
        return result;
    }

    /// What `make` renders of each image.
    template<class Make> torch::Tensor rendered(const Make& make) const
    {
        const InterleavedImages views(raw);
        std::vector<torch::Tensor> photos;
        for (int n = 0; n < raw.size(0); ++n) {
            const auto photo = torch::empty({ 24, 24, 3 });
            const srisp::RawScene scene{ views[n], values<Vector3>(balance[n]), values<Matrix3>(color[n]) };
            srisp::render(make(n, scene), views[n], { photo.data_ptr<float>(), 24, 24, 3, 72 });
            photos.push_back(photo.permute({ 2, 0, 1 }));
        }
        return torch::stack(photos);
    }
};

Randoms randoms_of(std::int64_t count)
{
    Randoms randoms;
    for (std::int64_t n = 0; n < count; ++n)
        randoms.emplace_back(7, 11, n);
    return randoms;
}

/// Equal but for values that lie between two codes: few, and one code apart.
void check_equal(const torch::Tensor& a, const torch::Tensor& b)
{
    const auto difference = (a - b).abs();
    CHECK(difference.max().item<double>() < kLargest);
    CHECK((difference > 1e-4).to(torch::kFloat32).mean().item<double>() < 0.002);
    CHECK(a.std().item<double>() > 0.1);
}

} // namespace

TEST_CASE("the tests' random rendering is the trainer's with the tests' settings")
{
    const Images images;
    Randoms randoms = randoms_of(16);
    const auto expected =
        render_random(random_settings(), images.raw, images.balance, images.others.unsqueeze(0), randoms);
    const auto others = images.other_matrices();
    check_equal(images.rendered([&](int n, const srisp::RawScene& scene) {
        return srisp::random_rendering(scene, others, Random(7, 11, n));
    }),
                expected);
}

TEST_CASE("the tests' fixed rendering is the trainer's with the target 0.9")
{
    const Images images;
    const auto expected = render_fixed(images.raw, images.balance, images.color, torch::tensor(0.9));
    check_equal(images.rendered([](int, const srisp::RawScene& scene) { return srisp::fixed_rendering(scene); }),
                expected);
}

TEST_CASE("the tests' camera rendering is the trainer's with the tests' settings")
{
    const Images images;
    const auto others = images.other_matrices();
    std::vector<float> gains;
    for (int n = 0; n < 16; ++n) {
        gains.push_back(float(draw_camera_gain(camera_settings(), Random(5, n))));
        CHECK(srisp::draw_camera_gain(Random(5, n)) == doctest::Approx(gains.back()));
    }
    const auto expected = render_camera(camera_settings(), images.raw, images.balance, images.color,
                                        images.others.unsqueeze(0), torch::tensor(gains), randoms_of(16));
    check_equal(images.rendered([&](int n, const srisp::RawScene& scene) {
        return srisp::camera_rendering(scene, others, gains[n], Random(7, 11, n));
    }),
                expected);
}
