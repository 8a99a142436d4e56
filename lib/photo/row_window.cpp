// SPDX-License-Identifier: Apache-2.0
#include "photo/row_window.h"

#include <algorithm>

namespace srisp {

Expected<std::shared_ptr<const StoredRows>> RowWindow::rows(int y0, int y1)
{
    const std::shared_ptr<const StoredRows> last = m_last;
    auto window = std::make_shared<StoredRows>(StoredRows{ y0, y1, std::vector<float>((y1 - y0) * m_row_length) });
    int first = y0;
    if (last && last->y0 <= y0 && y0 < last->y1) {
        first = std::min(last->y1, y1);
        std::copy_n(last->row(y0, m_row_length), (first - y0) * m_row_length, window->values.data());
    }
    if (first < y1) {
        const Status read =
            m_source.read_rows(m_subimage, m_miplevel, first, y1, window->values.data() + (first - y0) * m_row_length);
        if (!read)
            return read.error();
    }
    m_last = window;
    return std::shared_ptr<const StoredRows>(window);
}

} // namespace srisp
