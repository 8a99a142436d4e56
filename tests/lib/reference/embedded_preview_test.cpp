// SPDX-License-Identifier: Apache-2.0
#include "reference/embedded_preview.h"

#include <doctest/doctest.h>

#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

TEST_CASE("the JPEG that a camera put into its file comes out, within the decoder's process and here")
{
    SKIP_WITHOUT_SHARED("data/raw/canon_eos_d30.crw");
    const std::string path = shared_file("data/raw/canon_eos_d30.crw");
    const auto isolated = embedded_preview(path, true), here = embedded_preview(path, false);
    REQUIRE(isolated);
    REQUIRE(here);
    CHECK(*isolated == *here);
    CHECK(isolated->size() > 10000);
    CHECK(isolated->substr(0, 2) == "\xff\xd8");
}

TEST_CASE("files without one, and what is no RAW file, are errors")
{
    const ScratchFolder folder;
    const auto none = embedded_preview(SRISP_SOURCE_DIR "/configs/sample/reference.dng", true);
    REQUIRE(!none);
    CHECK(none.error().message.find("has no embedded picture") != std::string::npos);
    CHECK(!embedded_preview(folder.file("a.dng", std::string(1000, 'x')), true));
    CHECK(!embedded_preview(folder.path("none.dng"), true));
}
