// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include <srisp/model.h>
#include <srisp/parameters.h>
#include <srisp/reference.h>

#include "options.h"
#include "photo_sample.h"

namespace srisp::tool {

/// A model and the parameters that it chose or was given.
struct Chosen {
    std::shared_ptr<const Model> model;
    Parameters parameters;
};

/// Everything that is baked, and what it is compared with.
struct Choice {
    Chosen pointwise;
    std::shared_ptr<const Reference> reference; ///< null where only parameters are given
    std::optional<PhotoSample> photo;           ///< likewise, unless --source is there
    bool photo_is_rendition = false;            ///< the reference's own neutral rendition stands in
    std::optional<Chosen> full;                 ///< `default` with the same photo and reference
};

/// Loads and chooses what the options ask for. Throws Failure.
Choice make_choice(const Options& options);

} // namespace srisp::tool
