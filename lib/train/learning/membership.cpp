// SPDX-License-Identifier: Apache-2.0
#include "train/learning/membership.h"

#include <cstdlib>
#include <limits>

namespace srisp::train {

namespace {

/// The first of the variables that is set; its name goes to `name`.
const char* first_of(const std::function<const char*(const char*)>& variable, std::initializer_list<const char*> names,
                     std::string& name)
{
    for (const char* candidate : names)
        if (const char* text = variable(candidate); text && *text) {
            name = candidate;
            return text;
        }
    return nullptr;
}

Expected<int> whole_number(const std::string& text, const std::string& what, int low, int high)
{
    char* end = nullptr;
    const long value = std::strtol(text.c_str(), &end, 10);
    if (text.empty() || *end != '\0' || value < low || value > high)
        return Error{ what + " must be a whole number from " + std::to_string(low) + " to " + std::to_string(high) +
                      ", has '" + text + "'" };
    return static_cast<int>(value);
}

/// The port of a job: all its processes come to the same one, other jobs mostly to others.
std::string port_of_job(const char* job)
{
    return std::to_string(20000 + (job ? std::strtoul(job, nullptr, 10) : 0) % 20000);
}

} // namespace

Expected<Membership> find_membership(Membership given, const std::function<const char*(const char*)>& variable)
{
    // Slurm sets its variables in batch scripts, too, where only one process runs: a step has an id.
    const bool slurm = variable("SLURM_STEP_ID") != nullptr;
    std::string name;
    const auto number = [&](const char* torchrun, const char* of_slurm, int low, int fallback) -> Expected<int> {
        const char* text =
            slurm ? first_of(variable, { torchrun, of_slurm }, name) : first_of(variable, { torchrun }, name);
        return text ? whole_number(text, name, low, 1'000'000) : fallback;
    };
    if (given.size == 0) {
        const Expected<int> size = number("WORLD_SIZE", "SLURM_NTASKS", 1, 1);
        if (!size)
            return size.error();
        given.size = *size;
    }
    if (given.size == 1)
        return Membership{ 1, 0, "", given.timeout_s };
    if (given.rank < 0) {
        const Expected<int> rank = number("RANK", "SLURM_PROCID", 0, -1);
        if (!rank)
            return rank.error();
        given.rank = *rank;
    }
    if (given.rank < 0)
        return Error{ std::to_string(given.size) +
                      " processes need to know their rank: --rank, or RANK in the environment" };
    if (given.rank >= given.size)
        return Error{ "rank " + std::to_string(given.rank) + " of " + std::to_string(given.size) +
                      " processes: the last is " + std::to_string(given.size - 1) };
    if (given.address.empty()) {
        const char* host = slurm ? first_of(variable, { "MASTER_ADDR", "SLURM_LAUNCH_NODE_IPADDR" }, name)
                                 : first_of(variable, { "MASTER_ADDR" }, name);
        const char* port = variable("MASTER_PORT");
        if (host && (port || slurm))
            given.address = host + (":" + (port ? std::string(port) : port_of_job(variable("SLURM_JOB_ID"))));
    }
    const std::size_t colon = given.address.rfind(':');
    if (colon == std::string::npos || colon == 0)
        return Error{ "several processes need the address host:port of rank 0: --address, or MASTER_ADDR and "
                      "MASTER_PORT in the environment" +
                      (given.address.empty() ? "" : "; has '" + given.address + "'") };
    const Expected<int> port = whole_number(given.address.substr(colon + 1), "the port of '" + given.address + "'", 1,
                                            std::numeric_limits<std::uint16_t>::max());
    if (!port)
        return port.error();
    return given;
}

} // namespace srisp::train
