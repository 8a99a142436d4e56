// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "base/shown_text.h"

// What the fuzz targets share. Each is a file of targets/ with one function LLVMFuzzerTestOneInput: libFuzzer calls it
// with inputs of its own making (run.sh), and fuzz_replay with the seeds that are checked in.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace srisp::fuzz {

/// Ends the program where a property does not hold, so that the fuzzer keeps the input.
inline void must_hold(bool holds, const char* property, const std::string& detail = "")
{
    if (holds)
        return;
    std::fprintf(stderr, "property broken: %s%s%s\n", property, detail.empty() ? "" : ": ", detail.c_str());
    std::abort();
}

/// What every message is: a text of one line of UTF-8.
inline void check_message(const std::string& message)
{
    must_hold(!message.empty(), "an error has a message");
    must_hold(valid_utf8(message) == message, "a message is UTF-8", valid_utf8(message));
    must_hold(message.find('\n') == std::string::npos, "a message is one line", message);
}

/// What most values of images are.
template<class Values> void must_be_in_unit_range(const Values& values, const char* property)
{
    for (const float value : values)
        if (!(value >= 0 && value <= 1))
            must_hold(false, property, std::to_string(value));
}

/// Whether there is a value; else the error is checked.
template<class Result> bool is_accepted(const Result& result)
{
    if (!result)
        check_message(result.error().message);
    return bool(result);
}

/// An input as a text; an allocation of its own, so that the sanitizer sees every read beyond it.
inline std::string text_of(const std::uint8_t* data, std::size_t size)
{
    return { reinterpret_cast<const char*>(data), size };
}

/// Takes values from an input; 0 where it is used up.
class Draws {
public:
    Draws(const std::uint8_t* data, std::size_t size) : m_data(data), m_size(size) {}

    template<class Number> Number number()
    {
        Number value{};
        const std::size_t count = sizeof value < m_size ? sizeof value : m_size;
        std::memcpy(&value, m_data, count);
        skip(count);
        return value;
    }
    /// From 0 to `limit` − 1.
    int below(int limit) { return int(number<std::uint16_t>() % unsigned(limit)); }
    bool flag() { return number<std::uint8_t>() & 1; }
    /// From `low` to `high`, both among them.
    float within(float low, float high) { return low + (high - low) * float(number<std::uint16_t>()) / 65535.0f; }
    /// Mostly within such a range; one in eight is any float.
    float odd_float(float low, float high)
    {
        return number<std::uint8_t>() % 8 == 0 ? number<float>() : within(low, high);
    }
    std::string text(std::size_t count)
    {
        const std::string result = text_of(m_data, count < m_size ? count : m_size);
        skip(result.size());
        return result;
    }
    /// To the next zero byte.
    std::string line()
    {
        const void* end = m_size ? std::memchr(m_data, 0, m_size) : nullptr;
        const std::string result = text(end ? std::size_t(static_cast<const std::uint8_t*>(end) - m_data) : m_size);
        skip(m_size ? 1 : 0);
        return result;
    }
    std::string rest() { return text(m_size); }
    bool at_end() const { return m_size == 0; }

private:
    void skip(std::size_t count)
    {
        m_data += count;
        m_size -= count;
    }

    const std::uint8_t* m_data;
    std::size_t m_size;
};

} // namespace srisp::fuzz
