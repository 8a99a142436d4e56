// SPDX-License-Identifier: Apache-2.0
// Memory that runs out in the plugin is an error for the host: nothing is thrown into it, and no pixel is wrong.
#include "allocations.h"

#include <functional>
#include <string_view>

#include "srisp_output.h"
#include "test_images.h"

#if SRISP_COUNTS_ALLOCATIONS

using namespace srisp;
using namespace srisp::plugin;

namespace {

constexpr int kWidth = 400, kHeight = 300;
constexpr std::size_t kLargePieces = 4 << 10; // a row of floats is 4,800 bytes

/// What opening and reading gives, in pieces of memory that the test has already.
Expected<std::size_t> read_into(std::vector<float>& pixels, const std::string& name)
{
    SrispInput input;
    OIIO::ImageSpec spec;
    std::fill(pixels.begin(), pixels.end(), -1.0f);
    if (!input.open(name, spec))
        return Error{ input.geterror() };
    for (int y = 0; y < spec.height; y += 50)
        if (!input.read_native_scanlines(0, 0, y, y + 50, 0, pixels.data() + std::size_t(3) * kWidth * y))
            return Error{ input.geterror() };
    return std::hash<std::string_view>()(
        { reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof(float) });
}

} // namespace

TEST_CASE("a photo is read without memory for one large piece")
{
    const ScratchFolder folder;
    const std::string reference = write_reference(folder), photo = write_photo(folder, "photo.png", kWidth, kHeight);
    std::vector<float> pixels(std::size_t(3) * kWidth * kHeight);
    allocations::fail_each(kLargePieces, [&] { return read_into(pixels, photo + ".srisp?reference=" + reference); });
}

TEST_CASE("an image is handed over without memory for one large piece")
{
    const ScratchFolder folder;
    write_reference(folder);
    folder.file("1.json", "{\"format\": \"srisp-recipe-1\", \"reference\": \"reference.exr\"}");
    const auto pixels = test_pixels(kWidth, kHeight, 3);
    std::vector<float> result(pixels.size());
    OIIO::ImageSpec spec(kWidth, kHeight, 3, OIIO::TypeFloat);
    spec.attribute("oiio:ColorSpace", "sRGB");
    const std::string stub = folder.path("1.0.srisp");
    allocations::fail_each(kLargePieces, [&]() -> Expected<std::size_t> {
        SrispOutput output;
        if (!output.open(stub, spec, OIIO::ImageOutput::Create))
            return Error{ output.geterror() };
        for (int y = 0; y < kHeight; ++y)
            if (!output.write_scanline(y, 0, OIIO::TypeFloat, pixels.data() + std::size_t(3) * kWidth * y,
                                       OIIO::AutoStride))
                return Error{ output.geterror() };
        if (!output.close())
            return Error{ output.geterror() };
        return read_into(result, stub);
    });
}

#endif
