// SPDX-License-Identifier: Apache-2.0
#include "process_state.h"

#include <unistd.h>

namespace srisp::plugin {

std::string Slots::keep(std::shared_ptr<const Slot> slot)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    const std::string id = std::to_string(::getpid()) + "-" + std::to_string(++m_count);
    std::string& last = m_last_of_job[slot->job];
    m_slots.erase(last);
    last = id;
    m_slots[id] = std::move(slot);
    return id;
}

std::shared_ptr<const Slot> Slots::find(const std::string& id)
{
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto found = m_slots.find(id);
    return found == m_slots.end() ? nullptr : found->second;
}

ProcessState& process_state()
{
    // Never destroyed: other threads of the host may still read while statics end.
    static ProcessState& state = *new ProcessState;
    return state;
}

} // namespace srisp::plugin
