// SPDX-License-Identifier: Apache-2.0
#include "train/evaluation/evaluation.h"

#include <cmath>

#include <doctest/doctest.h>

#include "lib/train/small_pack.h"
#include "pack/training_pack_writer.h"
#include "random_model.h"
#include "train/baselines/baselines.h"

using namespace srisp;
using namespace srisp::train;

namespace {

void add_images(PackImagesWriter& writer, const SmallImages& small, bool two_cameras)
{
    const PackedImages& images = small.images;
    for (std::size_t i = 0; i < images.entries.size(); ++i) {
        PackScene scene;
        scene.common = images.entries[i];
        scene.common.name = std::to_string(i);
        scene.common.source = scene.common.licence = "a test";
        scene.common.validation = true;
        if (two_cameras)
            scene.common.group = i % 2 ? "Odd" : "Even";
        scene.crops.push_back({ 0, 0, 1, 1 });
        REQUIRE(writer.add(scene, *images.image(i)));
    }
}

/// A pack of photos and as many RAW images of two cameras, all for validation, and small_cameras().
std::shared_ptr<const TrainingPack> make_pack(const std::string& folder, int scenes)
{
    auto pack = TrainingPackWriter::create(folder, true);
    REQUIRE(pack);
    PackImagesWriter photos((*pack)->photos_path(), kSmallestPackImage), raws((*pack)->raws_path(), kSmallestPackImage);
    add_images(photos, SmallImages(scenes, 0, 0, kSmallestPackImage, 1), false);
    add_images(raws, SmallImages(scenes, 0, 0, kSmallestPackImage, 2), true);
    REQUIRE((*pack)->add_photos(photos));
    REQUIRE((*pack)->add_raws(raws));
    const PackedCameras cameras = small_cameras();
    PackCamerasIndex names;
    for (std::size_t i = 0; i < cameras.names.size(); ++i)
        names.cameras.push_back({ cameras.names[i], "", "a test", "CC0", cameras.validation[i] });
    for (std::size_t i = 0; i < cameras.light_names.size(); ++i)
        names.lights.push_back({ cameras.light_names[i], cameras.light_kinds[i], "a test", "CC0", false });
    REQUIRE((*pack)->add_cameras(cameras, names));
    const Status finished = (*pack)->finish("a test", nlohmann::json::object());
    REQUIRE_MESSAGE(finished, finished.error().message);
    auto opened = TrainingPack::open(folder);
    REQUIRE_MESSAGE(opened, (opened ? "" : opened.error().message));
    return *opened;
}

EvaluationSettings small_settings()
{
    EvaluationSettings settings;
    settings.real_images = 3;
    settings.simulated_images = 4;
    return settings;
}

std::shared_ptr<const EvaluationSet> make_set(const EvaluationSettings& settings)
{
    const ScratchFolder folder;
    auto set = EvaluationSet::make(settings, *make_pack(folder.path("pack"), 6));
    REQUIRE_MESSAGE(set, (set ? "" : set.error().message));
    return *set;
}

/// Gain match whose results are 10 % too dark; notes how large the images were that parameters were chosen on.
struct DarkGainMatch : GainMatch {
    std::int64_t thumbnail_width = 0;

    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice) override
    {
        thumbnail_width = source.size(3);
        return GainMatch::reverse(source, reference, choice) * 0.9;
    }
    torch::Tensor apply_reverse(const torch::Tensor& image, const ChosenParameters& choice) override
    {
        return GainMatch::apply_reverse(image, choice);
    }
};

/// Two grey pixels, of which the second is the highlight, against a truth of 0.5 and 0.9.
ScoreGroup group_of(const char* set, float dark, float bright)
{
    const std::vector<float> result{ dark, dark, dark, bright, bright, bright },
        truth{ 0.5f, 0.5f, 0.5f, 0.9f, 0.9f, 0.9f };
    ScoreGroup group;
    group.set = set;
    group.rendering = "random";
    group.model.add({ result.data(), 2, 1, 3, 6 }, { truth.data(), 2, 1, 3, 6 });
    return group;
}

} // namespace

