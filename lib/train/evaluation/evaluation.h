// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "train/evaluation/scores.h"
#include "train/evaluation/test_scenes.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

/// Test images, made once: the same crops for every method that is held against them. Made of a pack's real RAW images
/// and of simulated cameras, photos and lights that are marked for validation; each rendered to photos (random,
/// fixed, camera, see test_scenes.h; by RAW converters, see developed_images.h) and half split: the left half of the
/// RAW is the reference, the top and the bottom of the right half are two inputs. Packs hold squares, so halves are
/// twice as high as wide. [P 4.3; method 5]
class EvaluationSet {
public:
    /// Errors: nothing in the pack to test on.
    static Expected<std::shared_ptr<const EvaluationSet>> make(const EvaluationSettings& settings,
                                                               const TrainingPack& pack);
    ~EvaluationSet();
    EvaluationSet(const EvaluationSet&) = delete;
    EvaluationSet& operator=(const EvaluationSet&) = delete;

    int crops() const; ///< in all sets and renderings

private:
    friend Scores evaluate(Unprocessor& method, const EvaluationSet& set, const std::function<void(int)>& progress);
    struct State;
    explicit EvaluationSet(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

/// Runs a method on all test images, without gradients, on the device where its parameters are. `progress` gets the
/// number of crops that are done, now and then.
Scores evaluate(Unprocessor& method, const EvaluationSet& set, const std::function<void(int)>& progress = {});

/// What a model is kept for.
struct ValidationSettings {
    std::string score = "real";
    EvaluationSettings set;

    template<class Visitor> void describe(Visitor& v)
    {
        v.choice("score", score, { "real", "simulated", "all" },
                 "the model with the highest mean of PSNR (dB) - angular error (degrees) - 10 x highlight error over "
                 "these test images, in all renderings, is kept");
        v.group("set", set);
    }
};

/// What a validation found.
struct Validation {
    double score = 0;            ///< the model with the highest is kept
    double psnr = 0, angle = 0;  ///< for people: dB and degrees
    double deviation_factor = 1; ///< by which the deviations that the model tells are too small
    nlohmann::ordered_json details;
};

/// What counts of an evaluation; of the images that there are, where there are none of the kind asked for.
Validation validation_of(const Scores& scores, const std::string& score);

} // namespace srisp::train
