// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace srisp {

/// A large piece of memory that goes back to the system from its start on, while the rest is still in use.
class PageMemory {
public:
    /// Null: the system has none. Only what is written to takes memory.
    static std::unique_ptr<PageMemory> create(std::size_t size);
    ~PageMemory();
    PageMemory(const PageMemory&) = delete;
    PageMemory& operator=(const PageMemory&) = delete;

    unsigned char* data() const { return m_data; }
    /// Bytes before `end` hold nothing any more, but for less than 2 MiB before it.
    void forget_before(std::size_t end);

private:
    PageMemory(unsigned char* data, std::size_t size) : m_data(data), m_size(size) {}

    unsigned char* m_data;
    std::size_t m_size, m_forgotten = 0;
};

} // namespace srisp
