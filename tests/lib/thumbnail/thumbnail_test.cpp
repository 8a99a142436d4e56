// SPDX-License-Identifier: Apache-2.0
#include <srisp/thumbnail.h>

#include <algorithm>

#include <doctest/doctest.h>

#include "image_compare.h"
#include "random_model.h"

using namespace srisp;

namespace {

struct Image {
    int width, height;
    std::vector<float> values = std::vector<float>(std::size_t(3) * width * height);
    ImageView view() const { return { values.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
};

Image random_image(int width, int height)
{
    Image image{ width, height };
    Random random(1);
    for (float& value : image.values)
        value = random.uniform(0, 1);
    return image;
}

/// The definition, cell by cell: the mean of the input area under it.
std::vector<double> area_means(const Image& image)
{
    std::vector<double> means;
    const double cell_width = image.width / 256.0, cell_height = image.height / 256.0;
    for (int cy = 0; cy < 256; ++cy)
        for (int cx = 0; cx < 256; ++cx)
            for (int c = 0; c < 3; ++c) {
                const double left = cx * cell_width, right = left + cell_width, top = cy * cell_height,
                             bottom = top + cell_height;
                double sum = 0;
                for (int y = int(top); y < std::min<double>(image.height, bottom); ++y)
                    for (int x = int(left); x < std::min<double>(image.width, right); ++x)
                        sum += (std::min(right, x + 1.0) - std::max(left, double(x))) *
                               (std::min(bottom, y + 1.0) - std::max(top, double(y))) * image.view().pixel(x, y)[c];
                means.push_back(sum / (cell_width * cell_height));
            }
    return means;
}

} // namespace

TEST_CASE("a thumbnail is the exact area average, when shrinking, when enlarging and at its own size")
{
    for (const auto& [width, height] : { std::pair(256, 256), std::pair(640, 480), std::pair(1000, 257),
                                         std::pair(3, 700), std::pair(1, 1), std::pair(255, 100) }) {
        const Image image = random_image(width, height);
        const Difference difference = compare(make_thumbnail(image.view()).rgb, area_means(image));
        INFO(width, " × ", height, ": ", difference.text);
        CHECK(difference.largest <= 1e-6);
    }
}

TEST_CASE("rows added in pieces give the bits of the whole image")
{
    const Image image = random_image(300, 411);
    ThumbnailBuilder builder(300, 411);
    for (int y = 0; y < 411; y += 50)
        builder.add_rows({ image.view().pixel(0, y), 300, std::min(50, 411 - y), 3, 900 });
    CHECK(builder.finish(1).rgb == make_thumbnail(image.view()).rgb);
}

TEST_CASE("each EXIF orientation is turned upright")
{
    // A red mark that lies at the top left of the upright picture, and a green one at its top right.
    struct Corner {
        int x, y;
    };
    const Corner first[] = { { 0, 0 }, { 255, 0 }, { 255, 255 }, { 0, 255 },
                             { 0, 0 }, { 0, 255 }, { 255, 255 }, { 255, 0 } };
    const Corner second[] = { { 255, 0 }, { 0, 0 }, { 0, 255 }, { 255, 255 },
                              { 0, 255 }, { 0, 0 }, { 255, 0 }, { 255, 255 } };
    for (int orientation = 1; orientation <= 8; ++orientation) {
        Thumbnail stored;
        stored.rgb[(first[orientation - 1].y * 256 + first[orientation - 1].x) * 3] = 1;
        stored.rgb[(second[orientation - 1].y * 256 + second[orientation - 1].x) * 3 + 1] = 1;
        const Thumbnail upright = oriented(stored, orientation);
        INFO("orientation ", orientation);
        CHECK(upright.rgb[0] == 1);
        CHECK(upright.rgb[255 * 3 + 1] == 1);
    }
}
