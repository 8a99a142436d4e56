// SPDX-License-Identifier: Apache-2.0
#include "fma_peak.h"

#include <chrono>
#include <thread>
#include <vector>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fma_peak.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// `rounds` × 12 multiply-adds of whole vectors in 12 independent chains; returns how many floats that is per round.
int multiply_add(long rounds, float* sink)
{
    const hn::ScalableTag<float> d;
    const auto w = hn::Set(d, 0.999f), p = hn::Set(d, 0.001f);
    // Different numbers, or the compiler computes one chain for all twelve.
    auto a = hn::Set(d, 0.1f), b = hn::Set(d, 0.2f), c = hn::Set(d, 0.3f), e = hn::Set(d, 0.4f);
    auto f = hn::Set(d, 0.5f), g = hn::Set(d, 0.6f), h = hn::Set(d, 0.7f), i = hn::Set(d, 0.8f);
    auto j = hn::Set(d, 0.9f), k = hn::Set(d, 1.0f), l = hn::Set(d, 1.1f), m = hn::Set(d, 1.2f);
    for (long r = 0; r < rounds; ++r) {
        a = hn::MulAdd(a, w, p), b = hn::MulAdd(b, w, p), c = hn::MulAdd(c, w, p), e = hn::MulAdd(e, w, p);
        f = hn::MulAdd(f, w, p), g = hn::MulAdd(g, w, p), h = hn::MulAdd(h, w, p), i = hn::MulAdd(i, w, p);
        j = hn::MulAdd(j, w, p), k = hn::MulAdd(k, w, p), l = hn::MulAdd(l, w, p), m = hn::MulAdd(m, w, p);
    }
    const auto sum = hn::Add(hn::Add(hn::Add(a, b), hn::Add(c, e)),
                             hn::Add(hn::Add(hn::Add(f, g), hn::Add(h, i)), hn::Add(hn::Add(j, k), hn::Add(l, m))));
    *sink = hn::GetLane(hn::SumOfLanes(d, sum));
    return 12 * static_cast<int>(hn::Lanes(d));
}

} // namespace HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include "../force_targets.h"

HWY_EXPORT(multiply_add);

double measure_fma_peak(int threads)
{
    using clock = std::chrono::steady_clock;
    std::vector<double> rates(threads);
    std::vector<std::thread> pool;
    for (int t = 0; t < threads; ++t)
        pool.emplace_back([&rates, t] {
            float sink = 0;
            double count = 0;
            const auto start = clock::now();
            std::chrono::duration<double> elapsed{};
            do {
                constexpr long rounds = 1'000'000;
                count += double(rounds) * HWY_DYNAMIC_DISPATCH(multiply_add)(rounds, &sink);
                elapsed = clock::now() - start;
            } while (elapsed.count() < 0.3);
            volatile float keep = sink;
            (void)keep;
            rates[t] = count / elapsed.count();
        });
    for (std::thread& thread : pool)
        thread.join();
    double sum = 0;
    for (const double rate : rates)
        sum += rate;
    return sum;
}

namespace {
constexpr std::int64_t kAvx512 = HWY_AVX3 | HWY_AVX3_DL;
}

const char* instruction_set()
{
    return hwy::TargetName(hwy::SupportedAndGeneratedTargets().front());
}

bool has_avx512()
{
    return hwy::SupportedTargets() & kAvx512;
}

WithoutAvx512::WithoutAvx512()
{
    force_targets(hwy::SupportedTargets() & ~kAvx512);
}

WithoutAvx512::~WithoutAvx512()
{
    force_targets(0);
}
#endif
