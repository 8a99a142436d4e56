// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include <srisp/reference.h>

// What load_reference_cached keeps: for processes that share the work of many references. Threads: safe.

namespace srisp {

/// From now on so many; 64 without this.
void set_most_kept_references(std::size_t most);

/// Whether the file of that path, as it is now, is kept.
bool is_reference_kept(const std::string& path);

/// Keeps one that another process decoded, under its path.
void keep_reference(const std::shared_ptr<const Reference>& reference);

} // namespace srisp
