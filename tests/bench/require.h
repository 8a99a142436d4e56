// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <utility>

#include <srisp/expected.h>

/// The value; throws std::runtime_error where there is none.
template<class T> T require(srisp::Expected<T> result)
{
    if (result)
        return std::move(*result);
    throw std::runtime_error(result.error().message);
}

inline void require(const srisp::Status& status)
{
    if (!status)
        throw std::runtime_error(status.error().message);
}