TEST_CASE("gain match, evaluated as a method, scores as the gain match beside it")
{
    GainMatch method;
    const Scores scores = evaluate(method, *make_set(small_settings()));
    // Real: two cameras; simulated: one; both in three renderings, and all cameras of each.
    CHECK(scores.groups.size() == 3 * (2 + 1) + 3 * (1 + 1));
    for (const ScoreGroup& group : scores.groups) {
        INFO(group.set, ", ", group.rendering, ", ", group.camera);
        CHECK(group.psnr_gain() == 0);
        CHECK(group.angle_ratio() == 1);
        CHECK(group.gain_match.log_error_mean() == group.model.log_error_mean());
        CHECK(std::isfinite(group.gain_match.psnr()));
        CHECK(group.gain_match_oracle.psnr() > group.gain_match.psnr());
        CHECK(std::abs(group.gain_match_oracle.log_error_mean()) < 0.05);
    }
    const ScoreGroup* real = scores.find("real", "fixed");
    REQUIRE(real);
    CHECK(real->cameras == 2);
    CHECK(real->model.crops == 12);
    CHECK(scores.find("simulated", "random")->model.crops == 8);
}

TEST_CASE("the true mean makes up for a method's brightness, and the true means for its colour, too")
{
    DarkGainMatch method;
    const Scores scores = evaluate(method, *make_set(small_settings()));
    const ScoreGroup* group = scores.find("simulated", "fixed");
    REQUIRE(group);
    // Clipped values, which the gain can't bring back, leave a little.
    CHECK(group->model.log_error_mean() ==
          doctest::Approx(group->gain_match.log_error_mean() + std::log(0.9)).epsilon(1e-3));
    CHECK(group->model_oracle.psnr() >= group->model_oracle_gain.psnr());
    CHECK(std::abs(group->model_oracle.log_error_mean()) < 0.02);
}

TEST_CASE("the same settings give the same scores, another seed others")
{
    GainMatch method;
    EvaluationSettings settings = small_settings();
    const double first = evaluate(method, *make_set(settings)).find("real", "random")->model.psnr();
    CHECK(evaluate(method, *make_set(settings)).find("real", "random")->model.psnr() == first);
    settings.seed = 2;
    CHECK(evaluate(method, *make_set(settings)).find("real", "random")->model.psnr() != first);
}

/// Gain match that says how sure it is: of ln brightness, 0.5.
struct SureGainMatch : DarkGainMatch {
    torch::Tensor reverse(const torch::Tensor& source, const torch::Tensor& reference,
                          ChosenParameters* choice) override
    {
        auto result = DarkGainMatch::reverse(source, reference, choice);
        choice->log_deviation = torch::full({ source.size(0) }, std::log(0.5));
        return result;
    }
    int selection_size() const override { return m_size; }
    int m_size = 0;
};

TEST_CASE("how sure a method says it is is held against its errors")
{
    SureGainMatch method;
    const Scores scores = evaluate(method, *make_set(small_settings()));
    const Measure& model = scores.find("real", "random")->model;
    REQUIRE(model.deviations.size() == 12);
    CHECK(model.mean_deviation_ev() == doctest::Approx(0.5 / std::log(2.0)));
    // Scaled so that 68 % of the errors lie within one deviation, they do.
    const double factor = model.deviation_factor();
    CHECK(model.share_within(factor * 1.0001) == doctest::Approx(0.6827).epsilon(0.13));
    CHECK(model.share_within(factor * 0.9) < model.share_within(factor * 1.0001));
    CHECK(model.share_within(1e9) == 1);
    CHECK(std::isnan(scores.find("real", "random")->gain_match.deviation_factor()));
    const Validation validation = validation_of(scores, "real");
    double logs = 0;
    for (const char* rendering : { "random", "fixed", "camera" })
        logs += std::log(scores.find("real", rendering)->model.deviation_factor()) / 3;
    CHECK(validation.deviation_factor == doctest::Approx(std::exp(logs)));
    GainMatch silent;
    CHECK(validation_of(evaluate(silent, *make_set(small_settings())), "real").deviation_factor == 1);
}

