// SPDX-License-Identifier: Apache-2.0
// Threads of a host that open, read and close images through the plugins and the library, whatever comes next, files of
// others and damaged ones among them. Each result has the bits that one thread alone gave. Every fourth thread works
// through OpenImageIO's own pool, which the plugin uses, too. Memory is looked at after the first and the last tenth of
// the time: it may not grow by more than a quarter (and 64 MB). Usage: stress [--minutes M] [--threads N] [--seed S]
#include <malloc.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <random>
#include <thread>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/parallel.h>

#include "bench/measuring.h"
#include "concurrency/jobs.h"
#include "scratch_folder.h"

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kRounds = 10;

struct Counts {
    std::atomic<long> read{ 0 }, wrong{ 0 };
};

void work(const std::vector<Job>& jobs, const std::vector<std::string>& expected, unsigned seed, bool through_pool,
          Clock::time_point end, Counts& counts)
{
    std::mt19937 random(seed);
    while (Clock::now() < end) {
        const auto one = [&](std::size_t which) {
            counts.wrong += !gives(jobs[which], expected[which]);
            ++counts.read;
        };
        if (!through_pool) {
            one(random() % jobs.size());
            continue;
        }
        const std::size_t first = random();
        OIIO::parallel_for(0, 4, [&](int i) { one((first + std::size_t(i)) % jobs.size()); });
    }
}

/// What is in use, without what malloc keeps for later.
double used_mb()
{
    malloc_trim(0);
    return memory_mb("VmRSS:");
}

} // namespace

int main(int argc, char** argv)
{
    double minutes = 0.15;
    int threads = 16;
    unsigned seed = 1;
    CLI::App app("Threads of a host, for a while");
    app.add_option("--minutes", minutes);
    app.add_option("--threads", threads);
    app.add_option("--seed", seed);
    CLI11_PARSE(app, argc, argv);
    alarm(unsigned(minutes * 60) + 500); // where threads wait for each other for ever

    const ScratchFolder folder;
    const std::vector<Job> jobs = make_jobs(folder.path());
    const std::vector<std::string> expected = results_of(jobs);
    OIIO::attribute("threads", 6);
    Counts counts;
    double first_mb = 0;
    const auto start = Clock::now();
    for (int round = 1; round <= kRounds; ++round) {
        const auto end = start + std::chrono::duration_cast<Clock::duration>(
                                     std::chrono::duration<double>(minutes * 60 * round / kRounds));
        std::vector<std::thread> crew;
        for (int i = 0; i < threads; ++i)
            crew.emplace_back(work, std::cref(jobs), std::cref(expected), seed++, i % 4 == 3, end, std::ref(counts));
        for (std::thread& each : crew)
            each.join();
        if (round == 1)
            first_mb = used_mb();
    }
    const double last_mb = used_mb();
    bool grown = last_mb > 1.25 * first_mb + 64;
#ifdef SRISP_SANITIZED
    grown = false; // they keep what was freed
#endif
    std::printf(
        "images read: %ld of %zu kinds in %.0f s, threads: %d, wrong: %ld, memory: %.0f -> %.0f MB, peak %.0f MB%s\n",
        counts.read.load(), jobs.size(), std::chrono::duration<double>(Clock::now() - start).count(), threads,
        counts.wrong.load(), first_mb, last_mb, memory_mb("VmHWM:"), grown ? ": it grows" : "");
    return counts.wrong || grown ? 1 : 0;
}
