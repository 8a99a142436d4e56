// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "result/result_image.h"

namespace srisp {

/// Whether our reader answers for a name: it has our form, and what lies on disk under it (if anything) is a recipe or
/// a stub. Calls nothing of OpenImageIO's (see parse_name).
bool is_our_name(const std::string& name);

/// Opens what a host asks for: a name with a query, a recipe, a stub of the hand-over, each with configuration hints.
Expected<std::unique_ptr<ResultImage>> open_name(const std::string& name, const OIIO::ImageSpec& config);

/// Reads the job file that a stub's path (or the temporary name of one) belongs to; sets name and frame in it.
Expected<Recipe> read_job(const std::string& stub_path, std::string& frame);

} // namespace srisp
