// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>

#include <srisp/expected.h>

#include "scores.h"
#include "settings.h"
#include "unprocessor.h"

namespace srisp {
class TrainingPack;
}

namespace srisp::train {

/// What is tested, and how much of it.
struct EvaluationSettings {
    int real_images = 24;
    bool real_validation_only = true;
    double exposure_low = 0.03, exposure_high = 1.25;
    int simulated_images = 96;
    int unpaired_photos = 0;
    int unpaired_references = 8;
    int thumbnail_px = 0;
    int seed = 1;

    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("real_images", real_images, 0, 100000, "real RAW images of each camera in the pack");
        v.flag("real_validation_only", real_validation_only, "real RAW: leave out what is meant for training");
        v.range("exposure", exposure_low, exposure_high, 1e-3, 100,
                "real RAW: where exposure puts the 98th percentile of an image, log-uniform (1: clipping begins)");
        v.integer("simulated_images", simulated_images, 0, 100000,
                  "simulated RAW images: validation photos, cameras and lights");
        v.integer("unpaired_photos", unpaired_photos, 0, 100000, "photos for the test without truth; 0: none");
        v.integer("unpaired_references", unpaired_references, 2, 1000, "references that each of these photos gets");
        v.integer("thumbnail_px", thumbnail_px, 0, 1024,
                  "side of the squares on which parameters are chosen; 0: the crops as they are");
        v.integer("seed", seed, 0, 1000000000, "of exposures, renderings and simulated cameras");
    }
};

/// Test images, made once: the same crops for every method that is held against them. Made of a pack's real RAW images
/// and of simulated cameras, photos and lights that are marked for validation; each rendered to a photo twice (random
/// and fixed, see test_renderings.h) and half split: the left half of the RAW is the reference, the top and the bottom
/// of the right half are two inputs. Packs hold squares, so halves are twice as high as wide. [P 4.3; method 5]
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

} // namespace srisp::train
