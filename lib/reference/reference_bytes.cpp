// SPDX-License-Identifier: Apache-2.0
#include "reference/reference_bytes.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "raw_file/decoder_process.h"

namespace srisp {

namespace {

/// Appends values: numbers as they lie in memory, sizes in front of what varies.
class ByteWriter {
public:
    template<class Number> std::enable_if_t<std::is_arithmetic_v<Number>> add(const Number& number)
    {
        m_bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    }
    template<class Value, std::size_t Count> void add(const std::array<Value, Count>& values)
    {
        for (const Value& value : values)
            add(value);
    }
    template<class Sequence> auto add(const Sequence& sequence) -> decltype(sequence.begin(), void())
    {
        add(std::uint64_t(sequence.size()));
        for (const auto& value : sequence)
            add(value);
    }
    void add(const CameraFacts::ColorMatrix& matrix)
    {
        add(matrix.xyz_to_camera);
        add(matrix.illuminant);
        add(matrix.forward);
    }

    std::string take() { return std::move(m_bytes); }

private:
    std::string m_bytes;
};

/// Takes them again. What does not fit leaves `whole` false, and values as they are.
class ByteReader {
public:
    explicit ByteReader(const std::string& bytes) : m_bytes(bytes) {}

    template<class Number> std::enable_if_t<std::is_arithmetic_v<Number>> add(Number& number)
    {
        if (sizeof number > m_bytes.size() - m_at) {
            m_failed = true;
            return;
        }
        std::memcpy(&number, m_bytes.data() + m_at, sizeof number);
        m_at += sizeof number;
    }
    template<class Value, std::size_t Count> void add(std::array<Value, Count>& values)
    {
        for (Value& value : values)
            add(value);
    }
    template<class Sequence> auto add(Sequence& sequence) -> decltype(sequence.begin(), void())
    {
        std::uint64_t size = 0;
        add(size);
        sequence.clear();
        // A value has a byte at least, so no size can make this go on for long.
        for (std::uint64_t i = 0; i < size && !m_failed; ++i) {
            sequence.emplace_back();
            add(sequence.back());
        }
    }
    void add(std::string& text)
    {
        std::uint64_t size = 0;
        add(size);
        if (size > m_bytes.size() - m_at) {
            m_failed = true;
            return;
        }
        text = m_bytes.substr(m_at, size);
        m_at += size;
    }
    void add(CameraFacts::ColorMatrix& matrix)
    {
        add(matrix.xyz_to_camera);
        add(matrix.illuminant);
        add(matrix.forward);
    }

    bool whole() const { return !m_failed && m_at == m_bytes.size(); }

private:
    const std::string& m_bytes;
    std::size_t m_at = 0;
    bool m_failed = false;
};

/// All that is passed on, in its order.
template<class Bytes, class Reference> void pass(Bytes& bytes, Reference& reference)
{
    bytes.add(reference.hash);
    bytes.add(reference.thumbnail.rgb);
    bytes.add(reference.notes);
    auto& facts = reference.facts;
    bytes.add(facts.make);
    bytes.add(facts.model);
    bytes.add(facts.width);
    bytes.add(facts.height);
    bytes.add(facts.orientation);
    bytes.add(facts.cfa_pattern);
    bytes.add(facts.black_level);
    bytes.add(facts.white_level);
    bytes.add(facts.color_matrices);
    bytes.add(facts.as_shot_neutral);
    bytes.add(facts.iso);
    bytes.add(facts.exposure_time_s);
    bytes.add(facts.f_number);
    bytes.add(facts.noise_profile);
}

} // namespace

std::string bytes_of_reference(const Reference& reference)
{
    ByteWriter writer;
    pass(writer, reference);
    return writer.take();
}

Expected<Reference> reference_of_bytes(const std::string& bytes)
{
    Reference reference;
    const std::size_t values = reference.thumbnail.rgb.size();
    ByteReader reader(bytes);
    pass(reader, reference);
    const std::vector<float>& rgb = reference.thumbnail.rgb;
    const bool sound = reader.whole() && rgb.size() == values &&
                       std::all_of(rgb.begin(), rgb.end(), [](float v) { return v >= 0 && v <= 1; });
    if (!sound)
        return decoder_nonsense();
    return reference;
}

} // namespace srisp
