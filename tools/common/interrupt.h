// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace srisp::tool {

/// Thrown when a signal asked this program to stop: everything unfinished is removed on the way to main().
struct Interrupted {
    int signal;
};

/// From here on SIGINT, SIGTERM and SIGHUP are remembered instead of ending the program.
void watch_interrupts();
/// The signal that came, or 0.
int pending_interrupt();
/// Throws Interrupted if one came.
void check_interrupt();
/// Ends this program as the signal would have.
[[noreturn]] void die_of(const Interrupted& interrupted);

} // namespace srisp::tool
