// SPDX-License-Identifier: Apache-2.0
#include "reflectance.h"

#include <cmath>

#include "../common/failure.h"
#include "base/matrix3.h"

namespace srisp::tool {

namespace {

// The fourth principal component of the 190 measured reflectances has half the variance of the third: each step brings
// the three closer by that factor, 200 by more than double precision can show.
constexpr int kIterations = 200;

double dot(const Spectrum& a, const Spectrum& b)
{
    double sum = 0;
    for (int i = 0; i < kPackWavelengths; ++i)
        sum += a[i] * b[i];
    return sum;
}

/// Gram–Schmidt; false if the three are not independent.
bool orthonormalize(std::array<Spectrum, 3>& vectors)
{
    for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t j = 0; j < k; ++j) {
            const double shared = dot(vectors[k], vectors[j]);
            for (int i = 0; i < kPackWavelengths; ++i)
                vectors[k][i] -= shared * vectors[j][i];
        }
        const double norm = std::sqrt(dot(vectors[k], vectors[k]));
        if (!(norm > 1e-12))
            return false;
        for (double& value : vectors[k])
            value /= norm;
    }
    return true;
}

/// Spans the space of the first three principal components: orthogonal iteration. Only the span matters.
std::array<Spectrum, 3> principal_components(const std::vector<Spectrum>& measured)
{
    std::array<Spectrum, 3> vectors{};
    for (int k = 0; k < 3; ++k)
        for (int i = 0; i < kPackWavelengths; ++i)
            vectors[k][i] = std::cos(k * i * M_PI / kPackWavelengths);
    bool independent = orthonormalize(vectors);
    for (int iteration = 0; iteration < kIterations && independent; ++iteration) {
        std::array<Spectrum, 3> next{};
        for (const Spectrum& reflectance : measured)
            for (std::size_t k = 0; k < 3; ++k) {
                const double weight = dot(reflectance, vectors[k]);
                for (int i = 0; i < kPackWavelengths; ++i)
                    next[k][i] += weight * reflectance[i];
            }
        vectors = next;
        independent = orthonormalize(vectors);
    }
    if (!independent)
        fail("the measured reflectances have fewer than three independent spectra");
    return vectors;
}

} // namespace

std::array<Spectrum, 3> reflectance_basis(const std::vector<Spectrum>& measured,
                                          const std::array<Spectrum, 3>& observer, const Spectrum& d65)
{
    const std::array<Spectrum, 3> components = principal_components(measured);
    const double white = dot(observer[1], d65);
    Matrix3 seen; // XYZ of each component
    for (int row = 0; row < 3; ++row)
        for (int k = 0; k < 3; ++k) {
            double sum = 0;
            for (int i = 0; i < kPackWavelengths; ++i)
                sum += observer[row][i] * d65[i] * components[k][i];
            seen[row * 3 + k] = float(sum / white);
        }
    const Matrix3 mix = product(inverse(seen), kSrgbToXyz);
    std::array<Spectrum, 3> basis{};
    for (int color = 0; color < 3; ++color)
        for (int k = 0; k < 3; ++k)
            for (int i = 0; i < kPackWavelengths; ++i)
                basis[color][i] += double(mix[k * 3 + color]) * components[k][i];
    return basis;
}

} // namespace srisp::tool
