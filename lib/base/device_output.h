// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// Whether an output's name stands for what is written to as it is, not replaced by a new file: a device, a pipe, a
/// socket, or a descriptor of this process (/dev/stdout, /dev/fd/3), whatever that is open on.
bool is_device_output(const std::string& path);

/// Opens it for writing; -1 and errno where that fails. A pipe waits for its reader.
int open_device_output(const std::string& path);

} // namespace srisp
