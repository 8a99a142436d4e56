// SPDX-License-Identifier: Apache-2.0
#include "noise/noise_kernel.h"

#include <array>

#include <srisp/noise.h>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "noise/noise_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target, which compiles the following once per instruction set.
#include <hwy/highway.h>

#ifndef SRISP_NOISE_RECIPROCALS
#define SRISP_NOISE_RECIPROCALS
namespace srisp {

/// Counts of electrons that the search goes through; of kPoissonElectrons on average, one in 1e19 pixels has more.
constexpr int kMostElectrons = 160;

constexpr std::array<double, kMostElectrons + 1> reciprocals()
{
    std::array<double, kMostElectrons + 1> table{};
    for (int k = 1; k <= kMostElectrons; ++k)
        table[std::size_t(k)] = 1.0 / k;
    return table;
}

} // namespace srisp
#endif

HWY_BEFORE_NAMESPACE();
namespace srisp {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<float>;
using DU = hn::RebindToUnsigned<D>;
using DI = hn::RebindToSigned<D>;
using DD = hn::ScalableTag<double>;
using V = hn::Vec<D>;
using VU = hn::Vec<DU>;
using VD = hn::Vec<DD>;

/// Both halves of the products with a number.
HWY_INLINE void multiply_wide(VU v, std::uint32_t by, VU& high, VU& low)
{
    const DU du;
#if HWY_TARGET == HWY_SCALAR // no pairs of lanes
    const std::uint64_t product = std::uint64_t(hn::GetLane(v)) * by;
    high = hn::Set(du, std::uint32_t(product >> 32));
    low = hn::Set(du, std::uint32_t(product));
#else
    const hn::Repartition<std::uint64_t, DU> wide;
    const auto factor = hn::Set(du, by);
    const auto even = hn::MulEven(v, factor);
    const auto odd = hn::MulEven(hn::BitCast(du, hn::ShiftRight<32>(hn::BitCast(wide, v))), factor);
    high = hn::OddEven(hn::BitCast(du, odd), hn::BitCast(du, hn::ShiftRight<32>(even)));
    low = hn::OddEven(hn::BitCast(du, hn::ShiftLeft<32>(odd)), hn::BitCast(du, even));
#endif
}

/// philox() of as many counters as there are lanes: four pixels each, from `block.x + 4 · first` on.
HWY_INLINE void philox_lanes(const NoiseBlock& block, NoiseStream stream, int first, VU& w0, VU& w1, VU& w2, VU& w3)
{
    const DU du;
    const std::int32_t group = (block.x >> 2) + first;
    w0 = hn::Iota(du, std::uint32_t(group));
    w1 = hn::Set(du, std::uint32_t(block.y));
    w2 = hn::Set(du, std::uint32_t(stream));
    w3 = hn::Zero(du);
    std::uint32_t key0 = std::uint32_t(block.seed), key1 = std::uint32_t(block.seed >> 32);
    for (int round = 0; round < kPhiloxRounds; ++round) {
        VU high_a, low_a, high_b, low_b;
        multiply_wide(w0, kPhiloxM0, high_a, low_a);
        multiply_wide(w2, kPhiloxM1, high_b, low_b);
        w0 = hn::Xor(hn::Xor(high_b, w1), hn::Set(du, key0));
        w2 = hn::Xor(hn::Xor(high_a, w3), hn::Set(du, key1));
        w1 = low_b;
        w3 = low_a;
        key0 += kPhiloxW0;
        key1 += kPhiloxW1;
    }
}

/// Calls body(first pixel, four vectors of words) for all of a block.
template<class Body> HWY_INLINE void for_random_words(const NoiseBlock& block, NoiseStream stream, Body body)
{
    for (int i = 0; i < block.count; i += 4 * int(hn::Lanes(DU()))) {
        VU w0, w1, w2, w3;
        philox_lanes(block, stream, i / 4, w0, w1, w2, w3);
        body(i, w0, w1, w2, w3);
    }
}

void random_words(const NoiseBlock& block, NoiseStream stream, std::uint32_t* target)
{
    for_random_words(block, stream, [&](int i, VU w0, VU w1, VU w2, VU w3) HWY_ATTR {
        hn::StoreInterleaved4(w0, w1, w2, w3, DU(), target + i);
    });
}

/// −2 ln(w / 2³²) with the lowest bit of w set. ln: m in [√½, √2), atanh series.
HWY_INLINE V minus_two_log(VU w)
{
    const D d;
    const DI di;
    const V u = hn::Add(hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftRight<1>(w))), hn::Set(d, 0x1p-31f)),
                        hn::Set(d, 0x1p-32f));
    const auto sqrt_half = hn::Set(di, 0x3f3504f3);
    const auto shifted = hn::Sub(hn::BitCast(di, u), sqrt_half);
    const V e = hn::ConvertTo(d, hn::ShiftRight<23>(shifted));
    const V m = hn::BitCast(d, hn::Add(hn::And(shifted, hn::Set(di, 0x7fffff)), sqrt_half));
    const V s = hn::Div(hn::Sub(m, hn::Set(d, 1.0f)), hn::Add(m, hn::Set(d, 1.0f)));
    const V s2 = hn::Mul(s, s);
    V series = hn::Set(d, 1.0f / 9);
    for (const float coefficient : { 1.0f / 7, 1.0f / 5, 1.0f / 3, 1.0f })
        series = hn::Add(hn::Mul(series, s2), hn::Set(d, coefficient));
    return hn::Add(hn::Mul(hn::Mul(s, series), hn::Set(d, -4.0f)), hn::Mul(e, hn::Set(d, -1.38629436f)));
}

