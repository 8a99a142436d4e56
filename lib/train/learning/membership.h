// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

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

} // namespace srisp::train
