// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include <srisp/expected.h>

#include "train/network/model_settings.h"
#include "train/network/unprocessor.h"

namespace srisp::train {

/// Whether the tools that use models can run this one: it has SRISP's pipeline. (Not: U-Net, gain match, UPI, and where
/// gain and white balance are merged.)
bool is_srisp_model(const ModelSettings& settings);

/// The method that the settings name; every random number comes from the seed.
std::shared_ptr<Unprocessor> make_unprocessor(const ModelSettings& settings, std::uint64_t seed);

/// Writes a model made with `settings`: `srisp-7`, or `srisp-1` [method 3] without an anchor network, where
/// `is_srisp_model`, with the parts that an ablation lacks filled in so that it computes the same; else
/// `srisp-baseline-1`, which only this program reads. `type`: "F32" or "F16" (rounded to nearest). `metadata` must have
/// train_data and license; train_commit, date and metrics are welcome; what the format itself says (kernel_size, …) is
/// added. The deviations that the model tells become `deviation_factor` times as large. Whole or not at all. Errors:
/// what `metadata` lacks, values that are not finite or do not fit, the disk's own.
Status save_model(const Unprocessor& model, const ModelSettings& settings, const std::string& path,
                  std::map<std::string, std::string> metadata, const std::string& type = "F32",
                  double deviation_factor = 1);

/// A model that was read; `settings` made it.
struct LoadedModel {
    std::shared_ptr<Unprocessor> model;
    ModelSettings settings;
    std::map<std::string, std::string> metadata;
};

/// Reads either format. Errors: as parse_model's and parse_safetensors'.
Expected<LoadedModel> load_model(const std::string& path);

} // namespace srisp::train
