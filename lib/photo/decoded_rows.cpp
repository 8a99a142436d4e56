// SPDX-License-Identifier: Apache-2.0
#include "photo/decoded_rows.h"

#include <algorithm>
#include <atomic>
#include <map>
#include <mutex>

#include "container/image_memory.h"

namespace srisp {

namespace {

/// Of all that are kept at a time: hosts keep many photos open, of which they may never read the pixels.
constexpr std::size_t kMostBytes = std::size_t(320) << 20; // 100 megapixels of 8-bit RGB
std::atomic<std::size_t> bytes_kept{ 0 };

struct Offers {
    std::mutex mutex;
    std::map<std::string, std::weak_ptr<DecodedRows>> rows;
};
Offers& offers()
{
    // Never destroyed: other threads may still read while statics end.
    static Offers& all = *new Offers;
    return all;
}

} // namespace

std::shared_ptr<DecodedRows> DecodedRows::create(std::size_t row_bytes, int rows)
{
    const std::size_t bytes = row_bytes * std::size_t(rows);
    if (const auto most = most_image_memory(); bytes > kMostBytes || !most || bytes > *most)
        return nullptr;
    auto pages = PageMemory::create(bytes);
    if (!pages)
        return nullptr;
    const auto made = std::shared_ptr<DecodedRows>(new DecodedRows(std::move(pages), row_bytes, rows));
    return (bytes_kept += bytes) <= kMostBytes ? made : nullptr;
}

DecodedRows::~DecodedRows()
{
    bytes_kept -= m_row_bytes * std::size_t(m_rows - m_first);
}

void DecodedRows::forget_before(int y)
{
    if (y <= m_first)
        return;
    bytes_kept -= m_row_bytes * std::size_t(y - m_first);
    m_first = y;
    m_pages->forget_before(m_row_bytes * std::size_t(y));
}

void DecodedRows::offer(const std::string& key, const std::shared_ptr<DecodedRows>& rows)
{
    Offers& all = offers();
    const std::lock_guard lock(all.mutex);
    for (auto i = all.rows.begin(); i != all.rows.end();)
        i = i->second.expired() ? all.rows.erase(i) : std::next(i);
    all.rows[key] = rows;
}

std::shared_ptr<DecodedRows> DecodedRows::take(const std::string& key)
{
    Offers& all = offers();
    const std::lock_guard lock(all.mutex);
    const auto found = all.rows.find(key);
    if (found == all.rows.end())
        return nullptr;
    const auto rows = found->second.lock();
    all.rows.erase(found);
    return rows;
}

} // namespace srisp
