// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

#include "bench_lines.h"
#include "picture.h"

// The four layers of the tone map [method 2].
constexpr double kMultiplyAddsPerPixel = 20160, kPointwiseMultiplyAddsPerPixel = kMultiplyAddsPerPixel / 9;

/// The photo of the settings, repeated to that size; without one, something smooth in places and busy in others.
Picture bench_picture(const BenchSettings& settings, int width, int height);

/// A model with parameters chosen for the photo and the reference of the settings.
struct BenchFixture {
    explicit BenchFixture(const BenchSettings& settings);

    std::shared_ptr<const srisp::Model> model;
    srisp::Thumbnail source, reference;
    srisp::Parameters parameters;

    std::shared_ptr<const srisp::Applier> applier(srisp::Precision precision = srisp::Precision::float32) const;
};

/// Seconds that the reverse pass takes in place. Throws std::runtime_error.
double apply_seconds(const srisp::Applier& applier, Picture& picture, int threads);

/// The middle one.
double median(std::vector<double> values);

/// "12.3", with that many digits after the point.
std::string digits(double value, int after_point);
