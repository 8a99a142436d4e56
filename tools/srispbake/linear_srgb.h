// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>

#include <OpenColorIO/OpenColorIO.h>

namespace srisp::tool {

/// How linear sRGB gets to the reference space of a config.
struct LinearSrgb {
    std::array<double, 9> to_reference;
    std::string found_by; ///< a colour space's name, or a role's
};

/// By a colour space `name`, or where that is empty, by the usual names, or by the role aces_interchange. Throws
/// Failure: none of these, or it is no matrix that takes them there.
LinearSrgb find_linear_srgb(const OCIO_NAMESPACE::ConstConfigRcPtr& config, const std::string& name);

} // namespace srisp::tool
