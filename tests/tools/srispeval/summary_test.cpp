// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/summary.h"

#include <doctest/doctest.h>

#include <cmath>

#include "some_scores.h"

using namespace srisp::tool;

namespace {

const GroupSummary* find(const std::vector<GroupSummary>& groups, const std::string& camera)
{
    for (const GroupSummary& group : groups)
        if (group.camera == camera)
            return &group;
    return nullptr;
}

} // namespace

TEST_CASE("each rendering is summed up as a whole and by camera, with the first method as the baseline")
{
    const std::vector<ImageScore> images{ some_score("a.dng", "X", 30, 35), some_score("a.dng", "X", 32, 37, "bottom"),
                                          some_score("b.dng", "Y", 20, 26) };
    const auto groups = summarize(images, { "first", "second" }, {});
    REQUIRE(groups.size() == 3);
    const GroupSummary& all = groups[0];
    CHECK(all.camera.empty());
    CHECK(all.images == 3);
    CHECK(all.files == 2);
    CHECK(all.cameras == 2);
    CHECK(all.methods[0].values.at(key::kPsnr).mean == doctest::Approx(82.0 / 3));
    const Interval over = all.methods[1].over_baseline.at(key::kPsnr);
    CHECK(over.mean == doctest::Approx(16.0 / 3));
    // Every draw of the two files lies between their own differences.
    CHECK(over.low == doctest::Approx(5));
    CHECK(over.high == doctest::Approx(6));
    CHECK(all.methods[0].over_baseline.empty());
    CHECK(all.methods[0].values.count(key::kHighlights) == 0);
    REQUIRE(find(groups, "Y"));
    CHECK(std::isnan(find(groups, "Y")->methods[0].values.at(key::kPsnr).low));
    // 0.30, 0.32, 0.20
    CHECK(all.methods[0].brightness_spread.mean == doctest::Approx(0.05249).epsilon(1e-3));
    CHECK(all.methods[0].error_by_level[3].mean == doctest::Approx(-0.05));
}

TEST_CASE("rank correlations over references are told of all cameras together only")
{
    std::vector<ImageScore> images{ some_score("a.jpg", "X", 30, 35), some_score("a.jpg", "Y", 20, 26) };
    for (ImageScore& image : images)
        image.methods["first"].values[key::kRankGreen] = { 0.4, 0.5 };
    const auto groups = summarize(images, { "first" }, {});
    CHECK(groups[0].methods[0].values.at(key::kRankGreen).mean == doctest::Approx(0.8));
    REQUIRE(find(groups, "Y"));
    CHECK(find(groups, "Y")->methods[0].values.count(key::kRankGreen) == 0);
}

TEST_CASE("cameras that no model has seen are a group of their own, where some are known to be seen")
{
    const std::vector<ImageScore> images{ some_score("a.dng", "X", 30, 35), some_score("b.dng", "Y", 20, 26),
                                          some_score("c.dng", "Z", 22, 27) };
    const auto groups = summarize(images, { "first", "second" }, { "X" });
    REQUIRE(find(groups, kUnseenCameras));
    CHECK(find(groups, kUnseenCameras)->files == 2);
    CHECK(find(summarize(images, { "first" }, {}), kUnseenCameras) == nullptr);
}
