// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>

#include "kept_rows.h"
#include "result/kept_results.h"

namespace srisp::plugin {

/// One level of an image as our writer got it.
struct SlotLevel {
    OIIO::ImageSpec spec; ///< float
    KeptRows rows;        ///< all channels of the data window
};
/// An image that was handed over.
struct Slot {
    std::vector<std::vector<SlotLevel>> subimages; ///< MIP levels of each
    std::string job;                               ///< path of the job file
    std::string frame;                             ///< frame number as in the stub's name; may be empty
};

/// The images that were handed over and not yet replaced.
class Slots {
public:
    /// Returns the slot's id. The previous slot of the same job is freed, though readers of it may be open: hosts keep
    /// many open, and a shot would fill the memory.
    std::string keep(std::shared_ptr<const Slot> slot);
    /// Null: no such slot in this process.
    std::shared_ptr<const Slot> find(const std::string& id);

private:
    std::mutex m_mutex;
    int m_count = 0;
    std::map<std::string, std::shared_ptr<const Slot>> m_slots;
    std::map<std::string, std::string> m_last_of_job;
};

/// All that the plugin keeps in a process from one call of the host's to the next; but for loaded references, which the
/// library keeps.
struct ProcessState {
    Slots slots;
    KeptResults results;
};
ProcessState& process_state();

} // namespace srisp::plugin
