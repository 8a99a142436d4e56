// SPDX-License-Identifier: Apache-2.0
#include "select/trained_range.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <srisp/model.h>
#include <srisp/select.h>

using namespace srisp;

TEST_CASE("Gains within what training showed stay as they are, without a note; others become its nearest end, with one")
{
    for (const float inside : { 0.1f, 0.112f, 1.0f, 32.0f }) {
        std::vector<std::string> notes;
        float gain = inside;
        keep_in_trained_range(gain, &notes);
        CHECK(gain == inside);
        CHECK(notes.empty());
    }
    std::vector<std::string> notes;
    float small = 0.0404f, large = 100;
    keep_in_trained_range(small, &notes);
    keep_in_trained_range(large, &notes);
    CHECK(small == 0.1f);
    CHECK(large == 32);
    CHECK(notes ==
          std::vector<std::string>{ "the chosen gain 0.0404 lies outside what the model was trained for (0.1 to "
                                    "32); 0.1 was taken",
                                    "the chosen gain 100 lies outside what the model was trained for (0.1 to "
                                    "32); 32 was taken" });
    keep_in_trained_range(large, nullptr);
}

TEST_CASE("White balances keep their smallest gain, and no gain is more than eight times that")
{
    using Balance = std::array<float, 3>;
    std::vector<std::string> notes;
    Balance usual{ 2.6f, 1, 4.2f }, red{ 20, 5, 1 }, green_is_one{ 0.1f, 1, 0.5f };
    keep_in_trained_range(usual, &notes);
    CHECK(usual == Balance{ 2.6f, 1, 4.2f });
    CHECK(notes.empty());
    keep_in_trained_range(red, &notes);
    CHECK(red == Balance{ 8, 5, 1 });
    keep_in_trained_range(green_is_one, &notes);
    CHECK(green_is_one[1] == doctest::Approx(0.8));
    REQUIRE(notes.size() == 2);
    CHECK(notes[0] ==
          "the chosen white balance 20, 5, 1 lies outside what the model was trained for (at most 8 to 1); 8, "
          "5, 1 was taken");
}

TEST_CASE("A picture of one white dot on black gets a gain that training showed, and a note")
{
    const auto model = Model::load("default");
    REQUIRE(model);
    Thumbnail photo, reference;
    std::fill_n(photo.rgb.begin() + 3 * (100 * kThumbnailSize + 100), 3 * 16, 1.0f);
    std::fill(reference.rgb.begin(), reference.rgb.end(), 0.9f);
    std::vector<std::string> notes;
    const auto parameters = srisp::select(**model, photo, reference, &notes);
    REQUIRE(parameters);
    CHECK(parameters->gain == kLeastGain);
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("the chosen gain 0.0") == 0);
    CHECK(srisp::select(**model, photo, reference)->gain == kLeastGain);
}
