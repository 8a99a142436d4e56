// SPDX-License-Identifier: Apache-2.0
// small_pack FOLDER: writes a training pack of smooth made-up images, large enough to train on for a few steps. It
// needs no image library, so the trainer alone can be tested.
#include <cmath>
#include <cstdio>

#include "pack/training_pack_writer.h"

using namespace srisp;

namespace {

constexpr int kSize = kSmallestPackImage;

void require(const Status& status)
{
    if (!status) {
        std::fprintf(stderr, "small_pack: %s\n", status.error().message.c_str());
        std::exit(1);
    }
}

/// Waves whose direction and colour depend on `number`; `gains`: of R, G, B.
std::vector<std::uint16_t> image(int number, const std::array<double, 3>& gains)
{
    std::vector<std::uint16_t> pixels;
    for (int c = 0; c < 3; ++c)
        for (int y = 0; y < kSize; ++y)
            for (int x = 0; x < kSize; ++x) {
                const double wave = 0.5 + 0.45 * std::sin(0.1 * (number + 2) * x + 0.07 * y * (c + 1) + number + c);
                pixels.push_back(std::uint16_t(65535 * gains[std::size_t(c)] * wave));
            }
    return pixels;
}

PackScene scene(const std::string& name, const std::string& group, bool validation)
{
    PackScene scene;
    scene.common.name = name;
    scene.common.group = group;
    scene.common.source = "small_pack";
    scene.common.licence = "CC0-1.0";
    scene.common.open = true;
    scene.common.validation = validation;
    scene.crops.push_back({ 0, 0, 1, 1 });
    return scene;
}

void add_photos(TrainingPackWriter& pack)
{
    PackImagesWriter photos(pack.photos_path(), kSize);
    for (int i = 0; i < 8; ++i)
        require(photos.add(scene("photo" + std::to_string(i), "waves", i >= 6), image(i, { 1, 0.9, 0.8 })));
    require(pack.add_photos(photos));
}

void add_raws(TrainingPackWriter& pack)
{
    PackImagesWriter raws(pack.raws_path(), kSize);
    for (int i = 0; i < 6; ++i) {
        PackScene raw = scene("raw" + std::to_string(i), i < 3 ? "Camera One" : "Camera Two", i >= 3);
        raw.common.white_balance = { 2, 1, 1.6f };
        raw.common.color = { 1.6f, -0.5f, -0.1f, -0.2f, 1.5f, -0.3f, 0, -0.5f, 1.5f };
        require(raws.add(raw, image(i + 20, { 0.4, 0.8, 0.5 })));
    }
    require(pack.add_raws(raws));
}

void add_cameras(TrainingPackWriter& pack)
{
    PackedCameras cameras;
    PackCamerasIndex names;
    for (int i = 0; i < kPackWavelengths; ++i)
        cameras.wavelengths.push_back(kFirstWavelength_nm + float(i) * kWavelengthStep_nm);
    const auto bell = [](float nm, double centre, double width) {
        return float(std::exp(-std::pow((nm - centre) / width, 2)));
    };
    for (int camera = 0; camera < 5; ++camera) {
        for (const double centre : { 605.0, 540.0, 465.0 })
            for (const float nm : cameras.wavelengths)
                cameras.sensitivities.push_back(bell(nm, centre + 4 * camera, 40 + 2 * camera));
        names.cameras.push_back({ "Camera " + std::to_string(camera), "", "small_pack", "CC0-1.0", camera == 4 });
    }
    for (const double slope : { 0.0, 1.0 })
        for (const float nm : cameras.wavelengths)
            cameras.lights.push_back(float(1 + slope * (nm - 560) / 200));
    names.lights = { { "D65", "daylight", "small_pack", "CC0-1.0", false },
                     { "A", "tungsten", "small_pack", "CC0-1.0", false } };
    for (const float nm : cameras.wavelengths)
        cameras.reflectance.push_back(1 / (1 + std::exp((585 - nm) / 12)));
    for (const float nm : cameras.wavelengths)
        cameras.reflectance.push_back(1 / (1 + std::exp((nm - 585) / 12)) - 1 / (1 + std::exp((nm - 495) / 12)));
    for (const float nm : cameras.wavelengths)
        cameras.reflectance.push_back(1 / (1 + std::exp((nm - 495) / 12)));
    require(pack.add_cameras(cameras, names));
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fputs("usage: small_pack FOLDER\n", stderr);
        return 2;
    }
    auto pack = TrainingPackWriter::create(argv[1], true);
    if (!pack) {
        std::fprintf(stderr, "small_pack: %s\n", pack.error().message.c_str());
        return 1;
    }
    add_photos(**pack);
    add_raws(**pack);
    add_cameras(**pack);
    require((*pack)->finish("small_pack", { { "crops", 0 } }));
    return 0;
}
