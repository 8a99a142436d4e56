// SPDX-License-Identifier: Apache-2.0
// Writes a report of made-up numbers with made-up pictures, for report_browser_test.py to look at.
// Usage: make_report OUTPUT.html paired|unpaired IMAGES SHOWN
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include "sample_evaluation.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

constexpr int kWidth = 192, kHeight = 128;
constexpr std::array<float, 3> kBalance{ 2.1f, 1, 1.6f };
constexpr std::array<float, 9> kColor{ 1.6f, -0.45f, -0.15f, -0.2f, 1.5f, -0.3f, 0.05f, -0.45f, 1.4f };

using Pixels = std::vector<std::array<float, 3>>;

class FileSink : public ByteSink {
public:
    explicit FileSink(const char* path) : m_file(path, std::ios::binary) {}
    using ByteSink::write;
    void write(const void* data, std::size_t bytes) override
    {
        m_file.write(static_cast<const char*>(data), std::streamsize(bytes));
    }
    bool good() const override { return m_file.good(); }

private:
    std::ofstream m_file;
};

std::string image_file(const char* name, int width, int height, const std::vector<unsigned char>& bytes)
{
    std::vector<unsigned char> file;
    OIIO::Filesystem::IOVecOutput proxy(file);
    auto output = OIIO::ImageOutput::create(name, &proxy);
    if (!output || !output->open(name, OIIO::ImageSpec(width, height, 3, OIIO::TypeDesc::UINT8)) ||
        !output->write_image(OIIO::TypeDesc::UINT8, bytes.data()) || !output->close())
        std::exit(1);
    return { file.begin(), file.end() };
}

/// A hill of light, a dark half, stripes and discs of colour, in camera RGB.
Pixels scene(std::size_t seed, int width, int height)
{
    Pixels pixels;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double u = double(x) / width, v = double(y) / height;
            const double disc = std::hypot(u - 0.3 - 0.02 * double(seed % 9), (v - 0.5) * 0.7);
            double light = 0.05 + 0.5 * u * u + (std::fmod(v * 8, 2) < 1 ? 0.03 : 0);
            if (disc < 0.18)
                light = 0.95;
            const double hue = 6.28 * (v + 0.1 * double(seed));
            pixels.push_back({ float(light * (0.45 + 0.2 * std::cos(hue))), float(light * 0.9),
                               float(light * (0.5 + 0.25 * std::sin(hue))) });
        }
    return pixels;
}

std::string linear_file(const Pixels& pixels, int width, int height)
{
    std::vector<unsigned char> high, low;
    for (const auto& pixel : pixels)
        for (const float value : pixel) {
            const auto code = unsigned(std::lround(std::min(std::max(value, 0.0f), 1.0f) * 65535));
            high.push_back(static_cast<unsigned char>(code >> 8));
            low.push_back(static_cast<unsigned char>(code & 255));
        }
    high.insert(high.end(), low.begin(), low.end());
    return image_file("linear.png", width, height * 2, high);
}

std::string photo_file(const Pixels& pixels, int width, int height)
{
    std::vector<unsigned char> bytes;
    for (const auto& pixel : pixels)
        for (std::size_t row = 0; row < 3; ++row) {
            double value = 0;
            for (std::size_t i = 0; i < 3; ++i)
                value += double(kColor[row * 3 + i]) * kBalance[i] * pixel[i];
            bytes.push_back(static_cast<unsigned char>(std::lround(255 * std::pow(std::clamp(value, 0.0, 1.0), 0.42))));
        }
    return image_file("photo.jpg", width, height, bytes);
}

Pixels scaled(Pixels pixels, double red, double green, double blue)
{
    for (auto& pixel : pixels)
        pixel = { float(pixel[0] * red), float(pixel[1] * green), float(pixel[2] * blue) };
    return pixels;
}

ImagePictures pictures_of(const Evaluation& evaluation, std::size_t index)
{
    const Pixels truth = scene(index, kWidth, kHeight);
    ImagePictures pictures;
    pictures.width = kWidth;
    pictures.height = kHeight;
    pictures.white_balance = kBalance;
    pictures.color = kColor;
    pictures.photo = photo_file(truth, kWidth, kHeight);
    if (evaluation.has_truth)
        pictures.truth = linear_file(truth, kWidth, kHeight);
    pictures.reference_width = 96;
    pictures.reference_height = 96;
    pictures.reference = linear_file(scene(index + 5, 96, 96), 96, 96);
    for (std::size_t i = 0; i < evaluation.methods.size(); ++i) {
        const double gain = std::exp2(0.7 * std::sin(double(index * 4 + i)));
        pictures.results[evaluation.methods[i]] = linear_file(
            scaled(truth, gain * (1 + 0.1 * double(i)), gain, gain * (1.2 - 0.1 * double(i))), kWidth, kHeight);
    }
    return pictures;
}

} // namespace

int main(int count, char** arguments)
{
    if (count != 5)
        return 2;
    const Evaluation evaluation = sample_evaluation(std::string(arguments[2]) == "paired", std::atoi(arguments[3]));
    std::vector<std::size_t> shown;
    for (int i = 0; i < std::atoi(arguments[4]); ++i)
        shown.push_back(std::size_t(i * 7) % evaluation.images.size());
    FileSink out(arguments[1]);
    const Status status = write_report(
        evaluation, shown,
        [&](std::size_t index) -> Expected<ImagePictures> {
            if (index == shown.back())
                return Error{ "file '" + std::string(kHostileName) + "' has vanished" };
            return pictures_of(evaluation, index);
        },
        out);
    if (!status)
        std::fprintf(stderr, "make_report: %s\n", status.error().message.c_str());
    return status ? 0 : 1;
}
