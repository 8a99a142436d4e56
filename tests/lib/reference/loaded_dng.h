// SPDX-License-Identifier: Apache-2.0
#pragma once

// DNGs that tests make, as references.

#include <memory>
#include <string>

#include <doctest/doctest.h>
#include <srisp/reference.h>

#include "lib/reference/synthetic_dng.h"
#include "scratch_folder.h"

namespace srisp {

inline Expected<std::shared_ptr<const Reference>> load(const std::string& bytes)
{
    const ScratchFolder folder;
    return load_reference(folder.file("a.dng", bytes));
}

/// Loads what must load.
inline Reference loaded(const SyntheticDng& dng)
{
    const auto reference = load(dng.bytes());
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    return **reference;
}

/// Why it was refused, without "reference '…': ".
inline std::string refusal(const std::string& bytes)
{
    const auto reference = load(bytes);
    if (reference)
        return "(it loaded)";
    const std::string& message = reference.error().message;
    return message.substr(message.find("': ") + 3);
}

} // namespace srisp
