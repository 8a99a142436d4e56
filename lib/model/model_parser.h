// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <srisp/expected.h>

#include "model/model_data.h"

namespace srisp {

/// Checks the bytes of a model file in full and brings it to float32; name, path and hash stay empty. `where` starts
/// every message ("model 'm.safetensors'").
Expected<std::unique_ptr<ModelData>> parse_model(const std::string& bytes, const std::string& where);

} // namespace srisp
