// SPDX-License-Identifier: Apache-2.0
#include "photo_scores.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <srisp/apply.h>
#include <srisp/metrics.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

#include "require.h"

using namespace srisp;

namespace {

Picture apply(const Model& model, const Parameters& parameters, Direction direction, const Picture& image)
{
    Picture result(image.width, image.height);
    require(require(Applier::create(model, parameters, direction))->run(image.view(), result.mutable_view()));
    return result;
}

std::array<double, 3> channel_means(ImageView image)
{
    std::array<double, 3> sums{};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                sums[c] += image.pixel(x, y)[c];
    for (double& sum : sums)
        sum /= double(image.width) * image.height;
    return sums;
}

/// Adds the colour that pixels clipped to white in `photo` have in `round_trip`.
void add_white(const Picture& photo, const Picture& round_trip, PhotoScores& scores)
{
    std::array<double, 3> sum{};
    std::int64_t count = 0;
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        if (std::min({ photo.rgb[i], photo.rgb[i + 1], photo.rgb[i + 2] }) < 1)
            continue;
        ++count;
        for (int c = 0; c < 3; ++c)
            sum[c] += round_trip.rgb[i + c];
    }
    if (count == 0)
        return;
    const double grey = (sum[0] + sum[1] + sum[2]) / 3;
    for (int c = 0; c < 3; ++c) {
        scores.white[c] += sum[c];
        scores.worst_white = std::max(scores.worst_white, std::abs(sum[c] - grey) / count);
    }
    scores.white_pixels += count;
}

} // namespace

PhotoScores judge_photo(const Model& model, const std::string& path,
                        const std::vector<std::shared_ptr<const Reference>>& references, const Sheets& sheets, int row)
{
    const Picture photo = load_photo(path);
    const Thumbnail thumbnail = make_thumbnail(photo.view());
    sheets.paste(photo, 1, 0, row);
    PhotoScores scores;
    scores.name = std::filesystem::path(path).filename();
    std::array<std::vector<double>, 3> results, wanted;
    for (std::size_t i = 0; i < references.size(); ++i) {
        const Parameters parameters = require(srisp::select(model, thumbnail, references[i]->thumbnail));
        const Picture raw = apply(model, parameters, Direction::reverse, photo);
        const Picture again = apply(model, parameters, Direction::forward, raw);
        scores.round_trip_db.push_back(psnr(again.view(), photo.view()));
        add_white(photo, again, scores);
        const auto result_means = channel_means(raw.view());
        const auto reference_means = channel_means(references[i]->thumbnail.view());
        for (int c = 0; c < 3; ++c) {
            results[c].push_back(std::log(std::max(result_means[c], 1e-6)));
            wanted[c].push_back(std::log(std::max(reference_means[c], 1e-6)));
        }
        Sheets{ sheets.results, nullptr }.paste(raw, kDisplayExponent, int(i) + 1, row);
        Sheets{ nullptr, sheets.round_trips }.paste(again, 1, int(i) + 1, row);
    }
    for (int c = 0; c < 3; ++c) {
        scores.rank[c] = rank_correlation(results[c], wanted[c]);
        scores.white[c] /= std::max<std::int64_t>(1, scores.white_pixels);
    }
    return scores;
}
