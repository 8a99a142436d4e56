// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include <srisp/expected.h>
#include <srisp/options.h>
#include <srisp/parameters.h>

#include "../common/file_list.h"

namespace srisp::tool {

/// The parameters of a shot: those that are chosen for its first photo, as bright as `options` ask for. The last ones
/// are kept. Threads: safe.
Expected<Parameters> shot_parameters(const ListedFile& first, const std::string& reference, std::uint64_t seed,
                                     const Options& options);

} // namespace srisp::tool
