// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/image.h>
#include <srisp/model.h>

#include "pixels.h"

namespace srisp::tool {

/// What a method made of a photo.
struct MethodResult {
    Pixels raw;                         ///< linear camera RGB in [0,1]
    std::optional<float> log_deviation; ///< standard deviation of ln brightness that it tells
    std::string parameters;             ///< what it chose, JSON text
};

/// What is held against the truth: a model, or a baseline. Threads: safe.
class Method {
public:
    virtual ~Method() = default;

    /// `photo`: display-encoded sRGB in [0,1]; `reference`: linear camera RGB, of any size; `key` names the test image,
    /// where chance decides something.
    virtual Expected<MethodResult> unprocess(const Pixels& photo, const Pixels& reference,
                                             const std::string& key) const = 0;

    std::string name;     ///< in tables
    std::string origin;   ///< which file and hash, or what the baseline does: one sentence
    std::string training; ///< what a model's file says of the images it was trained on
};

/// photo^2.2 times one gain for each channel that gives the reference's channel means. [method 4]
std::unique_ptr<Method> make_gain_match();

/// Random parameters that know neither photo nor reference. [UPI: Brooks et al. 2019]
std::unique_ptr<Method> make_upi(std::uint64_t seed);

/// What ships: select, then apply.
std::unique_ptr<Method> make_model_method(std::shared_ptr<const Model> model, std::string name);

using Methods = std::vector<std::unique_ptr<Method>>;

/// The baselines, then the models: names or paths. Names are made different where files have one name. Throws Failure.
Methods load_methods(const std::vector<std::string>& baselines, const std::vector<std::string>& models,
                     std::uint64_t seed);

/// Those of the cameras whose RAW images one of the models says it was trained on.
std::set<std::string> cameras_seen(const Methods& methods, const std::set<std::string>& cameras);

} // namespace srisp::tool
