// SPDX-License-Identifier: Apache-2.0
#include "pack/training_pack.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/hashes.h"
#include "base/input_file.h"
#include "model/safetensors.h"
#include "pack/training_pack_index.h"

namespace srisp {

namespace {

constexpr std::uint64_t kMaxCamerasBytes = std::uint64_t(1) << 28;

/// Maps a file of the pack, and checks that it is the one that the index means.
Expected<MappedFile> open_file(const std::string& folder, const PackFile& file, const std::string& where)
{
    Expected<MappedFile> mapped = MappedFile::open(folder + "/" + file.name);
    if (!mapped)
        return Error{ where + ": " + mapped.error().message };
    if (mapped->size() != file.bytes)
        return Error{ where + ": " + file.name + " has " + std::to_string(mapped->size()) + " bytes, " +
                      kPackIndexName + " says " + std::to_string(file.bytes) +
                      (mapped->size() < file.bytes ? " (truncated?)" : "") };
    const std::string hash = xxh64_of_bytes(mapped->data(), mapped->size());
    if (hash != file.hash)
        return Error{ where + ": " + file.name + " is damaged: its hash is " + hash + ", " + kPackIndexName + " says " +
                      file.hash };
    return mapped;
}

Status check_pixels(const SafeTensorsHeader& header, const std::vector<std::int64_t>& shape, const std::string& where)
{
    if (header.entries.size() != 1 || header.entries[0].name != "pixels")
        return Error{ where + " must hold one tensor, 'pixels'" };
    if (header.entries[0].shape != shape)
        return Error{ where + ": tensor 'pixels' has shape " + shape_text(header.entries[0].shape) + ", " +
                      kPackIndexName + " needs " + shape_text(shape) };
    if (header.data_begin % sizeof(std::uint16_t) != 0)
        return Error{ where + ": tensor 'pixels' begins at byte " + std::to_string(header.data_begin) +
                      ", which is odd" };
    return {};
}

Status open_images(const std::string& folder, const PackImagesIndex& index, MappedFile& file, PackedImages& images,
                   const std::string& where)
{
    Expected<MappedFile> mapped = open_file(folder, index.file, where);
    if (!mapped)
        return mapped.error();
    file = std::move(*mapped);
    images.size = index.size;
    images.entries = pack_entries(index);
    const std::string here = where + ": " + index.file.name;
    const Expected<SafeTensorsHeader> header = parse_safetensors_header(file.data(), file.size(), { "U16" }, here);
    if (!header)
        return header.error();
    const std::int64_t size = index.size;
    if (Status status = check_pixels(*header, { std::int64_t(images.entries.size()), 3, size, size }, here); !status)
        return status;
    images.pixels = reinterpret_cast<const std::uint16_t*>(file.data() + header->data_begin);
    return {};
}

/// Takes the tensors of cameras.safetensors; the first error stays.
class SpectraTaker {
public:
    SpectraTaker(SafeTensors file, std::string where) : m_file(std::move(file)), m_where(std::move(where)) {}

    std::vector<float> take(const std::string& name, std::vector<std::int64_t> shape, float low)
    {
        const auto found = m_file.tensors.find(name);
        if (found == m_file.tensors.end()) {
            fail("has no tensor '" + name + "'");
            return {};
        }
        if (found->second.shape != shape)
            fail("tensor '" + name + "' has shape " + shape_text(found->second.shape) + ", " + kPackIndexName +
                 " needs " + shape_text(shape));
        std::vector<float> values = std::move(found->second.values);
        m_file.tensors.erase(found);
        const auto bad =
            std::find_if(values.begin(), values.end(), [&](float v) { return !std::isfinite(v) || v < low; });
        if (bad != values.end())
            fail("tensor '" + name + "' has " + std::to_string(*bad) + " at element " +
                 std::to_string(bad - values.begin()));
        return values;
    }

    void fail(const std::string& why)
    {
        if (m_error.empty())
            m_error = m_where + ": " + why;
    }

