// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bindings.h"

namespace srisp::python {

/// While the library works: other threads of Python run, and forks wait until it is done. A child of a fork has one
/// thread; what another one has locked meanwhile would stay locked there for ever.
class Unlocked {
public:
    Unlocked() = default;
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

    /// The latter part alone, for threads that are none of Python's.
    class Work {
    public:
        Work();
        ~Work();
        Work(const Work&) = delete;
        Work& operator=(const Work&) = delete;
    };

private:
    py::gil_scoped_release m_released; // first: who forks needs the lock to go on
    Work m_work;
};

/// Has Python call the following at forks.
void hold_forks();

} // namespace srisp::python
