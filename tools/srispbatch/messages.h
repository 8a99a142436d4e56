// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace srisp::tool {

/// What two processes of this program say to each other by a socket: some texts of any bytes.
using Message = std::vector<std::string>;

/// False: the other end is closed, as where its process was killed; there is no signal.
bool send_message(int file, const Message& message);

/// The next one, waited for at most so many seconds. None: the other end is closed, or time is up; `timed_out` says
/// which.
std::optional<Message> receive_message(int file, double seconds, bool& timed_out);

} // namespace srisp::tool
