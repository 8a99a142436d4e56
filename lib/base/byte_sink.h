// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace srisp {

/// Takes the bytes of a file, one after the other.
class ByteSink {
public:
    virtual ~ByteSink() = default;

    virtual void write(const void* data, std::size_t bytes) = 0;
    void write(const std::string& text) { write(text.data(), text.size()); }
    /// Whether all went well so far.
    virtual bool good() const = 0;
};

/// In memory.
class MemorySink : public ByteSink {
public:
    using ByteSink::write;
    void write(const void* data, std::size_t bytes) override { m_bytes.append(static_cast<const char*>(data), bytes); }
    bool good() const override { return true; }

    const std::string& bytes() const { return m_bytes; }

private:
    std::string m_bytes;
};

} // namespace srisp
