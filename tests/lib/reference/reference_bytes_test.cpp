// SPDX-License-Identifier: Apache-2.0
#include "reference/reference_bytes.h"

#include <cmath>

#include <doctest/doctest.h>

using namespace srisp;

namespace {

Reference sample()
{
    Reference reference;
    reference.hash = "xxh128:0123";
    for (std::size_t i = 0; i < reference.thumbnail.rgb.size(); ++i)
        reference.thumbnail.rgb[i] = float(i % 1000) / 1000;
    reference.notes = { "one", "", "three" };
    CameraFacts& facts = reference.facts;
    facts.make = "Maker \xff";
    facts.model = std::string("nul \0 inside", 12);
    facts.width = 6000;
    facts.height = 4000;
    facts.orientation = 6;
    facts.cfa_pattern = "GBRG";
    facts.black_level = { 1, 2, 3, 4.5f };
    facts.white_level = 16383;
    facts.color_matrices = { { { 1, 2, 3, 4, 5, 6, 7, 8, 9 }, 21 }, { { 9, 8, 7, 6, 5, 4, 3, 2, 1 }, 17 } };
    facts.as_shot_neutral = { 0.5f, 1, 0.75f };
    facts.iso = 100;
    facts.exposure_time_s = 0.01f;
    facts.f_number = 2.8f;
    facts.noise_profile = { 1e-4, 1e-7 };
    return reference;
}

} // namespace

TEST_CASE("A reference as bytes is the same reference again")
{
    const Reference before = sample();
    const auto after = reference_of_bytes(bytes_of_reference(before));
    REQUIRE(after);
    CHECK(after->hash == before.hash);
    CHECK(after->thumbnail.rgb == before.thumbnail.rgb);
    CHECK(after->notes == before.notes);
    CHECK(after->facts.make == before.facts.make);
    CHECK(after->facts.model == before.facts.model);
    CHECK(after->facts.width == 6000);
    CHECK(after->facts.height == 4000);
    CHECK(after->facts.orientation == 6);
    CHECK(after->facts.cfa_pattern == "GBRG");
    CHECK(after->facts.black_level == before.facts.black_level);
    CHECK(after->facts.white_level == 16383);
    REQUIRE(after->facts.color_matrices.size() == 2);
    CHECK(after->facts.color_matrices[1].xyz_to_camera == before.facts.color_matrices[1].xyz_to_camera);
    CHECK(after->facts.color_matrices[1].illuminant == 17);
    CHECK(after->facts.as_shot_neutral == before.facts.as_shot_neutral);
    CHECK(after->facts.iso == 100);
    CHECK(after->facts.exposure_time_s == 0.01f);
    CHECK(after->facts.f_number == 2.8f);
    CHECK(after->facts.noise_profile == before.facts.noise_profile);
}

TEST_CASE("Bytes that are cut, too long, of wild sizes, or hold values that no thumbnail has are refused")
{
    const std::string bytes = bytes_of_reference(sample());
    for (const std::size_t size : { std::size_t(0), std::size_t(7), std::size_t(100), bytes.size() - 1 })
        CHECK(!reference_of_bytes(bytes.substr(0, size)));
    CHECK(!reference_of_bytes(bytes + "x"));
    CHECK(!reference_of_bytes(std::string(1000, '\xff')));
    Reference wrong = sample();
    wrong.thumbnail.rgb[5] = NAN;
    CHECK(!reference_of_bytes(bytes_of_reference(wrong)));
    wrong.thumbnail.rgb[5] = 1.5f;
    CHECK(!reference_of_bytes(bytes_of_reference(wrong)));
    wrong = sample();
    wrong.thumbnail.rgb.pop_back();
    CHECK(!reference_of_bytes(bytes_of_reference(wrong)));
}
