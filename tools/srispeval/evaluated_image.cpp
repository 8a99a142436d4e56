// SPDX-License-Identifier: Apache-2.0
#include "evaluated_image.h"

#include <algorithm>
#include <cmath>

#include <srisp/metrics.h>

#include "metric_table.h"
#include "picture_files.h"

namespace srisp::tool {

namespace {

Pixels reduced(const Pixels& pixels, int longest)
{
    const auto size = reduced_size(pixels.width, pixels.height, longest);
    return resized(pixels, size[0], size[1]);
}

/// Encodes pictures until one fails.
class Encoder {
public:
    explicit Encoder(int longest) : m_longest(longest) {}

    void photo(const Pixels& pixels, std::string& file) { keep(jpeg_of_photo(reduced(pixels, m_longest)), file); }
    void linear(const Pixels& pixels, std::string& file) { keep(png_of_linear(reduced(pixels, m_longest)), file); }
    const Status& status() const { return m_status; }

private:
    void keep(Expected<std::string> bytes, std::string& file)
    {
        if (bytes)
            file = std::move(*bytes);
        else if (m_status)
            m_status = bytes.error();
    }

    int m_longest;
    Status m_status;
};

std::array<double, 3> log_means(const Pixels& pixels)
{
    std::array<double, 3> means = pixels.means();
    for (double& mean : means)
        mean = std::log(std::max(mean, 1e-6));
    return means;
}

} // namespace

Expected<EvaluatedImage> evaluate_image(const TestImage& image, const Methods& methods,
                                        const MeasureSettings& measuring, const PictureSettings& settings)
{
    EvaluatedImage evaluated;
    evaluated.score = image.score;
    ImageScore& score = evaluated.score;
    const bool has_truth = !image.truth.rgb.empty();
    score.width = image.photo.width;
    score.height = image.photo.height;
    score.reference_chromaticity = chromaticity_of(image.reference);
    evaluated.reference_log_means = log_means(image.reference);
    if (has_truth)
        score.truth_chromaticity = chromaticity_of(image.truth);

    Encoder encoder(settings.longest);
    ImagePictures& pictures = evaluated.pictures;
    if (settings.longest > 0) {
        const auto size = reduced_size(image.photo.width, image.photo.height, settings.longest);
        const auto reference = reduced_size(image.reference.width, image.reference.height, settings.longest);
        pictures.width = size[0];
        pictures.height = size[1];
        pictures.reference_width = reference[0];
        pictures.reference_height = reference[1];
        pictures.white_balance = image.colors.white_balance;
        pictures.color = image.colors.to_srgb;
        encoder.photo(image.photo, pictures.photo);
        encoder.linear(image.reference, pictures.reference);
        if (has_truth)
            encoder.linear(image.truth, pictures.truth);
    }
    const std::string key = score.image + "/" + score.part + "/" + score.rendering + "/" + score.reference;
    for (const auto& method : methods) {
        const auto result = method->unprocess(image.photo, image.reference, key);
        if (!result)
            return Error{ method->name + ": " + result.error().message };
        LabCounts* const lab = image.colors.to_xyz ? &evaluated.lab[method->name] : nullptr;
        score.methods[method->name] =
            has_truth ? measure_result(image, *result, measuring, lab) : measure_unpaired(image, *result, lab);
        evaluated.log_means[method->name] = log_means(result->raw);
        if (settings.longest > 0)
            encoder.linear(result->raw, pictures.results[method->name]);
    }
    if (!encoder.status())
        return encoder.status().error();
    return evaluated;
}

void add_rank_correlations(std::vector<EvaluatedImage>& images, const Methods& methods)
{
    const char* const keys[] = { key::kRankRed, key::kRankGreen, key::kRankBlue };
    for (const auto& method : methods)
        for (std::size_t c = 0; c < 3; ++c) {
            std::vector<double> results, references;
            for (const EvaluatedImage& image : images) {
                results.push_back(image.log_means.at(method->name)[c]);
                references.push_back(image.reference_log_means[c]);
            }
            const double correlation = rank_correlation(results, references);
            if (!std::isfinite(correlation))
                continue;
            const double share = 1 / double(images.size());
            for (EvaluatedImage& image : images)
                image.score.methods[method->name].values[keys[c]] = { correlation * share, share };
        }
}

} // namespace srisp::tool
