// SPDX-License-Identifier: Apache-2.0
#include <doctest/doctest.h>
#include <srisp/noise.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

const char kProfiles[] = R"({"version": 0, "noiseprofiles": [
  {"maker": "Canon", "models": [
    {"comment": "by someone", "model": "EOS 5D", "profiles": [
      {"name": "EOS 5D iso 100", "iso": 100, "a": [1e-5, 2e-5, 3e-5], "b": [1e-7, 2e-7, -3e-8]},
      {"name": "EOS 5D iso 150", "iso": 150, "skip": true, "a": [1, 1, 1], "b": [1, 1, 1]},
      {"name": "EOS 5D iso 400", "iso": 400, "a": [7e-5, 8e-5, 9e-5], "b": [4e-7, 5e-7, 6e-7]},
      {"name": "EOS 5D iso 200", "iso": 200, "a": [2e-5, 4e-5, 6e-5], "b": [3e-7, 4e-7, 5e-7]}]},
    {"model": "EOS 6D", "profiles": [{"name": "x", "iso": 100, "skip": true, "a": [1, 1, 1], "b": [0, 0, 0]}]},
    {"model": "EOS 7D", "profiles": [{"name": "seven", "iso": 100, "a": [1e-5, 1e-5], "b": [0, 0, 0]}]}]},
  {"maker": "Nikon", "models": [
    {"model": "D700", "profiles": [{"name": "y", "iso": 200, "a": [1e-5, 1e-5, 1e-5], "b": [0, 0, 0]}]}]}]})";

Expected<NoiseModel> noise_of(const std::string& make, const std::string& model, double iso,
                              const std::string& text = kProfiles)
{
    const ScratchFolder folder;
    const auto noise = darktable_noise(folder.file("p.json", text), make, model, iso);
    if (noise)
        return noise;
    const std::string& message = noise.error().message;
    REQUIRE(message.find(folder.path("p.json")) == 1);
    return Error{ message.substr(folder.path("p.json").size() + 2) };
}

} // namespace

TEST_CASE("an ISO of darktable's profiles gives its figures, with those below 0 as 0")
{
    const auto noise = noise_of("Canon", "EOS 5D", 100);
    REQUIRE(noise);
    CHECK(noise->shot == std::array<double, 3>{ 1e-5, 2e-5, 3e-5 });
    CHECK(noise->read == std::array<double, 3>{ 1e-7, 2e-7, 0 });
}

TEST_CASE("between two ISOs the figures are interpolated, past entries to skip and in any order of the file")
{
    const auto low = noise_of("Canon", "EOS 5D", 150), high = noise_of("Canon", "EOS 5D", 350);
    REQUIRE(low);
    REQUIRE(high);
    CHECK(low->shot[0] == doctest::Approx(1.5e-5));
    CHECK(low->read[1] == doctest::Approx(3e-7));
    CHECK(high->shot[2] == doctest::Approx(0.25 * 6e-5 + 0.75 * 9e-5));
    CHECK(high->read[0] == doctest::Approx(0.25 * 3e-7 + 0.75 * 4e-7));
}

TEST_CASE("a camera is found whatever the case, spaces, and the make before its model")
{
    for (const auto& [make, model] : { std::pair{ "CANON", "eos5d" },
                                       { "Canon", "Canon EOS 5D" },
                                       { "NIKON CORPORATION", "NIKON D700" },
                                       { "Nikon", "D700" } }) {
        INFO(make, " ", model);
        CHECK(noise_of(make, model, 200));
    }
}

TEST_CASE("what darktable's profiles do not have is refused with what is near")
{
    CHECK(noise_of("Canon", "EOS 5D", 401).error().message ==
          ": ISO 401 is outside of the camera's noise profiles, 100 to 400");
    CHECK(noise_of("Canon", "EOS 5D", 99).error().message ==
          ": ISO 99 is outside of the camera's noise profiles, 100 to 400");
    CHECK(noise_of("Canon", "EOS 8D", 100).error().message ==
          ": no noise profile of 'Canon' 'EOS 8D'; did you mean 'EOS 5D' or 'EOS 6D' or 'EOS 7D'?");
    CHECK(noise_of("Cannon", "EOS 5D", 100).error().message ==
          ": no noise profile of 'Cannon' 'EOS 5D'; did you mean 'Canon'?");
    CHECK(noise_of("", "", 100).error().message == ": no noise profile of '' ''; known: Canon, Nikon");
    CHECK(noise_of("Canon", "EOS 6D", 100).error().message == ": noise profiles of 'EOS 6D': none to use");
    CHECK(noise_of("Canon", "EOS 7D", 100).error().message ==
          ": noise profile 'seven': needs an iso above 0, and three numbers below 1 each as a and b");
}

TEST_CASE("other files than noiseprofiles.json are refused")
{
    CHECK(noise_of("a", "b", 1, "{").error().message.find(": file is not a JSON object") == 0);
    CHECK(noise_of("a", "b", 1, "{}").error().message ==
          ": no list 'noiseprofiles', as darktable's noiseprofiles.json has it");
    CHECK(noise_of("a", "b", 1, R"({"version": 3, "noiseprofiles": []})").error().message ==
          ": version 3 of noise profiles: only 0 is known");
    CHECK(noise_of("a", "b", 1, R"({"noiseprofiles": [1, {"maker": 3}, {"maker": "a", "models": [5]}]})")
              .error()
              .message.find(": no noise profile of 'a' 'b'") == 0);
    CHECK(darktable_noise("/nowhere/p.json", "a", "b", 1).error().message.find("'/nowhere/p.json': ") == 0);
}
