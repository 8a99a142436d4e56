// SPDX-License-Identifier: Apache-2.0
#include "result/stored_image.h"

#include <algorithm>
#include <vector>

namespace srisp {

Expected<std::unique_ptr<StoredImage>> StoredImage::open(std::unique_ptr<PixelSource> source)
{
    auto image = std::unique_ptr<StoredImage>(new StoredImage(std::move(source)));
    const auto first = image->header(0, 0);
    if (!first)
        return first.error();
    if (!*first || (*first)->deep || (*first)->depth > 1)
        return Error{ image->m_source->name() + ": is deep or a volume, which no sensor sees" };
    return image;
}

Expected<const OIIO::ImageSpec*> StoredImage::header(int subimage, int miplevel)
{
    const auto key = std::make_pair(subimage, miplevel);
    auto found = m_levels.find(key);
    if (found == m_levels.end()) {
        auto spec = subimage < 0 || miplevel < 0 ? std::nullopt : m_source->find_level(subimage, miplevel);
        if (!spec)
            return static_cast<const OIIO::ImageSpec*>(nullptr);
        spec->set_format(OIIO::TypeFloat);
        spec->channelformats.clear();
        found = m_levels.emplace(key, std::move(*spec)).first;
    }
    return static_cast<const OIIO::ImageSpec*>(&found->second);
}

Status StoredImage::read(int subimage, int miplevel, int, int x0, int x1, int y0, int y1, float* out,
                         std::size_t row_stride)
{
    const OIIO::ImageSpec& spec = m_levels.at({ subimage, miplevel });
    const auto channels = std::size_t(spec.nchannels), row = std::size_t(spec.width) * channels;
    if (x0 == 0 && x1 == spec.width && row_stride == row)
        return m_source->read_rows(subimage, miplevel, y0, y1, out);
    std::vector<float> rows(row * std::size_t(y1 - y0));
    const Status read = m_source->read_rows(subimage, miplevel, y0, y1, rows.data());
    for (int y = y0; read && y < y1; ++y, out += row_stride)
        std::copy_n(rows.data() + row * std::size_t(y - y0) + std::size_t(x0) * channels,
                    std::size_t(x1 - x0) * channels, out);
    return read;
}

} // namespace srisp
