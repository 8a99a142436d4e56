// SPDX-License-Identifier: Apache-2.0
// An image of any shape, levels and camera, written as DNG and read again: by LibRaw, floats by our decoder.
#include <algorithm>

#include <srisp/dng.h>

#include "base/half_float.h"
#include "dng/dng_writer.h"
#include "raw_images.h"
#include "reference/decoders.h"

using namespace srisp;

namespace {

/// An image that the input describes, with the memory that it is a view of.
struct Drawn {
    DngImage image;
    DngOptions options;
    std::vector<std::uint16_t> shorts;
    std::vector<float> floats;
    std::vector<std::uint8_t> preview;

    explicit Drawn(fuzz::Draws& draws)
    {
        image.planes = draws.flag() ? 3 : 1;
        image.width = 1 + draws.below(70);
        image.height = 1 + draws.below(50);
        image.row_stride = std::ptrdiff_t(image.width) * image.planes + draws.below(3);
        const char* const patterns[] = { "RGGB", "GRBG", "GBRG", "BGGR", "RGBG", "" };
        image.cfa_pattern = image.planes == 1 || draws.below(8) == 0 ? patterns[draws.below(6)] : "";
        options.compression = DngCompression(draws.below(3));
        options.layout = DngLayout(draws.below(2));
        options.bits = draws.below(8) == 0 ? draws.below(40) : 10 + draws.below(7);
        options.threads = 1;
        draw_levels(draws);
        draw_facts(draws);
        draw_samples(draws);
    }
    Drawn(const Drawn&) = delete;
    Drawn& operator=(const Drawn&) = delete;

private:
    void draw_levels(fuzz::Draws& draws)
    {
        image.black_rows = 1 + draws.below(3);
        image.black_columns = 1 + draws.below(3);
        if (draws.flag())
            for (int i = 0; i < image.black_rows * image.black_columns * image.planes; ++i)
                image.black.push_back(draws.odd_float(0, 600));
        for (std::uint32_t& white : image.white)
            white = draws.flag() ? std::uint32_t(draws.number<std::uint16_t>()) : 0;
    }
    void draw_facts(fuzz::Draws& draws)
    {
        CameraFacts& facts = image.facts;
        facts.orientation = draws.below(10);
        facts.iso = draws.odd_float(0, 6400);
        facts.exposure_time_s = draws.odd_float(0, 30);
        facts.f_number = draws.odd_float(0, 22);
        for (float& value : facts.as_shot_neutral)
            value = draws.odd_float(0.2f, 1);
        for (int count = draws.below(3); count > 0; --count) {
            CameraFacts::ColorMatrix matrix{};
            for (int i = 0; i < 9; ++i)
                matrix.xyz_to_camera[std::size_t(i)] = draws.odd_float(-0.3f, 0.3f) + (i % 4 == 0 ? 1 : 0);
            matrix.illuminant = draws.flag() ? 21 : draws.below(300);
            facts.color_matrices.push_back(matrix);
        }
        for (int count = draws.below(8); count > 0; --count)
            facts.noise_profile.push_back(draws.odd_float(0, 0.01f));
        image.baseline_exposure = draws.odd_float(-4, 4);
        facts.make = draws.line();
        facts.model = draws.line();
        image.description = draws.line();
        image.date_time = draws.line();
    }
    void draw_samples(fuzz::Draws& draws)
    {
        const std::size_t count = std::size_t(image.row_stride) * std::size_t(image.height);
        const bool of_floats = draws.below(3) == 0;
        const unsigned mask = (1u << std::clamp(options.bits, 1, 16)) - 1;
        std::uint32_t state = draws.number<std::uint32_t>();
        for (std::size_t i = 0; i < count; ++i) {
            state = draws.at_end() ? state * 1664525 + 1013904223 : draws.number<std::uint16_t>() * 65537u;
            shorts.push_back(std::uint16_t((state >> 16) & mask));
            floats.push_back(float(state >> 8) / 16777216.0f);
        }
        if (of_floats) {
            options.bits = draws.flag() ? 32 : 16;
            image.floats = floats.data();
        } else {
            image.shorts = shorts.data();
        }
        if (draws.flag()) {
            image.preview_width = 1 + draws.below(image.width);
            image.preview_height = 1 + draws.below(image.height);
            preview.resize(std::size_t(image.preview_width) * std::size_t(image.preview_height) * 3, 99);
            image.preview = preview.data();
        }
    }
};

void check_samples(const RawPixels& pixels, const Drawn& drawn)
{
    const DngImage& image = drawn.image;
    fuzz::must_hold(pixels.width == image.width && pixels.height == image.height && pixels.channels == image.planes,
                    "an image comes back in its size");
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < image.planes; ++c) {
                const std::ptrdiff_t at = y * pixels.row_stride + x * pixels.pixel_stride + c;
                const std::ptrdiff_t from = y * image.row_stride + x * image.planes + c;
                if (image.shorts)
                    fuzz::must_hold(pixels.shorts[at] == image.shorts[from], "samples come back");
                else
                    fuzz::must_hold(pixels.floats[at] == (drawn.options.bits == 16
                                                              ? float_from_half(half_from_float(image.floats[from]))
                                                              : image.floats[from]),
                                    "float samples come back");
            }
}

void check_levels_and_filters(const RawPixels& pixels, const Drawn& drawn)
{
    const DngImage& image = drawn.image;
    if (image.planes == 1)
        fuzz::must_hold(pixels.cfa.letters == image.cfa_pattern, "filters come back");
    const auto planes = std::size_t(image.planes);
    for (std::size_t c = 0; c < planes; ++c) {
        const float white = image.floats ? 1 : float((1u << drawn.options.bits) - 1);
        fuzz::must_hold(pixels.white[c] == (image.white[c] ? float(image.white[c]) : white), "white levels come back");
    }
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 6; ++x)
            for (std::size_t c = 0; c < planes; ++c) {
                const auto place = [&](int rows, int columns) {
                    return std::size_t(y % rows * columns + x % columns) * planes + c;
                };
                const float wanted =
                    image.black.empty() ? 0 : image.black[place(image.black_rows, image.black_columns)];
                const float black = pixels.black.pattern[place(pixels.black.rows, pixels.black.columns)];
                fuzz::must_hold(std::fabs(black - wanted) <= 1e-3f + 1e-6f * wanted, "black levels come back");
            }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    fuzz::Draws draws(data, size);
    const Drawn drawn(draws);
    MemorySink sink;
    const auto notes = write_dng(sink, drawn.image, drawn.options);
    if (!fuzz::is_accepted(notes))
        return 0;
    for (const std::string& note : *notes)
        fuzz::check_message(note);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(sink.bytes().data());
    const auto raw = decode_raw(fuzz::file_of(bytes, sink.bytes().size()));
    const bool too_small = std::min(drawn.image.width, drawn.image.height) < 22; // to LibRaw
    if (!raw) {
        fuzz::check_message(raw.error().message);
        fuzz::must_hold(too_small && drawn.image.shorts, "what was written can be read", raw.error().message);
        return 0;
    }
    fuzz::check_raw_image(*raw);
    check_samples(raw->pixels, drawn);
    check_levels_and_filters(raw->pixels, drawn);
    return 0;
}
