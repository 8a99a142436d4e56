// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "train/samples/packed_images.h"
#include "train/tensors/random.h"

/// Cameras with bell-shaped sensitivities, of which the last is for validation, and two lights.
inline srisp::PackedCameras small_cameras()
{
    srisp::PackedCameras cameras;
    const auto bells = [](std::vector<float>& spectra, double shift, double width,
                          std::initializer_list<double> peaks) {
        for (const double peak : peaks)
            for (int i = 0; i < srisp::kPackWavelengths; ++i) {
                const double x = (380 + 5 * i - peak - shift) / width;
                spectra.push_back(static_cast<float>(std::exp(-x * x)));
            }
    };
    for (int i = 0; i < srisp::kPackWavelengths; ++i)
        cameras.wavelengths.push_back(380 + 5 * i);
    for (int camera = 0; camera < 5; ++camera) {
        cameras.names.push_back("camera " + std::to_string(camera));
        cameras.validation.push_back(camera == 4);
        bells(cameras.sensitivities, 4 * camera, 38 + camera, { 600, 540, 460 });
    }
    bells(cameras.reflectance, 0, 60, { 640, 540, 450 });
    cameras.light_names = { "day", "lamp" };
    cameras.light_kinds = { "daylight", "fluorescent" };
    bells(cameras.lights, 0, 200, { 500 });
    bells(cameras.lights, 0, 60, { 590 });
    return cameras;
}

/// Pictures of a few random rectangles. Of each scene the whole and `crops` more; the scenes after `open` are not open.
struct SmallImages {
    std::vector<std::uint16_t> pixels;
    srisp::PackedImages images;

    SmallImages(int scenes, int crops, int open, int size, std::uint64_t seed)
    {
        images.size = size;
        for (int i = 0; i < scenes * (1 + crops); ++i) {
            srisp::PackEntry entry;
            entry.scene = i / (1 + crops);
            entry.open = entry.scene < open;
            entry.group = "camera";
            entry.white_balance = { 2.0f, 1.0f, 1.5f };
            images.entries.push_back(entry);
            paint(size, srisp::train::Random(seed, i));
        }
        images.read = [this, count = std::size_t(3) * size * size](std::size_t entry, std::uint16_t* values) {
            std::copy_n(pixels.data() + entry * count, count, values);
            return srisp::Status();
        };
    }
    SmallImages(const SmallImages&) = delete;
    SmallImages& operator=(const SmallImages&) = delete;

private:
    void paint(int size, srisp::train::Random random)
    {
        const std::size_t first = pixels.size(), plane = std::size_t(size) * size;
        pixels.resize(first + 3 * plane, static_cast<std::uint16_t>(random.integer(65536)));
        for (int i = 0; i < 12; ++i) {
            const auto left = random.integer(size), top = random.integer(size);
            for (int c = 0; c < 3; ++c) {
                const auto value = static_cast<std::uint16_t>(random.integer(65536));
                for (auto y = top; y < std::min<std::int64_t>(size, top + size / 3); ++y)
                    for (auto x = left; x < std::min<std::int64_t>(size, left + size / 3); ++x)
                        pixels[first + c * plane + y * size + x] = value;
            }
        }
    }
};

inline srisp::train::Randoms randoms(int count, std::uint64_t seed)
{
    srisp::train::Randoms result;
    for (int i = 0; i < count; ++i)
        result.emplace_back(seed, 0, i);
    return result;
}
