// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <csignal>
#include <cstdlib>
#include <initializer_list>

namespace srisp::tool {

static volatile std::sig_atomic_t g_signal = 0;

void watch_interrupts()
{
    struct sigaction action = {};
    action.sa_handler = [](int signal) { g_signal = signal; };
    for (const int signal : { SIGINT, SIGTERM, SIGHUP }) {
        struct sigaction old;
        // What runs in the background of a script, or under nohup, ignores some; so it shall stay.
        if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN)
            sigaction(signal, &action, nullptr);
    }
}

int pending_interrupt()
{
    return g_signal;
}

void check_interrupt()
{
    if (g_signal)
        throw Interrupted{ g_signal };
}

void die_of(const Interrupted& interrupted)
{
    std::signal(interrupted.signal, SIG_DFL);
    std::raise(interrupted.signal);
    std::exit(128 + interrupted.signal);
}

} // namespace srisp::tool
