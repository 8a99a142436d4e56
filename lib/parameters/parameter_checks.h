// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/parameters.h>

namespace srisp {

/// Whether `apply` can use the values: gain, gamma and white balance finite and > 0, C not singular. `what` starts the
/// message.
Status check_values(const Parameters& parameters, const std::string& what);

} // namespace srisp
