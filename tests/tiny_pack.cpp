// SPDX-License-Identifier: Apache-2.0
#include "tiny_pack.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "base/hashes.h"
#include "pack/training_pack_writer.h"

using namespace srisp;

namespace {

void require(const Status& status)
{
    if (!status)
        throw std::runtime_error(status.error().message);
}

PackScene scene_named(const std::string& name, std::size_t crops)
{
    PackScene scene;
    scene.common.name = name;
    scene.common.group = scene.common.source = "somebody/photos";
    scene.common.licence = "CC0";
    scene.common.open = true;
    scene.crops.push_back({ 0, 0, 1, 1 });
    for (std::size_t i = 1; i < crops; ++i)
        scene.crops.push_back({ 0.25f, 0, 0.75f, 0.5f });
    return scene;
}

/// Pixels number `first` and following.
std::vector<std::uint16_t> counted_pixels(std::size_t first, std::size_t images)
{
    std::vector<std::uint16_t> pixels(images * 3 * kSmallestPackImage * kSmallestPackImage);
    for (std::size_t i = 0; i < pixels.size(); ++i)
        pixels[i] = std::uint16_t((first + i) * 7);
    return pixels;
}

void add_cameras(TrainingPackWriter& pack)
{
    PackedCameras cameras;
    PackCamerasIndex names;
    for (int i = 0; i < kPackWavelengths; ++i)
        cameras.wavelengths.push_back(kFirstWavelength_nm + float(i) * kWavelengthStep_nm);
    cameras.sensitivities.assign(2 * 3 * kPackWavelengths, 0.5f);
    cameras.lights.assign(2 * kPackWavelengths, 1);
    cameras.reflectance.assign(3 * kPackWavelengths, 0.3f);
    names.cameras = { { "Anna One", "", "anna.json", "Apache-2.0", false },
                      { "Berta Two", "", "berta.json", "Apache-2.0", true } };
    names.lights = { { "D65", "daylight", "lights.csv", "CC0", false },
                     { "A", "tungsten", "lights.csv", "CC0", false } };
    require(pack.add_cameras(cameras, names));
}

} // namespace

void write_tiny_pack(const std::string& folder)
{
    auto created = TrainingPackWriter::create(folder, true);
    if (!created)
        throw std::runtime_error(created.error().message);
    TrainingPackWriter& pack = **created;
    PackImagesWriter photos(pack.photos_path(), kSmallestPackImage);
    const std::vector<std::uint16_t> first = counted_pixels(0, 2);
    require(photos.add(scene_named("a.jpg", 2), first));
    require(photos.add(scene_named("b.jpg", 1), counted_pixels(first.size(), 1)));
    require(pack.add_photos(photos));
    PackImagesWriter raws(pack.raws_path(), kSmallestPackImage);
    PackScene raw = scene_named("c.dng", 1);
    raw.common.group = "Nikon D1";
    raw.common.validation = true;
    raw.common.white_balance = { 2, 1, 1.5f };
    raw.common.color = { 2, -1, 0, 0, 1, 0, 0, -1, 2 };
    require(raws.add(raw, counted_pixels(0, 1)));
    require(pack.add_raws(raws));
    add_cameras(pack);
    require(pack.finish("a test", { { "crops", 1 } }));
}

std::string bytes_of(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    return { std::istreambuf_iterator<char>(file), {} };
}

void write_bytes(const std::string& path, const std::string& bytes)
{
    std::ofstream(path, std::ios::binary) << bytes;
}

void edit_index(const std::string& folder, const std::function<void(nlohmann::json&)>& edit)
{
    nlohmann::json index = nlohmann::json::parse(bytes_of(folder + "/pack.json"));
    edit(index);
    write_bytes(folder + "/pack.json", index.dump());
}

void edit_part(const std::string& folder, const std::string& part, const std::function<void(std::string&)>& edit)
{
    const std::string path = folder + "/" + part + ".safetensors";
    std::string bytes = bytes_of(path);
    edit(bytes);
    write_bytes(path, bytes);
    edit_index(folder, [&](nlohmann::json& index) {
        index[part]["bytes"] = bytes.size();
        index[part]["hash"] = xxh64_of_bytes(bytes.data(), bytes.size());
    });
}

std::string open_error(const std::string& folder)
{
    const auto pack = TrainingPack::open(folder);
    return pack ? std::string() : pack.error().message;
}
