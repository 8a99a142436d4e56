// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "base/page_memory.h"

namespace srisp {

/// The pixels of a photo as they were decoded, from the pass that makes its thumbnail to the one that makes its result.
/// Hosts open a photo once for its metadata, which selects the parameters, and again for its pixels: the second reader
/// finds by a key what the first one decoded. It is given back to the system row by row, as the result grows.
class DecodedRows {
public:
    /// Null: it is too much to keep, with what others keep now.
    static std::shared_ptr<DecodedRows> create(std::size_t row_bytes, int rows);
    ~DecodedRows();
    DecodedRows(const DecodedRows&) = delete;
    DecodedRows& operator=(const DecodedRows&) = delete;

    unsigned char* row(int y) const { return m_pages->data() + std::size_t(y) * m_row_bytes; }
    /// Whether a row is still there, once all were put.
    bool holds(int y) const { return y >= m_first; }
    void forget_before(int y);

    /// Lets the next reader find rows that are complete, as long as the caller or another keeps them.
    static void offer(const std::string& key, const std::shared_ptr<DecodedRows>& rows);
    /// The rows of a key; null: there are none, or another reader has taken them.
    static std::shared_ptr<DecodedRows> take(const std::string& key);

private:
    DecodedRows(std::unique_ptr<PageMemory> pages, std::size_t row_bytes, int rows)
        : m_pages(std::move(pages)), m_row_bytes(row_bytes), m_rows(rows)
    {
    }

    std::unique_ptr<PageMemory> m_pages;
    std::size_t m_row_bytes;
    int m_rows, m_first = 0;
};

} // namespace srisp
