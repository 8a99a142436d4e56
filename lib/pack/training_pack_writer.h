// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "base/output_file.h"
#include "base/staged_folder.h"
#include "pack/training_pack_index.h"

namespace srisp {

/// Writes the images of one part of a pack as they come; memory holds none of them.
class PackImagesWriter {
public:
    /// `path`: of the safetensors file. `size`: of the images.
    PackImagesWriter(const std::string& path, int size);

    /// `pixels`: [crops, 3, size, size] of this scene. Errors: the disk's own.
    Status add(const PackScene& scene, const std::vector<std::uint16_t>& pixels);
    /// Call once, at the end. Errors: no images; the disk's own.
    Expected<PackImagesIndex> finish();

private:
    std::string m_path;
    OutputFile m_file;
    PackImagesIndex m_index;
    std::size_t m_images = 0;
};

/// Makes a training pack. It appears under its name when it is complete and has been read back; before, or after a
/// failure, nothing of it is left.
class TrainingPackWriter {
public:
    /// `replace`: a pack of this name may exist. Errors: see StagedFolder.
    static Expected<std::unique_ptr<TrainingPackWriter>> create(const std::string& folder, bool replace);

    /// Parts; each is made once, or left out.
    Status add_photos(PackImagesWriter& images);
    Status add_raws(PackImagesWriter& images);
    /// `cameras`: spectra in the order of `names`, whose file is filled in here.
    Status add_cameras(const PackedCameras& cameras, PackCamerasIndex names);
    /// Path for the writer of a part.
    std::string photos_path() const { return m_folder->path() + "/photos.safetensors"; }
    std::string raws_path() const { return m_folder->path() + "/raws.safetensors"; }

    /// Writes the index, reads all back, and gives the pack its name.
    Status finish(const std::string& made_by, const nlohmann::json& settings);

private:
    explicit TrainingPackWriter(std::unique_ptr<StagedFolder> folder) : m_folder(std::move(folder)) {}

    std::unique_ptr<StagedFolder> m_folder;
    PackIndex m_index;
};

} // namespace srisp
