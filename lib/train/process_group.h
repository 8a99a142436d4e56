// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "torch_api.h"
#include <srisp/expected.h>

namespace srisp::train {

/// Which of several processes this one is, and where they meet.
struct Membership {
    int size = 1;        ///< processes
    int rank = 0;        ///< of this one, from 0; rank 0 writes all files
    std::string address; ///< "host:port" on the machine of rank 0
    int timeout_s = 600; ///< how long a process waits for another one before it gives up
};

/// Completes what the command line left open (size 0, rank -1, no address) from the environment: WORLD_SIZE, RANK,
/// MASTER_ADDR and MASTER_PORT as torchrun sets them, or SLURM_NTASKS, SLURM_PROCID, SLURM_LAUNCH_NODE_IPADDR and
/// SLURM_JOB_ID within a step of srun. `variable` gives an environment variable's text or null. Errors: a rank without
/// an address, a number that is none, a rank that is not below the size.
Expected<Membership> find_membership(Membership given, const std::function<const char*(const char*)>& variable);

/// Several processes that train one model together. Every process makes the same calls in the same order. A call throws
/// std::runtime_error, with a message for people, when another process is gone or does not answer in time.
class ProcessGroup {
public:
    /// Whether this program was built to run as several processes.
    static bool several_possible();

    /// Waits until all have come. A group of one does nothing.
    explicit ProcessGroup(const Membership& membership);
    ~ProcessGroup();

    int size() const { return m_membership.size; }
    int rank() const { return m_membership.rank; }
    bool writes() const { return m_membership.rank == 0; }

    /// Replaces a float tensor, on any device, by its sum over the processes.
    void sum(torch::Tensor tensor);
    /// Replaces a float tensor by that of rank 0.
    void broadcast(torch::Tensor tensor);
    /// Rank 0 does `work`, the others wait until it has; `work` calls what it is given now and then, so that they know
    /// that it has not ended, however long it takes.
    void rank_0_alone(const std::function<void(const std::function<void()>& still_there)>& work);
    /// Throws unless `text` is the same everywhere; `what` is for the message ("recipe").
    void check_same(const std::string& text, const std::string& what);

private:
    struct Backend;
    Membership m_membership;
    std::unique_ptr<Backend> m_backend;
};

} // namespace srisp::train
