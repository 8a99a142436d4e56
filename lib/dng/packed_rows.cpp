// SPDX-License-Identifier: Apache-2.0
#include "dng/packed_rows.h"

#include <cstring>
#include <vector>

#include "base/half_float.h"

namespace srisp {

std::size_t packed_row_bytes(std::size_t count, int bits)
{
    return (count * std::size_t(bits) + 7) / 8;
}

void append_packed_row(const std::uint16_t* samples, std::size_t count, int bits, std::string& target)
{
    const std::size_t begin = target.size();
    target.resize(begin + packed_row_bytes(count, bits));
    char* at = target.data() + begin;
    if (bits == 16) {
        std::memcpy(at, samples, count * 2);
        return;
    }
    std::uint32_t waiting = 0;
    int waiting_bits = 0;
    for (std::size_t i = 0; i < count; ++i) {
        waiting = waiting << bits | samples[i];
        for (waiting_bits += bits; waiting_bits >= 8;)
            *at++ = char(waiting >> (waiting_bits -= 8) & 255);
    }
    if (waiting_bits > 0)
        *at = char(waiting << (8 - waiting_bits) & 255);
}

void append_float_row(const float* samples, std::size_t count, int bits, std::string& target)
{
    if (bits == 32) {
        target.append(reinterpret_cast<const char*>(samples), count * 4);
        return;
    }
    const std::size_t begin = target.size();
    target.resize(begin + count * 2);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint16_t half = half_from_float(samples[i]);
        std::memcpy(target.data() + begin + i * 2, &half, 2);
    }
}

void predict_float_row(unsigned char* row, std::size_t samples, std::size_t bytes_per_sample, std::size_t planes)
{
    const std::size_t size = samples * bytes_per_sample;
    const std::vector<unsigned char> source(row, row + size);
    for (std::size_t i = 0; i < samples; ++i)
        for (std::size_t byte = 0; byte < bytes_per_sample; ++byte)
            row[(bytes_per_sample - 1 - byte) * samples + i] = source[i * bytes_per_sample + byte];
    for (std::size_t i = size; i-- > planes;)
        row[i] = static_cast<unsigned char>(row[i] - row[i - planes]);
}

} // namespace srisp
