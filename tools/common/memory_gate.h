// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <condition_variable>
#include <cstdint>
#include <mutex>

namespace srisp::tool {

/// Lets work begin only while what is under way, and it, fit into a limit; what is larger than that alone waits until
/// nothing else is under way. In bytes.
class MemoryGate {
public:
    explicit MemoryGate(std::uint64_t limit) : m_limit(limit) {}

    class Pass {
    public:
        Pass(MemoryGate& gate, std::uint64_t bytes) : m_gate(gate), m_bytes(std::min(bytes, gate.m_limit))
        {
            std::unique_lock lock(m_gate.m_mutex);
            m_gate.m_freed.wait(lock, [&] { return m_gate.m_used + m_bytes <= m_gate.m_limit; });
            m_gate.m_used += m_bytes;
        }
        ~Pass()
        {
            const std::lock_guard lock(m_gate.m_mutex);
            m_gate.m_used -= m_bytes;
            m_gate.m_freed.notify_all();
        }
        Pass(const Pass&) = delete;
        Pass& operator=(const Pass&) = delete;

    private:
        MemoryGate& m_gate;
        std::uint64_t m_bytes;
    };

private:
    const std::uint64_t m_limit;
    std::uint64_t m_used = 0;
    std::mutex m_mutex;
    std::condition_variable m_freed;
};

} // namespace srisp::tool
