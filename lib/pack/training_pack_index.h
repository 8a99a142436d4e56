// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>
#include <srisp/expected.h>

#include "pack/training_pack.h"

namespace srisp {

/// What pack.json holds: all of a pack but the numbers.
constexpr char kPackFormat[] = "srisp-pack-1";
constexpr char kPackIndexName[] = "pack.json";
constexpr std::uint64_t kMaxIndexBytes = std::uint64_t(1) << 30; // some four million images

/// One file of the pack.
struct PackFile {
    std::string name;
    std::uint64_t bytes = 0;
    std::string hash; ///< xxh64_of_bytes
};

/// One photo or RAW image: what its crops have in common, and the crops, the whole image first.
struct PackScene {
    PackEntry common; ///< `scene` and `crop` are not used
    std::vector<std::array<float, 4>> crops;
};

struct PackImagesIndex {
    PackFile file;
    int size = 0;
    std::vector<PackScene> scenes;
};

/// A camera or a light.
struct PackSpectrum {
    std::string name;
    std::string kind; ///< of a light
    std::string source, licence;
    bool validation = false; ///< of a camera
};

struct PackCamerasIndex {
    PackFile file;
    std::vector<PackSpectrum> cameras, lights;
};

struct PackIndex {
    std::string made_by;
    nlohmann::json settings = nlohmann::json::object(); ///< of the program that made it, for the record
    std::optional<PackImagesIndex> photos, raws;
    std::optional<PackCamerasIndex> cameras;
};

/// One light kind for each: daylight, tungsten, fluorescent, led.
const std::vector<std::string>& pack_light_kinds();

/// The text of pack.json. Texts that are no UTF-8 (file names) get replacement characters.
std::string format_pack_index(const PackIndex& index);

/// Reads it back. `where` starts every message. Errors: no JSON, another format or version, missing or unknown keys,
/// values out of their range, file names with a folder in them.
Expected<PackIndex> parse_pack_index(const std::string& text, const std::string& where);

/// Images as the reader shows them: one entry per crop.
std::vector<PackEntry> pack_entries(const PackImagesIndex& index);

} // namespace srisp
