// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <utility>

#include "result/computed_image.h"

namespace srisp {

/// The pixels of a source as they are.
class StoredImage final : public ComputedImage {
public:
    static Expected<std::unique_ptr<StoredImage>> open(std::unique_ptr<PixelSource> source);

    bool is_lazy() const override { return false; }
    Expected<const OIIO::ImageSpec*> header(int subimage, int miplevel) override;
    Expected<const OIIO::ImageSpec*> full_spec(int subimage, int miplevel, int) override
    {
        return header(subimage, miplevel);
    }
    Status read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                std::size_t row_stride) override;

private:
    explicit StoredImage(std::unique_ptr<PixelSource> source) : m_source(std::move(source)) {}

    std::unique_ptr<PixelSource> m_source;
    std::map<std::pair<int, int>, OIIO::ImageSpec> m_levels;
};

} // namespace srisp
