// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <exception>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>

#include <srisp/expected.h>

namespace srisp {

/// What was caught, for messages.
inline std::string thrown_text(const std::exception& thrown)
{
    // A length_error: of a vector that could never be so long.
    const bool memory = dynamic_cast<const std::bad_alloc*>(&thrown) || dynamic_cast<const std::length_error*>(&thrown);
    return memory ? "not enough memory" : thrown.what();
}

/// Runs the step of a public function, which gives an Expected or a Status: what is thrown in it, by us or by
/// libraries, becomes an error of `what` ("photo"), of that name where it is not empty.
template<class Step> auto guarded(std::string_view what, std::string_view name, const Step& step) -> decltype(step())
{
    const auto error = [&](const std::string& reason) {
        const std::string quoted = name.empty() ? "" : " '" + std::string(name) + "'";
        return Error{ std::string(what) + quoted + ": " + reason };
    };
    try {
        return step();
    } catch (const std::exception& thrown) {
        return error(thrown_text(thrown));
    } catch (...) {
        return error("unknown exception");
    }
}

} // namespace srisp
