// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "../common/machine_share.h"
#include "../common/memory_gate.h"
#include "image_task.h"
#include "shared_references.h"
#include "worker.h"

namespace srisp::tool {

/// What one image of a set costs, on average.
struct SampledCost {
    int made = 0;
    double seconds = 0; ///< with so many photos at a time as a run has
    double bytes = 0;
    std::vector<std::string> errors; ///< of those of the sample that failed
};

/// Makes images, in this process or in others, and no more at a time than fit into memory.
class ImageMaker {
public:
    ImageMaker(const BatchOptions& options, const std::string& settings);

    /// For one thread, as long as that makes images.
    class Seat {
    public:
        explicit Seat(ImageMaker& maker);
        ~Seat();
        Seat(const Seat&) = delete;
        Seat& operator=(const Seat&) = delete;

        Expected<nlohmann::ordered_json> make(const BatchTask& task, const std::string& path, bool may_replace);

    private:
        friend class ImageMaker;
        ImageMaker& m_maker;
        Worker m_worker;
    };
    std::unique_ptr<Seat> seat() { return std::make_unique<Seat>(*this); }

    /// What some tasks take, spread over all; the images are thrown away.
    SampledCost sample(const std::vector<BatchTask>& tasks);

    /// Ends what is under way, without a trace, where that is done by other processes; else false.
    bool give_up();

private:
    const BatchOptions& m_options;
    const std::string m_settings;
    MemoryGate m_gate;
    SharedReferences m_references;
    std::mutex m_mutex; ///< of what follows
    std::set<Seat*> m_seats;
};

} // namespace srisp::tool