    Status finish()
    {
        if (!m_file.tensors.empty())
            fail("unknown tensor '" + m_file.tensors.begin()->first + "'");
        return m_error.empty() ? Status() : Status(Error{ m_error });
    }

private:
    SafeTensors m_file;
    std::string m_where, m_error;
};

Status open_cameras(const std::string& folder, const PackCamerasIndex& index, PackedCameras& cameras,
                    const std::string& where)
{
    const Expected<MappedFile> mapped = open_file(folder, index.file, where);
    if (!mapped)
        return mapped.error();
    const std::string here = where + ": " + index.file.name;
    if (mapped->size() > kMaxCamerasBytes)
        return Error{ here + " has " + std::to_string(mapped->size()) + " bytes, limit " +
                      std::to_string(kMaxCamerasBytes) };
    Expected<SafeTensors> file = parse_safetensors({ mapped->data(), mapped->size() }, here);
    if (!file)
        return file.error();
    SpectraTaker spectra(std::move(*file), here);
    const auto count = std::int64_t(index.cameras.size()), lights = std::int64_t(index.lights.size());
    cameras.wavelengths = spectra.take("wavelengths", { kPackWavelengths }, 0);
    cameras.sensitivities = spectra.take("sensitivities", { count, 3, kPackWavelengths }, 0);
    cameras.lights = spectra.take("lights", { lights, kPackWavelengths }, 0);
    cameras.reflectance = spectra.take("reflectance", { 3, kPackWavelengths }, -HUGE_VALF);
    for (std::size_t i = 0; i < cameras.wavelengths.size(); ++i)
        if (cameras.wavelengths[i] != kFirstWavelength_nm + float(i) * kWavelengthStep_nm)
            spectra.fail("wavelengths must be 380, 385, ... 780 nm; element " + std::to_string(i) + " is " +
                         std::to_string(cameras.wavelengths[i]));
    for (const PackSpectrum& camera : index.cameras) {
        cameras.names.push_back(camera.name);
        cameras.validation.push_back(camera.validation);
    }
    for (const PackSpectrum& light : index.lights) {
        cameras.light_names.push_back(light.name);
        cameras.light_kinds.push_back(light.kind);
    }
    return spectra.finish();
}

} // namespace

struct TrainingPack::State {
    MappedFile photos_file, raws_file;
    PackedImages photos, raws;
    PackedCameras cameras;
    std::string hash;
};

TrainingPack::TrainingPack(std::unique_ptr<const State> state) : m_state(std::move(state)) {}
TrainingPack::~TrainingPack() = default;

Expected<std::shared_ptr<const TrainingPack>> TrainingPack::open(const std::string& folder)
{
    const std::string where = "pack '" + folder + "'", index_path = folder + "/" + kPackIndexName;
    std::error_code ignored;
    if (!std::filesystem::is_directory(folder, ignored))
        return Error{ where + (std::filesystem::exists(folder, ignored) ? " is not a folder" : " does not exist") };
    if (!std::filesystem::exists(index_path, ignored))
        return Error{ where + " is not a training pack: it has no " + kPackIndexName };
    const Expected<std::string> text = read_file(index_path, kMaxIndexBytes, where);
    if (!text)
        return text.error();
    const Expected<PackIndex> index = parse_pack_index(*text, where);
    if (!index)
        return index.error();

    auto state = std::make_unique<State>();
    state->hash = xxh64_of_bytes(text->data(), text->size());
    Status status;
    if (index->photos)
        status = open_images(folder, *index->photos, state->photos_file, state->photos, where);
    if (status && index->raws)
        status = open_images(folder, *index->raws, state->raws_file, state->raws, where);
    if (status && index->cameras)
        status = open_cameras(folder, *index->cameras, state->cameras, where);
    if (!status)
        return status.error();
    return std::shared_ptr<const TrainingPack>(new TrainingPack(std::move(state)));
}

const PackedImages& TrainingPack::photos() const
{
    return m_state->photos;
}
const PackedImages& TrainingPack::raws() const
{
    return m_state->raws;
}
const PackedCameras& TrainingPack::cameras() const
{
    return m_state->cameras;
}
const std::string& TrainingPack::hash() const
{
    return m_state->hash;
}

} // namespace srisp
