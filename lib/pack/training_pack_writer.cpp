// SPDX-License-Identifier: Apache-2.0
#include "pack/training_pack_writer.h"

#include <algorithm>
#include <filesystem>

#include "base/file_part.h"
#include "base/hashes.h"
#include "base/input_file.h"
#include "model/safetensors.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

// The number of images is known at the end only, so the header gets a room of fixed size; the format allows spaces
// behind it.
constexpr std::size_t kHeaderRoom = 256;

/// Size and hash of a file that is complete: read back, so that what is recorded is what is there.
Expected<PackFile> describe_file(const std::string& path)
{
    const Expected<RegularFile> file = open_for_parts(path);
    if (!file)
        return file.error();
    const Expected<std::string> hash = xxh64_of_file(*file);
    if (!hash)
        return Error{ "'" + path + "' " + hash.error().message };
    return PackFile{ fs::path(path).filename().string(), file->size(), *hash };
}

std::string pixels_header(std::size_t images, int size)
{
    const std::size_t bytes = images * 3 * std::size_t(size) * size * sizeof(std::uint16_t);
    const nlohmann::json header = {
        { "pixels", { { "dtype", "U16" }, { "shape", { images, 3, size, size } }, { "data_offsets", { 0, bytes } } } }
    };
    std::string text = header.dump();
    text.resize(kHeaderRoom - 8, ' ');
    const std::uint64_t length = text.size();
    return std::string(reinterpret_cast<const char*>(&length), 8) + text;
}

} // namespace

PackImagesWriter::PackImagesWriter(const std::string& path, int size) : m_path(path), m_file(path)
{
    m_index.size = size;
    m_file.write(std::string(kHeaderRoom, ' '));
}

Status PackImagesWriter::add(const PackScene& scene, const std::vector<std::uint16_t>& pixels)
{
    m_file.write(pixels.data(), pixels.size() * sizeof(std::uint16_t));
    if (!m_file.good())
        return m_file.finish();
    m_images += scene.crops.size();
    m_index.scenes.push_back(scene);
    return {};
}

Expected<PackImagesIndex> PackImagesWriter::finish()
{
    if (m_images == 0)
        return Error{ "'" + m_path + "': no images" };
    const std::string header = pixels_header(m_images, m_index.size);
    m_file.write_start(header.data(), header.size());
    if (Status status = m_file.finish(); !status)
        return status.error();
    Expected<PackFile> file = describe_file(m_path);
    if (!file)
        return file.error();
    m_index.file = *file;
    return std::move(m_index);
}

/// Whether a folder holds a pack and nothing else. The error says what is wrong: "holds no pack.json".
static Status check_pack_folder(const std::string& folder)
{
    const fs::path path = fs::path(folder) / kPackIndexName;
    std::error_code error;
    if (!fs::exists(path, error))
        return Error{ std::string("holds no ") + kPackIndexName };
    const std::string where = "holds no pack";
    const Expected<std::string> text = read_file(path.string(), kMaxPackIndexBytes, where);
    const Expected<PackIndex> index = text ? parse_pack_index(*text, where) : text.error();
    if (!index)
        return index.error();
    std::vector<std::string> names = { kPackIndexName };
    const auto add = [&](const auto& part) {
        if (part)
            names.push_back(part->file.name);
    };
    add(index->photos);
    add(index->raws);
    add(index->cameras);
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (std::find(names.begin(), names.end(), name) == names.end() ||
            !fs::is_regular_file(entry->symlink_status(error)))
            return Error{ "holds '" + name + "', which is no file of the pack" };
    }
    return error ? Status(Error{ "cannot be listed: " + error.message() }) : Status();
}

Expected<std::unique_ptr<TrainingPackWriter>> TrainingPackWriter::create(const std::string& folder, bool replace)
{
    auto staged = StagedFolder::create(folder, check_pack_folder, replace);
    if (!staged)
        return staged.error();
    return std::unique_ptr<TrainingPackWriter>(new TrainingPackWriter(std::move(*staged)));
}

/// Takes what a writer of images made into the index.
static Status take_part(PackImagesWriter& images, std::optional<PackImagesIndex>& part)
{
    Expected<PackImagesIndex> index = images.finish();
    if (!index)
        return index.error();
    part = std::move(*index);
    return {};
}

Status TrainingPackWriter::add_photos(PackImagesWriter& images)
{
    return take_part(images, m_index.photos);
}

Status TrainingPackWriter::add_raws(PackImagesWriter& images)
{
    return take_part(images, m_index.raws);
}

Status TrainingPackWriter::add_cameras(const PackedCameras& cameras, PackCamerasIndex names)
{
    const std::string path = m_folder->path() + "/cameras.safetensors";
    const auto count = std::int64_t(names.cameras.size()), lights = std::int64_t(names.lights.size());
    const Status written =
        write_safetensors(path,
                          { { "wavelengths", "F32", { kPackWavelengths }, cameras.wavelengths.data() },
                            { "sensitivities", "F32", { count, 3, kPackWavelengths }, cameras.sensitivities.data() },
                            { "lights", "F32", { lights, kPackWavelengths }, cameras.lights.data() },
                            { "reflectance", "F32", { 3, kPackWavelengths }, cameras.reflectance.data() } },
                          {});
    if (!written)
        return written;
    Expected<PackFile> file = describe_file(path);
    if (!file)
        return file.error();
    names.file = *file;
    m_index.cameras = std::move(names);
    return {};
}

Status TrainingPackWriter::finish(const std::string& made_by, const nlohmann::json& settings)
{
    m_index.made_by = made_by;
    m_index.settings = settings;
    if (Status status = write_output_file(m_folder->path() + "/" + kPackIndexName, format_pack_index(m_index)); !status)
        return status;
    if (const auto read_back = TrainingPack::open(m_folder->path()); !read_back)
        return read_back.error();
    return m_folder->publish();
}

} // namespace srisp
