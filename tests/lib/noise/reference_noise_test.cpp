// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>
#include <srisp/noise.h>

#include "lib/reference/synthetic_dng.h"
#include "noise/file_noise.h"
#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

namespace {

using T = SyntheticDng;

constexpr int kWidth = 1536, kHeight = 1024;
constexpr double kShot = 1e-3, kRead = 2e-5, kBlack = 512, kWhite = 16383;

/// Stored values of slopes with noise, of phase RGGB.
const std::vector<std::uint16_t>& noisy_slopes()
{
    static const std::vector<std::uint16_t> stored = [] {
        std::vector<float> values;
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                values.push_back(
                    float(0.002 + 0.85 * std::pow(double(x) / kWidth, 2) * (1 + 0.05 * std::sin(0.01 * y))));
        const NoiseModel noise{ { kShot, kShot, kShot }, { kRead, kRead, kRead } };
        REQUIRE(add_noise({ values.data(), kWidth, kHeight, 1, kWidth }, {}, noise, 5));
        std::vector<std::uint16_t> result;
        for (const float value : values)
            result.push_back(
                std::uint16_t(std::lround(std::clamp(kBlack + double(value) * (kWhite - kBlack), 0.0, kWhite))));
        return result;
    }();
    return stored;
}

SyntheticDng noisy_dng()
{
    SyntheticDng dng;
    dng.resize(kWidth, kHeight).set(50714, T::kShort, { kBlack }).set(50717, T::kShort, { kWhite });
    return dng.fill([](int x, int y, int) { return double(noisy_slopes()[std::size_t(y * kWidth + x)]); });
}

Reference loaded(const std::string& path)
{
    const auto reference = load_reference(path);
    REQUIRE_MESSAGE(reference, (reference ? "" : reference.error().message));
    return **reference;
}

std::string refusal(const Reference& reference, bool isolate = true)
{
    const auto noise = reference_noise(reference, isolate);
    return noise ? "(it has noise)" : noise.error().message;
}

std::string no_estimate(const std::string& path)
{
    return "reference '" + path + "': no NoiseProfile, and noise cannot be estimated from it: ";
}

void check_estimate(const Expected<NoiseModel>& noise)
{
    REQUIRE_MESSAGE(noise, (noise ? "" : noise.error().message));
    for (std::size_t c = 0; c < 3; ++c) {
        CHECK(noise->shot[c] == doctest::Approx(kShot).epsilon(0.1));
        CHECK(noise->read[c] == doctest::Approx(kRead).epsilon(0.2));
    }
}

} // namespace

TEST_CASE("a reference's NoiseProfile is its noise, and its file is not looked at")
{
    Reference reference;
    reference.path = "/nowhere/a.dng";
    reference.facts.cfa_pattern = "RGGB";
    reference.facts.noise_profile = { 1e-4, 2e-7, 3e-4, 4e-7, 5e-4, 6e-7 };
    const auto noise = reference_noise(reference);
    REQUIRE(noise);
    CHECK(noise->shot == std::array<double, 3>{ 1e-4, 3e-4, 5e-4 });
    CHECK(noise->read == std::array<double, 3>{ 2e-7, 4e-7, 6e-7 });
}

TEST_CASE("the noise of a RAW file without a NoiseProfile to use is estimated, the same in a process of its own")
{
    const ScratchFolder folder;
    SyntheticDng dng = noisy_dng();
    const Reference plain = loaded(folder.file("plain.dng", dng.bytes()));
    const auto apart = reference_noise(plain), here = reference_noise(plain, false);
    check_estimate(apart);
    check_estimate(here);
    CHECK(apart->shot == here->shot);
    CHECK(apart->read == here->read);

    // Four pairs: whether for R, G, G, B or as the filters lie is said nowhere.
    dng.set(51041, T::kDouble, { 0.1, 0, 0.2, 0, 0.3, 0, 0.4, 0 });
    const Reference four = loaded(folder.file("four.dng", dng.bytes()));
    REQUIRE(four.facts.noise_profile.size() == 8);
    check_estimate(reference_noise(four));
}

TEST_CASE("the noise of plain samples that a file beside them describes is estimated")
{
    const ScratchFolder folder;
    folder.file("plate.raw.json", R"({"width": 1536, "height": 1024, "cfa": "RGGB", "bits": 14, "black": 512,
        "white": 16383})");
    const auto& stored = noisy_slopes();
    const std::string path =
        folder.file("plate.raw", { reinterpret_cast<const char*>(stored.data()), stored.size() * 2 });
    const Reference reference = loaded(path);
    check_estimate(reference_noise(reference));
    folder.file("plate.raw.json", R"({"width": 1536, "height": 1024, "cfa": "RGGB", "bits": 14, "black": 500,
        "white": 16383})");
    CHECK(refusal(reference) == no_estimate(path) + "the file has changed since it became the reference");
}

