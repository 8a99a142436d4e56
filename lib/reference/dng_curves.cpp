// SPDX-License-Identifier: Apache-2.0
#include "reference/dng_curves.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace srisp {

namespace {

constexpr unsigned kMapTable = 7, kMapPolynomial = 8;
constexpr std::size_t kMostCurves = 64; // one per plane in real files; each has a table of 256 KiB
constexpr std::size_t kAreaBytes = 32, kMostEntries = 65536, kMostCoefficients = 9;
constexpr int kSteps = 65536;

/// Opcode lists are big-endian in every file.
std::uint64_t integer(const std::string& bytes, std::size_t at, std::size_t count)
{
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i)
        value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
}

/// A table of 16-bit values; entries beyond its end are the last one.
std::vector<float> map_table(const std::string& bytes)
{
    const std::size_t entries = std::size_t(integer(bytes, kAreaBytes, 4));
    if (entries < 1 || entries > kMostEntries || bytes.size() < kAreaBytes + 4 + 2 * entries)
        return {};
    std::vector<float> table(kSteps);
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = float(integer(bytes, kAreaBytes + 4 + 2 * std::min(i, entries - 1), 2)) / 65535;
    return table;
}

/// Coefficients from that of x⁰ upwards.
std::vector<float> map_polynomial(const std::string& bytes)
{
    const std::size_t count = std::size_t(integer(bytes, kAreaBytes, 4)) + 1;
    if (count > kMostCoefficients || bytes.size() < kAreaBytes + 4 + 8 * count)
        return {};
    std::vector<double> coefficients;
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint64_t bits = integer(bytes, kAreaBytes + 4 + 8 * i, 8);
        coefficients.emplace_back();
        std::memcpy(&coefficients.back(), &bits, 8);
        if (!std::isfinite(coefficients.back()))
            return {};
    }
    std::vector<float> table(kSteps);
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double x = double(i) / (kSteps - 1);
        double sum = 0;
        for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c)
            sum = sum * x + *c;
        table[i] = float(std::min(std::max(sum, 0.0), 1.0));
    }
    return table;
}

} // namespace

DngCurves::DngCurves(const std::string& list)
{
    constexpr std::size_t kHead = 16; // opcode, version, flags, size
    if (list.empty())
        return;
    std::uint64_t left = list.size() < 4 ? 1 : integer(list, 0, 4);
    std::size_t at = 4;
    for (; left > 0 && at + kHead <= list.size(); --left) {
        const auto opcode = unsigned(integer(list, at, 4));
        const std::size_t size = std::size_t(integer(list, at + 12, 4));
        at += kHead;
        if (size > list.size() - at)
            break;
        m_complete &= add(opcode, list.substr(at, size));
        at += size;
    }
    m_complete &= left == 0;
}

bool DngCurves::add(unsigned opcode, const std::string& parameters)
{
    if ((opcode != kMapTable && opcode != kMapPolynomial) || parameters.size() < kAreaBytes + 4 ||
        m_curves.size() == kMostCurves)
        return false;
    const auto number = [&](std::size_t index) { return double(integer(parameters, 4 * index, 4)); };
    Curve curve{ number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7), {} };
    curve.table = opcode == kMapTable ? map_table(parameters) : map_polynomial(parameters);
    if (curve.table.empty() || curve.row_pitch < 1 || curve.column_pitch < 1)
        return false;
    m_curves.push_back(std::move(curve));
    return true;
}

void DngCurves::apply(int y, int width, int channels, float* row) const
{
    for (const Curve& curve : m_curves) {
        if (y < curve.top || y >= curve.bottom || std::fmod(y - curve.top, curve.row_pitch) != 0)
            continue;
        const int end = int(std::min(double(width), curve.right));
        const int last_plane = int(std::min(double(channels), curve.plane + curve.planes));
        for (double x = curve.left; x < end; x += curve.column_pitch)
            for (int c = int(std::min(double(channels), curve.plane)); c < last_plane; ++c) {
                float& value = row[int(x) * channels + c];
                const float place = value * (kSteps - 1);
                const int below = std::min(int(place), kSteps - 2);
                const float part = place - float(below);
                value = curve.table[std::size_t(below)] * (1 - part) + curve.table[std::size_t(below) + 1] * part;
            }
    }
}

} // namespace srisp
