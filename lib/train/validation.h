// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "evaluation.h"
#include "training_run.h"

namespace srisp::train {

struct ValidationSettings {
    std::string score = "real";
    EvaluationSettings set;

    template<class Visitor> void describe(Visitor& v)
    {
        v.choice("score", score, { "real", "simulated", "all" },
                 "the model with the highest mean of PSNR (dB) - angular error (degrees) - 10 x highlight error over "
                 "these test "
                 "images, in both renderings, is kept");
        v.group("set", set);
    }
};

/// What counts of an evaluation; of the images that there are, where there are none of the kind asked for.
Validation validation_of(const Scores& scores, const std::string& score);

} // namespace srisp::train
