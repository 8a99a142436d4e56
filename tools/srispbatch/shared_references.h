// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "base/recently_kept.h"

namespace srisp::tool {

/// A reference that was decoded, in memory that other processes of this user can read, too.
class SharedReference {
public:
    explicit SharedReference(int file) : m_file(file) {}
    ~SharedReference();
    SharedReference(const SharedReference&) = delete;
    SharedReference& operator=(const SharedReference&) = delete;

    /// What a worker opens.
    std::string name() const;

private:
    int m_file;
};

/// How many references each of so many processes keeps: an eighth of the memory that there is for images goes to them.
std::size_t most_references(double asked_memory_gb, unsigned processes);

/// Decodes references for all workers, each once; those that were used last are kept. Threads: safe.
class SharedReferences {
public:
    explicit SharedReferences(std::size_t most) : m_kept(most) {}

    /// Null: it cannot be decoded; a worker that tries it will get the reason.
    std::shared_ptr<const SharedReference> get(const std::string& path);

private:
    RecentlyKept<std::shared_ptr<const SharedReference>> m_kept;
};

/// In a worker: keeps what SharedReference::name() names as the reference of that path.
void take_shared_reference(const std::string& name, const std::string& path);

} // namespace srisp::tool
