// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <set>

#include <doctest/doctest.h>
#include <srisp/select.h>

using namespace srisp;

namespace {

Parameters parameters_of(std::optional<float> deviation)
{
    Parameters parameters;
    parameters.gain = 3;
    parameters.brightness_sd_ev = deviation;
    parameters.model_name = "m";
    return parameters;
}

double drawn(std::uint64_t seed, const std::string& photo, float deviation = 0.5f)
{
    Parameters parameters = parameters_of(deviation);
    REQUIRE(choose_brightness(parameters, { 0, true }, seed, photo));
    CHECK(parameters.gain == doctest::Approx(3 / std::exp2(parameters.brightness_ev)));
    return parameters.brightness_ev;
}

} // namespace

TEST_CASE("a brightness in EV divides the gain by powers of two, and is recorded; one more adds to it")
{
    Parameters parameters = parameters_of({});
    REQUIRE(choose_brightness(parameters, { 1 }, 0, "a.jpg"));
    CHECK(parameters.gain == 1.5f);
    CHECK(parameters.brightness_ev == 1);
    REQUIRE(choose_brightness(parameters, { -2.5 }, 0, "a.jpg"));
    CHECK(parameters.gain == doctest::Approx(3 * std::exp2(1.5)));
    CHECK(parameters.brightness_ev == -1.5f);
}

TEST_CASE("a sample depends on seed, photo and deviation alone")
{
    CHECK(drawn(7, "a.jpg") == drawn(7, "a.jpg"));
    CHECK(drawn(7, "a.jpg") != drawn(8, "a.jpg"));
    CHECK(drawn(7, "a.jpg") != drawn(7, "b.jpg"));
    CHECK(drawn(7, "a.jpg", 1) == doctest::Approx(2 * drawn(7, "a.jpg")));
    CHECK(drawn(7, "a.jpg", 0) == 0);
    CHECK(std::fabs(drawn(7, "a.jpg", 20)) <= 20);
}

TEST_CASE("samples have the deviation of the parameters")
{
    double sum = 0, squares = 0;
    int within = 0;
    constexpr int count = 4000;
    for (int i = 0; i < count; ++i) {
        const double ev = drawn(i, "photo.jpg");
        sum += ev;
        squares += ev * ev;
        within += std::fabs(ev) < 0.5;
    }
    CHECK(std::fabs(sum / count) < 0.03);
    CHECK(std::sqrt(squares / count) == doctest::Approx(0.5).epsilon(0.04));
    CHECK(within / double(count) == doctest::Approx(0.683).epsilon(0.04));
}

TEST_CASE("a sample says in a note what was drawn, and needs a deviation")
{
    Parameters parameters = parameters_of(0.5f);
    std::vector<std::string> notes;
    REQUIRE(choose_brightness(parameters, { 0, true }, 9, "a.jpg", &notes));
    REQUIRE(notes.size() == 1);
    CHECK(notes[0].find("a brightness of ") == 0);
    CHECK(notes[0].find(" EV was drawn (standard deviation 0.50 EV, seed 9)") != std::string::npos);
    CHECK(std::fabs(std::stod(notes[0].substr(16)) - parameters.brightness_ev) < 1e-4);

    Parameters unknown = parameters_of({});
    const Status refused = choose_brightness(unknown, { 0, true }, 9, "a.jpg");
    REQUIRE(!refused);
    CHECK(refused.error().message ==
          "brightness 'sample' has no standard deviation to draw from: model 'm' tells none, or the parameters lack "
          "brightness_sd_ev; brightness=EV gives a number");
    CHECK(unknown.gain == 3);
}

TEST_CASE("a gain that no number can hold is refused")
{
    Parameters parameters = parameters_of({});
    parameters.gain = 1e-36f;
    CHECK(choose_brightness(parameters, { 20 }, 0, "a.jpg").error().message ==
          "brightness of +20 EV: the gain becomes 9.54284e-43"); // the nearest that a float has
}

TEST_CASE("a brightness that is unsure by more than 0.7 EV gets a note")
{
    CHECK(brightness_note(parameters_of({})).empty());
    CHECK(brightness_note(parameters_of(0.7f)).empty());
    CHECK(brightness_note(parameters_of(0.91f)) ==
          "the brightness is unsure, its standard deviation is 0.91 EV; "
          "brightness=EV makes the result that much brighter, or darker below 0");
}
