// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>

namespace srisp {

/// Random numbers that depend on a seed, a stream (a step, a purpose) and an index (of a sample) alone: the same on
/// every machine and whatever was drawn before elsewhere. The generator is SplitMix64 (Steele, Lea, Flood 2014), whose
/// state is a counter; seed, stream and index go through its mixing function one after the other to give the start.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t index = 0)
        : m_state(mix(mix(mix(seed + kStep) + stream) + index))
    {
    }

    /// A generator of its own for one purpose, so that a purpose that draws more moves no other one's numbers.
    /// Depends on how this one was made and on what it drew so far.
    Random fork(std::uint64_t purpose) const { return Random(m_state, purpose); }

    /// 64 random bits.
    std::uint64_t bits() { return mix(m_state += kStep); }

    /// In [low, high), 53 random bits.
    double uniform(double low = 0, double high = 1)
    {
        return low + (high - low) * (static_cast<double>(bits() >> 11) * 0x1p-53);
    }

    /// Evenly in its log; 0 < low ≤ high.
    double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }

    /// Mean 0, standard deviation 1: the sum of twelve uniform numbers, which needs no function whose last bit differs
    /// between machines. Never beyond ±6.
    double normal()
    {
        double sum = -6;
        for (int i = 0; i < 12; ++i)
            sum += uniform();
        return sum;
    }

    /// In 0 … count - 1; count ≥ 1, and far below 2^53.
    std::int64_t integer(std::int64_t count)
    {
        return static_cast<std::int64_t>(uniform() * static_cast<double>(count));
    }

    bool chance(double probability) { return uniform() < probability; }

private:
    static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15;

    static std::uint64_t mix(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
        z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
        return z ^ (z >> 31);
    }

    std::uint64_t m_state;
};

} // namespace srisp
