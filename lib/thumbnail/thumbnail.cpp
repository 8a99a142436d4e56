// SPDX-License-Identifier: Apache-2.0
#include <srisp/thumbnail.h>

#include "thumbnail/area_squasher.h"

namespace srisp {

struct ThumbnailBuilder::State {
    AreaSquasher squasher;
};

ThumbnailBuilder::ThumbnailBuilder(int width, int height)
    : m_state(new State{ AreaSquasher(width, height, kThumbnailSize) })
{
}
ThumbnailBuilder::~ThumbnailBuilder() = default;
ThumbnailBuilder::ThumbnailBuilder(ThumbnailBuilder&&) noexcept = default;
ThumbnailBuilder& ThumbnailBuilder::operator=(ThumbnailBuilder&&) noexcept = default;

void ThumbnailBuilder::add_rows(ImageView rows)
{
    m_state->squasher.add_rows(rows);
}

Thumbnail ThumbnailBuilder::finish(int orientation) const
{
    return { m_state->squasher.finish(orientation) };
}

Thumbnail make_thumbnail(ImageView image, int orientation)
{
    ThumbnailBuilder builder(image.width, image.height);
    builder.add_rows(image);
    return builder.finish(orientation);
}

Thumbnail oriented(const Thumbnail& thumbnail, int orientation)
{
    return { oriented_square(thumbnail.rgb, kThumbnailSize, orientation) };
}

} // namespace srisp
