// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include <libraw/libraw.h>

namespace srisp {

/// A file in memory as LibRaw reads it. LibRaw's own memory stream reads text without end checks, and most of its
/// decoders do not notice the end of the file; this one ends decoding there, so truncated files are errors and end
/// soon.
class RawStream final : public LibRaw_abstract_datastream {
public:
    /// `data` must outlive this object.
    RawStream(const unsigned char* data, std::size_t size) : m_data(data), m_size(size) {}

    /// From now on reading beyond the end throws LIBRAW_EXCEPTION_IO_EOF, which LibRaw::unpack catches.
    void end_is_error() { m_end_is_error = true; }
    /// Bytes that were read since end_is_error.
    std::size_t consumed() const { return m_consumed; }

    int valid() override { return 1; }
    int read(void* target, size_t size, size_t count) override;
    int seek(INT64 offset, int whence) override;
    INT64 tell() override { return INT64(m_position); }
    INT64 size() override { return INT64(m_size); }
    int get_char() override
    {
        if (m_position >= m_size)
            return at_end();
        m_consumed += m_end_is_error;
        return m_data[m_position++];
    }
    char* gets(char* target, int size) override;
    int scanf_one(const char*, void*) override { return 0; } // nothing in LibRaw 0.20 calls it
    int eof() override { return m_position >= m_size; }
    void* make_jas_stream() override { return nullptr; } // Redcode; Debian's LibRaw is built without Jasper

private:
    int at_end();

    const unsigned char* m_data;
    std::size_t m_size, m_position = 0, m_consumed = 0;
    int m_bytes_past_end = 0;
    bool m_end_is_error = false;
};

} // namespace srisp
