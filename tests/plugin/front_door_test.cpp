// SPDX-License-Identifier: Apache-2.0
// What the library's front door gives is what our reader gives.
#include <srisp/srisp.h>

#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

TEST_CASE("the library gives the reader's pixels and the reader's record, there and back")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder, "photo.png", 120, 700);
    Options options;
    REQUIRE(set_option(options, "model", "spatial"));
    SrispInput input;
    const OIIO::ImageSpec spec = open_ours(input, photo + ".srisp?model=spatial&reference=" + reference);
    const auto raw = unprocess(photo, reference, options);
    REQUIRE_MESSAGE(raw, (raw ? "" : raw.error().message));
    CHECK(raw->pixels() == read_all(input));
    CHECK(raw->spec().to_xml() == spec.to_xml());

    REQUIRE(raw->save(folder.path("raw.exr")));
    SrispInput back;
    const OIIO::ImageSpec back_spec = open_ours(back, folder.path("raw.exr") + ".srisp?direction=forward");
    const auto processed = process(folder.path("raw.exr"));
    REQUIRE_MESSAGE(processed, (processed ? "" : processed.error().message));
    CHECK(processed->pixels() == read_all(back));
    CHECK(processed->spec().to_xml() == back_spec.to_xml());
}
