// SPDX-License-Identifier: Apache-2.0
#include <map>

#include <doctest/doctest.h>

#include "train/learning/process_group.h"

using namespace srisp;
using namespace srisp::train;

namespace {

using Environment = std::map<std::string, std::string>;

/// "size rank address", or the message.
std::string found(const Membership& given, const Environment& environment)
{
    const Expected<Membership> membership = find_membership(given, [&](const char* name) {
        const auto entry = environment.find(name);
        return entry == environment.end() ? nullptr : entry->second.c_str();
    });
    return membership
               ? std::to_string(membership->size) + " " + std::to_string(membership->rank) + " " + membership->address
               : membership.error().message;
}

const Membership kNothing{ 0, -1, "", 60 };

} // namespace

TEST_CASE("one process needs nothing")
{
    CHECK(found(kNothing, {}) == "1 0 ");
    CHECK(found({ 1, -1, "", 60 }, { { "WORLD_SIZE", "4" } }) == "1 0 ");
    CHECK(found(kNothing, { { "WORLD_SIZE", "1" }, { "RANK", "0" } }) == "1 0 ");
}

TEST_CASE("rank and address come from flags, torchrun's or Slurm's variables, in that order")
{
    const Environment torchrun = {
        { "WORLD_SIZE", "4" }, { "RANK", "3" }, { "MASTER_ADDR", "node7" }, { "MASTER_PORT", "29500" }
    };
    CHECK(found({ 2, 1, "a:1", 60 }, torchrun) == "2 1 a:1");
    CHECK(found(kNothing, torchrun) == "4 3 node7:29500");
    Environment slurm = { { "SLURM_STEP_ID", "0" },
                          { "SLURM_NTASKS", "8" },
                          { "SLURM_PROCID", "5" },
                          { "SLURM_LAUNCH_NODE_IPADDR", "10.0.0.3" },
                          { "SLURM_JOB_ID", "61234" } };
    CHECK(found(kNothing, slurm) == "8 5 10.0.0.3:21234");
    slurm["MASTER_ADDR"] = "node1";
    slurm["MASTER_PORT"] = "1234";
    CHECK(found(kNothing, slurm) == "8 5 node1:1234");
    CHECK(found({ 0, -1, "[::1]:9", 60 }, slurm) == "8 5 [::1]:9");
}

TEST_CASE("in a batch script of Slurm, outside a step, there is one process")
{
    CHECK(found(kNothing, { { "SLURM_NTASKS", "8" }, { "SLURM_PROCID", "0" } }) == "1 0 ");
}

TEST_CASE("what is missing or impossible is named")
{
    CHECK(found({ 2, -1, "a:1", 60 }, {}) == "2 processes need to know their rank: --rank, or RANK in the environment");
    CHECK(found({ 2, 2, "a:1", 60 }, {}) == "rank 2 of 2 processes: the last is 1");
    CHECK(found({ 2, 0, "", 60 }, {}) == "several processes need the address host:port of rank 0: --address, or "
                                         "MASTER_ADDR and MASTER_PORT in the environment");
    CHECK(found({ 2, 0, "host", 60 }, {}).find("; has 'host'") != std::string::npos);
    CHECK(found({ 2, 0, "host:0", 60 }, {}) == "the port of 'host:0' must be a whole number from 1 to 65535, has '0'");
    CHECK(found({ 2, 0, "host:x", 60 }, {}).find("has 'x'") != std::string::npos);
    CHECK(found(kNothing, { { "WORLD_SIZE", "two" } }) ==
          "WORLD_SIZE must be a whole number from 1 to 1000000, has 'two'");
}
