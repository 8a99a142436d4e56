// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <vector>

#include <doctest/doctest.h>
#include <srisp/metrics.h>

using namespace srisp;

namespace {

ImageView view(const std::vector<float>& rgb, int width, int height)
{
    return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width };
}

/// The formula as the paper has it, with a window of two dimensions and moments about the means.
double plain_ssim(const std::vector<float>& a, const std::vector<float>& b, int width, int height)
{
    double total = 0, places = 0, weight_sum = 0;
    double weights[11][11];
    for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 11; ++i)
            weight_sum += weights[j][i] = std::exp(-((i - 5) * (i - 5) + (j - 5) * (j - 5)) / 4.5);
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y + 11 <= height; ++y)
            for (int x = 0; x + 11 <= width; ++x) {
                const auto value = [&](const std::vector<float>& image, int i, int j) {
                    return double(image[std::size_t(((y + j) * width + x + i) * 3 + c)]);
                };
                double means[2] = {}, variances[2] = {}, covariance = 0;
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 11; ++i) {
                        means[0] += weights[j][i] / weight_sum * value(a, i, j);
                        means[1] += weights[j][i] / weight_sum * value(b, i, j);
                    }
                for (int j = 0; j < 11; ++j)
                    for (int i = 0; i < 11; ++i) {
                        const double da = value(a, i, j) - means[0], db = value(b, i, j) - means[1];
                        variances[0] += weights[j][i] / weight_sum * da * da;
                        variances[1] += weights[j][i] / weight_sum * db * db;
                        covariance += weights[j][i] / weight_sum * da * db;
                    }
                total += (2 * means[0] * means[1] + 1e-4) / (means[0] * means[0] + means[1] * means[1] + 1e-4) *
                         (2 * covariance + 9e-4) / (variances[0] + variances[1] + 9e-4);
                ++places;
            }
    return total / places;
}

} // namespace

TEST_CASE("structural similarity is the paper's formula, 1 for equal images, and not a number for tiny ones")
{
    constexpr int width = 19, height = 14;
    std::vector<float> truth, result;
    for (int i = 0; i < width * height * 3; ++i) {
        truth.push_back(0.5f + 0.4f * std::sin(0.37f * float(i)) * std::cos(0.011f * float(i)));
        result.push_back(0.05f + 0.8f * truth.back() + 0.03f * std::sin(1.7f * float(i)));
    }
    CHECK(ssim(view(result, width, height), view(truth, width, height)) ==
          doctest::Approx(plain_ssim(result, truth, width, height)).epsilon(1e-9));
    CHECK(ssim(view(truth, width, height), view(truth, width, height)) == doctest::Approx(1));
    CHECK(std::isnan(ssim(view(truth, width, 10), view(truth, width, 10))));
    std::vector<float> bright = truth, clipped = truth;
    bright[40] = 7;
    clipped[40] = 1;
    CHECK(ssim(view(bright, width, height), view(truth, width, height)) ==
          ssim(view(clipped, width, height), view(truth, width, height)));
}
