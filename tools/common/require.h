// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <srisp/expected.h>

#include "failure.h"

namespace srisp::tool {

/// The value, or a Failure with the error's message.
template<class T> T require(Expected<T> result)
{
    if (!result)
        fail(result.error().message);
    return std::move(*result);
}

inline void require(const Status& status)
{
    if (!status)
        fail(status.error().message);
}

} // namespace srisp::tool
