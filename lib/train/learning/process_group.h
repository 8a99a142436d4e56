// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "train/learning/membership.h"
#include "train/tensors/torch_api.h"
#include <srisp/expected.h>

namespace srisp::train {

/// Tells the other processes that this one has not ended.
using StillThere = std::function<Status()>;

/// Several processes that train one model together. Every process makes the same calls in the same order. Errors say
/// that another process is gone or does not answer in time.
class ProcessGroup {
public:
    /// Whether this program was built to run as several processes.
    static bool several_possible();

    /// Waits until all have come.
    static Expected<std::unique_ptr<ProcessGroup>> join(const Membership& membership);

    /// A group of one, in which nothing can fail.
    ProcessGroup();
    ~ProcessGroup();
    ProcessGroup(const ProcessGroup&) = delete;
    ProcessGroup& operator=(const ProcessGroup&) = delete;

    int size() const { return m_membership.size; }
    int rank() const { return m_membership.rank; }
    bool writes() const { return m_membership.rank == 0; }

    /// Replaces a float tensor, on any device, by its sum over the processes.
    Status sum(torch::Tensor tensor);
    /// Replaces a float tensor by that of rank 0.
    Status broadcast(torch::Tensor tensor);
    /// Rank 0 does `work`, the others wait until it has; `work` calls what it is given now and then, so that they know
    /// that it has not ended, however long it takes; an error says that one of them has.
    Status rank_0_alone(const std::function<void(const StillThere& still_there)>& work);
    /// An error unless `text` is the same everywhere; `what` is for the message ("recipe").
    Status check_same(const std::string& text, const std::string& what);

private:
    struct Backend;
    Membership m_membership;
    std::unique_ptr<Backend> m_backend;
};

} // namespace srisp::train
