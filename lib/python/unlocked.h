// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

namespace srisp::python {

/// While the library works: other threads of Python run, and forks wait until it is done. A child of a fork has one
/// thread; what another one has locked meanwhile would stay locked there for ever. Where the interpreter ends
/// meanwhile, the thread stops here for ever: to take the lock again would end it, and with it, in the midst of C++,
/// the program.
class Unlocked {
public:
    Unlocked() = default;
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    /// The latter parts.
    struct Work {
        Work();
        ~Work();
    };

    py::gil_scoped_release m_released; // first: who forks needs the lock to go on
    Work m_work;
};

/// Work that goes on, in a thread that is none of Python's, when the call that began it has ended: made within the
/// call, kept until the work is done. Forks and the interpreter's end wait for it.
class BackgroundWork {
public:
    BackgroundWork();
    ~BackgroundWork();
    BackgroundWork(const BackgroundWork&) = delete;
    BackgroundWork& operator=(const BackgroundWork&) = delete;
};

/// Whether the interpreter waits for calls under way so that it can end.
bool is_ending();

/// Has Python do its part at forks and at its end.
void watch_interpreter();

} // namespace srisp::python
