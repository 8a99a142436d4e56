// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_stream.h"

#include <algorithm>
#include <cstring>

namespace srisp {

// Bit readers look a few bytes ahead, also at the end of a whole file.
static constexpr int kLookAhead = 8;
// Some decoders (Panasonic, Fujifilm) read blocks of bytes of fixed size, of which the last may reach beyond the end.
static constexpr std::size_t kLargestBlock = 65536;

int RawStream::at_end()
{
    if (m_end_is_error && ++m_bytes_past_end > kLookAhead)
        throw LIBRAW_EXCEPTION_IO_EOF;
    return -1;
}

int RawStream::read(void* target, size_t size, size_t count)
{
    if (size == 0 || count == 0)
        return 0;
    const std::size_t left = m_size - m_position;
    const std::size_t wanted = count > left / size ? left : size * count;
    const std::size_t allowed = size == 1 ? kLargestBlock : 0;
    const bool missing = wanted == 0 || count > (wanted + allowed) / size;
    if (missing && m_end_is_error)
        throw LIBRAW_EXCEPTION_IO_EOF;
    std::memcpy(target, m_data + m_position, wanted);
    m_position += wanted;
    m_consumed += m_end_is_error ? wanted : 0;
    return int(wanted / size);
}

int RawStream::seek(INT64 offset, int whence)
{
    const INT64 size = INT64(m_size);
    const INT64 base = whence == SEEK_SET ? 0 : whence == SEEK_CUR ? INT64(m_position) : size;
    // Clamped on both sides, without overflow.
    m_position = std::size_t(std::clamp(offset, -base, size - base) + base);
    return 0;
}

char* RawStream::gets(char* target, int size)
{
    if (size < 1 || m_position >= m_size)
        return nullptr;
    int length = 0;
    while (length + 1 < size && m_position < m_size) {
        const char c = char(m_data[m_position++]);
        if (c == '\n')
            break;
        target[length++] = c;
    }
    target[length] = 0;
    return target;
}

} // namespace srisp
