// SPDX-License-Identifier: Apache-2.0
// A host with threads of its own of two kinds, TBB's and OpenMP's, which call the plugins and the library at the same
// time. They flush subnormal numbers to zero, block signals, keep to one processor, and print numbers with a comma.
// Each result has the bits that a plain thread gave, and the host's settings stay as they were. Usage: host [--jobs N]
#include <omp.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <xmmintrin.h>

#include <atomic>
#include <clocale>
#include <cstdio>
#include <locale>
#include <thread>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imageio.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "concurrency/jobs.h"
#include "scratch_folder.h"

namespace {

struct CommaNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// What belongs to the calling thread: how it rounds and flushes, which signals it blocks, where it may run.
struct ThreadState {
    unsigned rounding = _mm_getcsr() & ~unsigned(_MM_EXCEPT_MASK); // not which exceptions there were
    sigset_t blocked;
    cpu_set_t processors;

    ThreadState()
    {
        CPU_ZERO(&processors);
        sigemptyset(&blocked);
        pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
        pthread_getaffinity_np(pthread_self(), sizeof processors, &processors);
    }
    bool operator==(const ThreadState& other) const
    {
        bool same = rounding == other.rounding && CPU_EQUAL(&processors, &other.processors);
        for (int signal = 1; signal < SIGRTMAX; ++signal)
            same = same && sigismember(&blocked, signal) == sigismember(&other.blocked, signal);
        return same;
    }
};

/// Sets what a host may set for a thread of its own, and gives it back at the end.
class OddThread {
public:
    OddThread()
    {
        _mm_setcsr(m_before.rounding | 0x8040); // flush to zero, subnormal numbers are zero
        sigset_t some;
        sigemptyset(&some);
        sigaddset(&some, SIGUSR1);
        sigaddset(&some, SIGCHLD);
        pthread_sigmask(SIG_BLOCK, &some, nullptr);
        cpu_set_t one;
        CPU_ZERO(&one);
        CPU_SET(sched_getcpu(), &one);
        pthread_setaffinity_np(pthread_self(), sizeof one, &one);
    }
    ~OddThread()
    {
        _mm_setcsr(m_before.rounding);
        pthread_sigmask(SIG_SETMASK, &m_before.blocked, nullptr);
        pthread_setaffinity_np(pthread_self(), sizeof m_before.processors, &m_before.processors);
    }

private:
    ThreadState m_before;
};

std::atomic<long> wrong{ 0 }, changed{ 0 }, done{ 0 };

void run_as_odd(const Job& job, const std::string& expected)
{
    const OddThread odd;
    const ThreadState before;
    wrong += !gives(job, expected);
    changed += !(before == ThreadState());
    ++done;
}

} // namespace

int main(int argc, char** argv)
{
    int most = 200;
    CLI::App app("A host with threads of TBB and OpenMP");
    app.add_option("--jobs", most, "of each kind");
    CLI11_PARSE(app, argc, argv);
    alarm(500); // where threads wait for each other for ever

    const ScratchFolder folder;
    const std::vector<Job> jobs = make_jobs(folder.path());
    const std::vector<std::string> expected = results_of(jobs);

    std::locale::global(std::locale(std::locale::classic(), new CommaNumbers));
    const std::string locale = std::setlocale(LC_ALL, "") ? std::setlocale(LC_ALL, nullptr) : "";
    OIIO::attribute("threads", 4);
    omp_set_num_threads(3);
    const tbb::global_control tbb_threads(tbb::global_control::max_allowed_parallelism, 3);

    std::thread with_tbb([&] {
        tbb::parallel_for(0, most, [&](int i) {
            const std::size_t which = std::size_t(i) * 7 % jobs.size();
            run_as_odd(jobs[which], expected[which]);
        });
    });
    long omp_threads = 0;
#pragma omp parallel for schedule(dynamic) reduction(max : omp_threads)
    for (int i = 0; i < most; ++i) {
        const std::size_t which = std::size_t(i) * 11 % jobs.size();
        run_as_odd(jobs[which], expected[which]);
        omp_threads = omp_get_num_threads();
    }
    with_tbb.join();
    // The host's settings of whole pools and of the process.
    changed += omp_threads != 3 || omp_get_max_threads() != 3;
    changed += tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism) != 3;
    changed += OIIO::get_int_attribute("threads") != 4;
    changed += std::use_facet<std::numpunct<char>>(std::locale()).decimal_point() != ',';
    changed += locale != std::setlocale(LC_ALL, nullptr);
    std::printf("jobs: %ld by TBB and OpenMP at once, locale %s, wrong: %ld, settings of the host's changed: %ld\n",
                done.load(), locale.c_str(), wrong.load(), changed.load());
    return wrong || changed ? 1 : 0;
}
