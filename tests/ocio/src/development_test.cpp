// SPDX-License-Identifier: Apache-2.0
// OpenColorIO's development against the library's.
#include <srisp/ocio_transform.h>

#include <cmath>

#include <doctest/doctest.h>

#include "image_compare.h"
#include "ocio/ocio_pixels.h"

using namespace srisp;

namespace {

Development some_development(Highlights highlights)
{
    Development development;
    development.space = "ACES2065-1";
    development.multipliers = { 2.1f, 1, 1.4f };
    development.matrix = { 0.7f, 0.2f, 0.1f, 0.05f, 1.0f, -0.05f, 0.02f, -0.1f, 1.08f };
    development.highlights = highlights;
    development.white = 0.8f;
    return development;
}

/// From −0.1 to 1.2.
Colors wide_grid()
{
    Colors colors = dense_grid(20);
    for (float& value : colors)
        value = value * 1.3f - 0.1f;
    return colors;
}

Colors by_library(const Development& development, Colors rgb, bool back = false)
{
    const int width = int(rgb.size() / 3);
    const MutableImageView view{ rgb.data(), width, 1, 3, 3 * width };
    require(back ? undo_development(development, view, view) : develop(development, view, view));
    return rgb;
}

} // namespace

TEST_CASE("a development in OpenColorIO is the library's, values below 0 and above 1 included")
{
    for (const Highlights highlights : { Highlights::clip, Highlights::keep }) {
        const Development development = some_development(highlights);
        const auto group = require(make_ocio_development(development));
        const Colors in = wide_grid();
        CHECK(compare(through_ocio(group, in), by_library(development, in)).largest <= 2e-6);
    }
}

TEST_CASE("OpenColorIO's inverse of a development is the library's")
{
    const Development development = some_development(Highlights::keep);
    const auto group = require(make_ocio_development(development));
    group->setDirection(OCIO::TRANSFORM_DIR_INVERSE);
    const Colors in = wide_grid();
    CHECK(compare(through_ocio(group, in), by_library(development, in, true)).largest <= 2e-6);
}

TEST_CASE("a CLF file of a development is the same transform")
{
    const ScratchFolder folder;
    const Development development = some_development(Highlights::clip);
    const std::string text = require(make_development_clf(development, { "id", "name", { "a & b" } }));
    auto file = OCIO::FileTransform::Create();
    const std::string path = folder.path("d.clf");
    write_file(path, text);
    file->setSrc(path.c_str());
    const Colors in = wide_grid();
    CHECK(compare(through_ocio(file, in), by_library(development, in)).largest <= 2e-6);
}

TEST_CASE("blended highlights are refused")
{
    const auto group = make_ocio_development(some_development(Highlights::blend));
    REQUIRE_FALSE(group);
    CHECK(group.error().message == "highlights that are blended have no OpenColorIO transform: clip or keep");
    CHECK_FALSE(make_development_clf(some_development(Highlights::blend), {}));
}