TEST_CASE("images of three channels have no noise to estimate, wherever they come from")
{
    const ScratchFolder folder;
    const std::string reason = "it is no mosaic as a sensor has it, and demosaicing mixes the noise of neighbours";
    SyntheticDng dng;
    dng.resize(64, 48).linear().fill([](int x, int y, int s) { return 9000 + 100 * x + 50 * y + s; }, 3);
    const std::string linear = folder.file("linear.dng", dng.bytes());
    CHECK(refusal(loaded(linear)) == no_estimate(linear) + reason);

    const std::string exr = folder.path("linear.exr");
    const auto output = OIIO::ImageOutput::create(exr);
    REQUIRE(output->open(exr, OIIO::ImageSpec(64, 48, 3, OIIO::TypeHalf)));
    REQUIRE(output->write_image(OIIO::TypeFloat, std::vector<float>(64 * 48 * 3, 0.25f).data()));
    REQUIRE(output->close());
    CHECK(refusal(loaded(exr)) == no_estimate(exr) + reason);
}

TEST_CASE("a picture without flat blocks, a file that is gone or another one by now: each is told, in both ways")
{
    const ScratchFolder folder;
    SyntheticDng small;
    small.resize(64, 48).fill([](int x, int y, int) { return 1000 + 500 * x + 300 * y; });
    const std::string path = folder.file("a.dng", small.bytes());
    const Reference reference = loaded(path);
    for (const bool isolate : { true, false }) {
        CAPTURE(isolate);
        folder.file("a.dng", small.bytes());
        CHECK(refusal(reference, isolate).find(no_estimate(path) + "R: too few flat blocks (0 of 32") == 0);
        folder.file("a.dng", noisy_dng().bytes());
        CHECK(refusal(reference, isolate) == no_estimate(path) + "the file has changed since it became the reference");
        folder.file("a.dng", small.bytes().substr(0, 600));
        CHECK(refusal(reference, isolate).find(no_estimate(path) + "truncated: ") == 0);
        std::filesystem::remove(path);
        CHECK(refusal(reference, isolate) == no_estimate(path) + "No such file or directory");
    }
    Reference unusable = reference;
    unusable.facts.noise_profile = { 3, 0 };
    CHECK(refusal(unusable) == "reference '" + path +
                                   "': NoiseProfile: shot noise 3 is not in [0,1], and noise cannot be estimated from "
                                   "it: No such file or directory");
    Reference nameless = reference;
    nameless.path.clear();
    nameless.name = "in memory";
    CHECK(refusal(nameless) == no_estimate("in memory") + "it was not read from a file");
}

TEST_CASE("figures come back from bytes, and bytes that are none are the decoder's nonsense")
{
    const FileNoise noise{ { { 0.1, 0.2, 0.3 }, { 0.4, 0.5, 0.6 } }, "xxh128:0" };
    const std::string bytes = bytes_of_noise(noise);
    const auto after = noise_of_bytes(bytes);
    REQUIRE(after);
    CHECK(after->noise.shot == noise.noise.shot);
    CHECK(after->noise.read == noise.noise.read);
    CHECK(after->hash == noise.hash);
    const std::string nonsense = "makes its decoder answer with nonsense; it is damaged, or made to do harm";
    for (const std::string& wrong : { std::string(), bytes.substr(0, 47), std::string(60, '\xff') }) {
        const auto refused = noise_of_bytes(wrong);
        REQUIRE(!refused);
        CHECK(refused.error().message == nonsense);
    }
}

TEST_CASE("a camera's file without a NoiseProfile is estimated the same in a process of its own")
{
    SKIP_WITHOUT_SHARED("data/raw/canon_kiss_x4.dng");
    const Reference reference = loaded(shared_file("data/raw/canon_kiss_x4.dng"));
    const auto apart = reference_noise(reference), here = reference_noise(reference, false);
    REQUIRE_MESSAGE(apart, (apart ? "" : apart.error().message));
    REQUIRE(here);
    CHECK(apart->shot == here->shot);
    CHECK(apart->read == here->read);
}

TEST_CASE("a camera's NoiseProfile is used though an estimate would differ")
{
    SKIP_WITHOUT_SHARED("data/raw/gopro_hero6.dng");
    const auto noise = reference_noise(loaded(shared_file("data/raw/gopro_hero6.dng")));
    REQUIRE(noise);
    CHECK(noise->shot[0] == doctest::Approx(0.000156201000208966));
    CHECK(noise->read[2] == doctest::Approx(4.88001994369824e-08));
}
