// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/unpaired_evaluation.h"

#include <algorithm>
#include <cmath>

#include "metrics/rank_correlation.h"
#include "train/evaluation/measure.h"
#include "train/evaluation/test_scenes.h"
#include "train/network/unprocessor.h"
#include "train/samples/packed_images.h"
#include "train/tensors/resize.h"

namespace srisp::train {

namespace {

/// Camera RGB as recorded → XYZ: white balance, then the camera's own matrix.
Matrix3 camera_to_xyz(const torch::Tensor& white_balance, const torch::Tensor& color)
{
    const auto srgb_to_xyz = torch::tensor(at::ArrayRef<float>(kSrgbToXyz)).view({ 3, 3 });
    const auto matrix = srgb_to_xyz.matmul(color).matmul(torch::diag(white_balance)).contiguous();
    Matrix3 result;
    std::copy_n(matrix.data_ptr<float>(), 9, result.begin());
    return result;
}

/// ln of the channel means [N, 3].
torch::Tensor log_means(const torch::Tensor& images)
{
    return images.to(torch::kDouble).mean(at::IntArrayRef{ 2, 3 }).clamp_min(1e-6).log();
}

std::vector<double> column(const torch::Tensor& values, int channel)
{
    const auto one = values.select(1, channel).contiguous();
    return { one.data_ptr<double>(), one.data_ptr<double>() + one.numel() };
}

UnpairedScores::Method score(Unprocessor& method, const UnpairedImages& images, int thumbnail_px)
{
    UnpairedScores::Method scores;
    scores.rank_lowest = { 1, 1, 1 };
    LabHistogram of_results, of_references;
    const InterleavedImages references(images.references);
    const auto reference_means = log_means(images.references);
    for (std::int64_t photo = 0; photo < images.photos.size(0); ++photo) {
        const auto source = images.photos.slice(0, photo, photo + 1).expand_as(images.references);
        const auto results = batched_reverse(method, source, images.references, thumbnail_px);
        const InterleavedImages views(results);
        for (std::size_t i = 0; i < images.camera_to_xyz.size(); ++i) {
            of_results.add(views[i], images.camera_to_xyz[i]);
            of_references.add(references[i], images.camera_to_xyz[i]);
        }
        const auto result_means = log_means(results);
        for (int c = 0; c < 3; ++c) {
            const double correlation = rank_correlation(column(result_means, c), column(reference_means, c));
            scores.rank_mean[c] += correlation / images.photos.size(0);
            scores.rank_lowest[c] = std::min(scores.rank_lowest[c], correlation);
        }
    }
    scores.intersection = of_results.intersection(of_references);
    return scores;
}

} // namespace

std::optional<UnpairedImages> make_unpaired_images(const EvaluationSettings& settings, const PackedImages& photos,
                                                   const std::vector<TestScenes>& sets, const torch::Tensor& matrices,
                                                   Unprocessor& gain_match)
{
    std::vector<torch::Tensor> chosen, raws, references;
    const std::vector<std::size_t> candidates = whole_images(photos, true);
    for (const std::size_t i : evenly_spread(candidates.size(), settings.unpaired_photos))
        chosen.push_back(packed_image(photos, candidates[i]));
    if (chosen.empty())
        return std::nullopt;
    std::vector<Matrix3> to_xyz;
    for (const TestScenes& scenes : sets) {
        if (scenes.camera.empty())
            continue;
        const auto colors = known_colors(scenes.color, matrices);
        for (std::size_t i = 0; i < scenes.camera.size(); ++i) {
            raws.push_back(scenes.raw[i]);
            to_xyz.push_back(camera_to_xyz(scenes.white_balance[i], colors[i]));
        }
    }
    UnpairedImages images;
    for (const std::size_t i : evenly_spread(raws.size(), settings.unpaired_references)) {
        // The sets may differ in size.
        references.push_back(area_resize(raws[i].unsqueeze(0), photos.size, photos.size));
        images.camera_to_xyz.push_back(to_xyz[i]);
    }
    images.photos = torch::stack(chosen);
    images.references = torch::cat(references);
    images.gain_match = score(gain_match, images, settings.thumbnail_px);
    return images;
}

UnpairedScores evaluate_unpaired(Unprocessor& method, const UnpairedImages& images, int thumbnail_px)
{
    UnpairedScores scores;
    scores.photos = static_cast<int>(images.photos.size(0));
    scores.references = static_cast<int>(images.references.size(0));
    scores.gain_match = images.gain_match;
    scores.model = score(method, images, thumbnail_px);
    return scores;
}

} // namespace srisp::train