/// Two normal numbers of two words: radius from one, a point of the circle from the other. Its upper two bits choose
/// the quadrant, the rest an angle of ±45° in it; Taylor: the first terms left out are 2e-9 and 3e-7.
HWY_INLINE void box_muller(VU radius_word, VU angle_word, V& z0, V& z1)
{
    const D d;
    const DI di;
    const DU du;
    const V radius = hn::Sqrt(minus_two_log(radius_word));
    const V a = hn::Mul(hn::ConvertTo(d, hn::BitCast(di, hn::ShiftLeft<2>(angle_word))),
                        hn::Set(d, 3.6572952e-10f)); // π/4 · 2⁻³¹
    const V a2 = hn::Mul(a, a);
    V sine = hn::Set(d, 2.75573192e-06f);
    for (const float coefficient : { -1.98412698e-04f, 8.33333333e-03f, -1.66666667e-01f, 1.0f })
        sine = hn::Add(hn::Mul(sine, a2), hn::Set(d, coefficient));
    sine = hn::Mul(sine, a);
    V cosine = hn::Set(d, 2.48015873e-05f);
    for (const float coefficient : { -1.38888889e-03f, 4.16666667e-02f, -0.5f, 1.0f })
        cosine = hn::Add(hn::Mul(cosine, a2), hn::Set(d, coefficient));
    const auto sign = hn::And(angle_word, hn::Set(du, 0x80000000u));
    cosine = hn::BitCast(d, hn::Xor(hn::BitCast(du, cosine), sign));
    const auto swapped =
        hn::MaskFromVec(hn::BitCast(d, hn::BroadcastSignBit(hn::BitCast(di, hn::ShiftLeft<1>(angle_word)))));
    z0 = hn::Mul(radius, hn::IfThenElse(swapped, sine, cosine));
    z1 = hn::Mul(radius, hn::IfThenElse(swapped, cosine, sine));
}

void normal_numbers(const NoiseBlock& block, float* target)
{
    for_random_words(block, NoiseStream::normal, [&](int i, VU w0, VU w1, VU w2, VU w3) HWY_ATTR {
        V z0, z1, z2, z3;
        box_muller(w0, w1, z0, z1);
        box_muller(w2, w3, z2, z3);
        hn::StoreInterleaved4(z0, z1, z2, z3, D(), target + i);
    });
}

/// e^−x, x in [0, 70]; Taylor: the first term left out is 2e-16.
HWY_INLINE VD exp_of_minus(VD x)
{
    const DD d;
    const hn::RebindToSigned<DD> di;
    const VD magic = hn::Set(d, 0x1.8p52); // brings the integer nearest to a number into its lowest bits
    const VD shifted = hn::Add(hn::Mul(x, hn::Set(d, -1.4426950408889634)), magic);
    const VD n = hn::Sub(shifted, magic);
    const VD r = hn::Sub(hn::Sub(hn::Neg(x), hn::Mul(n, hn::Set(d, 0x1.62e42fefp-1))),
                         hn::Mul(n, hn::Set(d, 0x1.473de6af278edp-34))); // ln 2 in two parts
    VD p = hn::Set(d, 1.0 / 479001600);
    for (const double coefficient : { 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720,
                                      1.0 / 120, 1.0 / 24, 1.0 / 6, 0.5, 1.0, 1.0 })
        p = hn::Add(hn::Mul(p, r), hn::Set(d, coefficient));
    return hn::BitCast(d, hn::Add(hn::BitCast(di, p), hn::ShiftLeft<52>(hn::BitCast(di, shifted))));
}

/// The state of a search for the count of electrons whose cumulative probability reaches `u`.
struct Search {
    VD mean, u, p, sum, count;

    HWY_INLINE void start(const float* means, const std::uint32_t* words)
    {
        const DD d;
        const hn::Rebind<float, DD> floats;
        const hn::Rebind<std::int32_t, DD> integers;
        mean = hn::PromoteTo(d, hn::LoadU(floats, means));
        const auto flipped = hn::PromoteTo(d, hn::LoadU(integers, reinterpret_cast<const std::int32_t*>(words)));
        u = hn::Add(hn::Mul(flipped, hn::Set(d, 0x1p-32)), hn::Set(d, 0.5 + 0x1p-33));
        p = exp_of_minus(mean);
        sum = p;
        count = hn::Zero(d);
    }
    /// Goes on to the count of which `reciprocal` is one.
    HWY_INLINE void step(double reciprocal)
    {
        const DD d;
        count = hn::Add(count, hn::IfThenElseZero(hn::Gt(u, sum), hn::Set(d, 1.0)));
        p = hn::Mul(p, hn::Mul(mean, hn::Set(d, reciprocal)));
        sum = hn::Add(sum, p);
    }
};