TEST_CASE("without thumbnail_px parameters are chosen at the method's own size")
{
    SureGainMatch method;
    method.m_size = 32;
    evaluate(method, *make_set(small_settings()));
    CHECK(method.thumbnail_width == 32);
}

TEST_CASE("thumbnail_px says on how large an image parameters are chosen; what is scored is the crop")
{
    DarkGainMatch method;
    EvaluationSettings settings = small_settings();
    evaluate(method, *make_set(settings));
    CHECK(method.thumbnail_width == 16);
    settings.thumbnail_px = 40;
    const Scores scores = evaluate(method, *make_set(settings));
    CHECK(method.thumbnail_width == 40);
    // Applied, not taken from the thumbnail's own result, which is darker.
    CHECK(scores.find("real", "fixed")->psnr_gain() == 0);
}

TEST_CASE("photos with references of others: gain match follows the references' brightness in every channel")
{
    GainMatch method;
    EvaluationSettings settings = small_settings();
    settings.unpaired_photos = 2;
    settings.unpaired_references = 5;
    const Scores scores = evaluate(method, *make_set(settings));
    REQUIRE(scores.unpaired);
    CHECK(scores.unpaired->photos == 2);
    CHECK(scores.unpaired->references == 5);
    for (int c = 0; c < 3; ++c)
        CHECK(scores.unpaired->model.rank_lowest[c] == doctest::Approx(1));
    CHECK(scores.unpaired->model.intersection > 0.1);
    CHECK(scores.unpaired->model.intersection < 1);
}

TEST_CASE("training mode is as it was before, and a pack with nothing to test on is an error")
{
    GainMatch method;
    EvaluationSettings settings = small_settings();
    method.train();
    evaluate(method, *make_set(settings));
    CHECK(method.is_training());
    settings.real_images = settings.simulated_images = 0;
    const ScratchFolder folder;
    const auto set = EvaluationSet::make(settings, *make_pack(folder.path("pack"), 2));
    REQUIRE(!set);
    CHECK(set.error().message ==
          "evaluation: the pack has neither real RAW images nor photos and cameras marked for validation");
}

TEST_CASE("A validation's score takes one dB for each tenth that the highlights are off at one gain")
{
    Scores scores;
    scores.groups = { group_of("real", 0.25f, 0.40f) };
    const Validation result = validation_of(scores, "real");
    CHECK(result.angle == doctest::Approx(0).epsilon(1e-3).scale(1));
    // Twice as bright it is 0.5 and 0.8: 0.1 off.
    CHECK(result.score == doctest::Approx(result.psnr - result.angle - 1).epsilon(1e-4));
}

TEST_CASE("A validation without highlights has a score")
{
    Scores scores;
    scores.groups = { group_of("real", 0.4f, 0.9f) };
    scores.groups[0].model.highlights = {};
    const Validation result = validation_of(scores, "real");
    CHECK(result.score == doctest::Approx(result.psnr - result.angle));
}

TEST_CASE("A validation counts the set that is asked for, and all where that is not there")
{
    Scores scores;
    scores.groups = { group_of("real", 0.5f, 0.8f), group_of("simulated", 0.5f, 0.7f) };
    const double real = validation_of(scores, "real").psnr, simulated = validation_of(scores, "simulated").psnr;
    CHECK(real > simulated);
    CHECK(validation_of(scores, "all").psnr == doctest::Approx((real + simulated) / 2));
    scores.groups.pop_back();
    CHECK(validation_of(scores, "simulated").psnr == doctest::Approx(real));
}
