// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../../tools/common/failure.h"

/// Exit code and message of the Failure that `call` throws ("2: unknown …"); "" if it throws none.
template<class Call> std::string failure_of(Call call)
{
    try {
        call();
    } catch (const srisp::tool::Failure& failure) {
        return std::to_string(failure.exit_code) + ": " + failure.message;
    }
    return "";
}