/// Poisson-distributed counts by inversion, of as many means as a vector of floats has. Two searches at once, since
/// each of them waits for its own products.
HWY_INLINE void poisson(const float* means, const std::uint32_t* words, float* counts)
{
    static constexpr auto kReciprocals = reciprocals();
    const DD d;
    const hn::Rebind<float, DD> floats;
    const std::size_t half = hn::Lanes(d);
    Search a, b;
    a.start(means, words);
    b.start(means + half, words + half);
    constexpr int kSteps = 4; // between two looks at who is done
    static_assert(kMostElectrons % kSteps == 0);
    for (int k = 1; k < kMostElectrons; k += kSteps) {
        for (int i = k; i < k + kSteps; ++i) {
            a.step(kReciprocals[std::size_t(i)]);
            b.step(kReciprocals[std::size_t(i)]);
        }
        if (hn::AllFalse(d, hn::Or(hn::Gt(a.u, a.sum), hn::Gt(b.u, b.sum))))
            break;
    }
    hn::StoreU(hn::DemoteTo(floats, a.count), floats, counts);
    hn::StoreU(hn::DemoteTo(floats, b.count), floats, counts + half);
}

HWY_INLINE hn::Mask<D> has_few_electrons(V value, V shot)
{
    const D d;
    return hn::And(hn::Gt(value, hn::Zero(d)), hn::Lt(value, hn::Mul(shot, hn::Set(d, float(kPoissonElectrons)))));
}

/// Replaces, among `noisy`, what has few electrons: electrons · shot + read noise.
HWY_NOINLINE void count_electrons(const NoiseBlock& block, const float* values, const float* normal, float* noisy)
{
    const D d;
    HWY_ALIGN std::uint32_t words[kNoiseBuffer];
    HWY_ALIGN float means[kNoiseSlack] = {}, counts[kNoiseSlack];
    HWY_NAMESPACE::random_words(block, NoiseStream::poisson, words);
    for (int i = 0; i < block.count; i += int(hn::Lanes(d))) {
        const V value = hn::LoadU(d, values + i), shot = hn::LoadU(d, block.shot + i);
        const auto few = has_few_electrons(value, shot);
        if (hn::AllFalse(d, few))
            continue;
        hn::StoreU(hn::IfThenElseZero(few, hn::Div(value, shot)), d, means);
        poisson(means, words + i, counts);
        const V read_noise = hn::Mul(hn::Sqrt(hn::LoadU(d, block.read + i)), hn::LoadU(d, normal + i));
        const V counted = hn::Add(hn::Mul(hn::LoadU(d, counts), shot), read_noise);
        hn::StoreU(hn::IfThenElse(few, counted, hn::LoadU(d, noisy + i)), d, noisy + i);
    }
}

bool add_block_noise(const NoiseBlock& block, float* values)
{
    const D d;
    const int lanes = int(hn::Lanes(d));
    for (int i = 0; i < block.count; i += lanes) {
        const auto used = hn::FirstN(d, std::size_t(block.count - i));
        if (!hn::AllTrue(d, hn::IsFinite(hn::IfThenElseZero(used, hn::LoadU(d, values + i)))))
            return false;
    }
    HWY_ALIGN float normal[kNoiseBuffer], noisy[kNoiseBuffer];
    HWY_NAMESPACE::normal_numbers(block, normal);
    auto any_few = hn::FirstN(d, 0);
    for (int i = 0; i < block.count; i += lanes) {
        const V value = hn::LoadU(d, values + i), shot = hn::LoadU(d, block.shot + i);
        const V shot_variance = hn::Mul(shot, hn::Max(value, hn::Zero(d)));
        const V deviation = hn::Sqrt(hn::Add(shot_variance, hn::LoadU(d, block.read + i)));
        hn::StoreU(hn::Add(value, hn::Mul(deviation, hn::LoadU(d, normal + i))), d, noisy + i);
        any_few = hn::Or(any_few, has_few_electrons(value, shot));
    }
    if (!hn::AllFalse(d, any_few))
        count_electrons(block, values, normal, noisy);
    for (int i = 0; i < block.count; i += lanes)
        hn::StoreU(hn::LoadU(d, noisy + i), d, values + i);
    return true;
}

} // namespace HWY_NAMESPACE
} // namespace srisp
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace srisp {

HWY_EXPORT(random_words);
HWY_EXPORT(normal_numbers);
HWY_EXPORT(add_block_noise);

void random_words(const NoiseBlock& block, NoiseStream stream, std::uint32_t* target)
{
    HWY_DYNAMIC_DISPATCH(random_words)(block, stream, target);
}

void normal_numbers(const NoiseBlock& block, float* target)
{
    HWY_DYNAMIC_DISPATCH(normal_numbers)(block, target);
}

bool add_block_noise(const NoiseBlock& block, float* values)
{
    return HWY_DYNAMIC_DISPATCH(add_block_noise)(block, values);
}

} // namespace srisp
#endif
