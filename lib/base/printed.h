// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// What printf would print in the C locale, whatever the host's is: of any length, with a point in numbers.
__attribute__((format(printf, 1, 2))) std::string printed(const char* format, ...);

} // namespace srisp
