// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace srisp::tool {

/// The command line of srisptrain.
struct TrainOptions {
    std::string recipe, pack, output, init, device = "auto";
    std::vector<std::string> assignments;
    int steps = 0;   ///< 0: the recipe's
    int threads = 0; ///< 0: as many as there are processors
    int nodes = 0;   ///< 0: from the environment
    int rank = -1;   ///< -1: from the environment
    std::string address;
    int timeout_s = 600;
    bool dry_run = false, restart = false, list_settings = false, list_recipes = false, quiet = false;
};

void describe_options(CLI::App& app, TrainOptions& options);

} // namespace srisp::tool
