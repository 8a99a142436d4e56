// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <libraw/libraw.h>
#include <malloc.h>
#include <srisp/dng.h>
#include <srisp/noise.h>

#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

namespace {

constexpr int kRepeats = 7;
constexpr int kWidth = 6000;
constexpr NoiseModel kNoise{ { 2e-4, 2e-4, 2e-4 }, { 1e-6, 1e-6, 1e-6 } };

/// What a sensor may see: the photo of the settings, darkened; without one, waves from black to half of white.
Picture raw_picture(const BenchSettings& settings)
{
    const int height = std::max(2, int(settings.megapixels * 1e6 / kWidth));
    Picture picture(kWidth, height);
    if (!settings.photo.empty()) {
        picture = bench_picture(settings, kWidth, height);
        std::transform(picture.rgb.begin(), picture.rgb.end(), picture.rgb.begin(),
                       [](float v) { return 0.5f * v * v; });
        return picture;
    }
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < kWidth; ++x)
            for (int c = 0; c < 3; ++c)
                picture.mutable_view().pixel(x, y)[c] =
                    float(0.25 + 0.25 * std::sin(x * 0.004 + c) * std::cos(y * 0.003));
    return picture;
}

/// A plane of a mosaic.
struct Plane {
    int width, height;
    std::vector<float> values;

    explicit Plane(const Picture& picture)
        : width(picture.width), height(picture.height), values(std::size_t(width) * std::size_t(height))
    {
    }
    MutablePlaneView view() { return { values.data(), width, height, 1, width }; }
};

/// The plane as 16 bits that keep what noise puts below black.
std::vector<std::uint16_t> stored(const Plane& plane)
{
    constexpr float kBlack = 4096, kRange = 65535 - kBlack;
    std::vector<std::uint16_t> result;
    for (const float value : plane.values)
        result.push_back(std::uint16_t(std::clamp(kBlack + value * kRange, 0.0f, 65535.0f)));
    return result;
}

/// Writes the file, and lets LibRaw decode it.
class DngTrial {
public:
    DngTrial(const std::string& path, const DngImage& image, DngCompression compression, int threads)
        : m_path(path), m_image(image)
    {
        m_options.compression = compression;
        m_options.threads = threads;
    }
    double write_seconds() const
    {
        return seconds([&] { require(write_dng(m_path, m_image, m_options)); });
    }
    double read_seconds() const
    {
        return seconds([&] {
            LibRaw raw;
            if (raw.open_file(m_path.c_str()) != 0 || raw.unpack() != 0)
                throw std::runtime_error("LibRaw cannot unpack '" + m_path + "'");
        });
    }
    /// Beyond the image.
    double write_memory_mb() const
    {
        malloc_trim(0); // else what was freed before would be used again, and not be seen
        const double before_mb = memory_mb("VmRSS:");
        reset_peak_memory();
        write_seconds();
        return memory_mb("VmHWM:") - before_mb;
    }

private:
    std::string m_path;
    const DngImage& m_image;
    DngOptions m_options;
};

/// On one core, where no pixel has few electrons.
BenchLine noise_line(const Picture& picture)
{
    Plane plane(picture);
    const float enough = 1.05f * float(kPoissonElectrons * kNoise.shot[0]);
    std::vector<double> rates;
    for (int i = 0; i < kRepeats; ++i) {
        require(make_mosaic(picture.view(), {}, plane.view(), 1));
        for (float& value : plane.values)
            value = std::max(value, enough);
        rates.push_back(double(plane.values.size()) / 1e6 /
                        seconds([&] { require(add_noise(plane.view(), {}, kNoise, 1, 1)); }));
    }
    return { "noise_speed", median(rates), "Mpx/s per core", ">= 100",
             "add_noise, at least " + std::to_string(kPoissonElectrons) + " electrons everywhere" };
}

} // namespace

BenchLines bench_raw_out(const BenchSettings& settings)
{
    const tool::TemporaryFolder folder;
    const Picture picture = raw_picture(settings);
    const auto noisy = [&](Plane& plane) {
        require(make_mosaic(picture.view(), {}, plane.view(), settings.threads));
        require(add_noise(plane.view(), {}, kNoise, 1, settings.threads));
    };
    Plane plane(picture);
    noisy(plane);
    const std::vector<std::uint16_t> samples = stored(plane);
    DngImage image;
    image.width = plane.width;
    image.height = plane.height;
    image.shorts = samples.data();
    image.row_stride = plane.width;
    image.cfa_pattern = "RGGB";
    image.black = { 4096 };
    const DngTrial plain((folder.path() / "plain.dng").string(), image, DngCompression::none, settings.threads);
    const DngTrial lossless((folder.path() / "lossless.dng").string(), image, DngCompression::lossless,
                            settings.threads);
    std::vector<double> noise, write, write_lossless, read_lossless;
    for (int i = 0; i < kRepeats; ++i) {
        noise.push_back(seconds([&] { noisy(plane); }));
        write.push_back(plain.write_seconds());
        write_lossless.push_back(lossless.write_seconds());
        read_lossless.push_back(lossless.read_seconds());
    }
    const auto ms = [](const std::vector<double>& times) { return digits(median(times) * 1e3, 0) + " ms"; };
    const std::string size = digits(settings.megapixels, 1) + " Mpx, ";
    return { { "mosaic_noise", median(noise) / median(write), "x", "<= 1.0",
               size + ms(noise) + "; base: writing it to the temporary folder as an uncompressed DNG of 16 bits, " +
                   ms(write) },
             noise_line(picture),
             { "dng_lossless", median(write_lossless) / median(read_lossless), "x", "<= 1.5",
               size + "writing, " + ms(write_lossless) + "; base: LibRaw's open and unpack of it, " +
                   ms(read_lossless) },
             { "dng_memory", std::max(plain.write_memory_mb(), lossless.write_memory_mb()), "MB", "<= 100",
               "writing, beyond the image; the larger one of both" } };
}
