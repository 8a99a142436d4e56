// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "batch_options.h"

namespace srisp::tool {

/// Bytes that images may take at a time: what is asked for, or a quarter of the machine's.
std::uint64_t memory_limit(const BatchOptions& options);

/// How many references each of so many processes keeps: an eighth of that goes to them.
std::size_t most_references(const BatchOptions& options, unsigned processes);

/// Photos at a time: what is asked for, or one for each processor.
unsigned photos_at_a_time(const BatchOptions& options);

} // namespace srisp::tool
