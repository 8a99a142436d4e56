// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <srisp/expected.h>

namespace srisp {

/// A training pack is a folder: `pack.json` (format "srisp-pack-1": what each image is, sizes and hashes of the other
/// files) beside `photos.safetensors`, `raws.safetensors` and `cameras.safetensors`. docs/training.md describes it;
/// `srisppack` makes it. A part that a pack was made without is empty.

/// Sensitivities and spectra in a pack are given at 380, 385, …, 780 nm.
constexpr int kPackWavelengths = 81;
constexpr float kFirstWavelength_nm = 380, kWavelengthStep_nm = 5;

/// Images in a pack are at least this wide and high: the encoders halve an image five times.
constexpr int kSmallestPackImage = 32;
constexpr int kLargestPackImage = 1024;

/// What is known of one image of a pack.
struct PackEntry {
    std::string name;        ///< of the file that it came from; in a set of several images also of the one in it
    std::string group;       ///< photos: the source set; raws: the camera
    std::string source;      ///< where it was published, as its manifest says; "not stated"
    std::string licence;     ///< likewise
    bool open = false;       ///< a model that is trained on it may be given away: `open` is yes in its manifest
    bool validation = false; ///< not for training
    int scene = 0;           ///< the index of the photo or RAW file; the same for all crops of it
    std::array<float, 4> crop{ 0, 0, 1, 1 }; ///< left, top, right, bottom in the upright file, 0 … 1
    std::array<float, 3> white_balance{};    ///< raws: gains (g_r, 1, g_b) that make a neutral surface grey; 0: unknown
    std::array<float, 9> color{}; ///< raws: white-balanced camera RGB → linear sRGB, rows sum to 1; 0: unknown
};

/// Images squashed to size × size by exact area averaging. [method: thumbnails]
struct PackedImages {
    int size = 0;
    std::vector<PackEntry> entries; ///< the crops of a scene follow each other, the whole image first
    /// Reads [3, size, size] values of an entry, value / 65535. Photos are display-encoded sRGB, raws linear camera
    /// RGB. Errors, as "pack 'folder': …": the disk's own; the file was made shorter. Threads: safe.
    std::function<Status(std::size_t entry, std::uint16_t* values)> read;

    /// The same, in memory of its own.
    Expected<std::vector<std::uint16_t>> image(std::size_t entry) const;
};

/// What cameras are simulated from. Spectra at kPackWavelengths wavelengths.
struct PackedCameras {
    std::vector<float> wavelengths;   ///< nm
    std::vector<std::string> names;   ///< of the cameras, sorted
    std::vector<bool> validation;     ///< not for training
    std::vector<float> sensitivities; ///< [cameras, 3, wavelengths], R, G, B; the largest of a camera is 1
    std::vector<std::string> light_names, light_kinds; ///< daylight, tungsten, fluorescent or led
    std::vector<float> lights; ///< [lights, wavelengths], relative; the mean weighted by the observer's ȳ is 1
    /// [3, wavelengths]: the reflectance that stands for one unit of linear sRGB R, G, B. It is a mix of the first
    /// three principal components of measured reflectances, and exact: under D65 the observer sees that colour.
    std::vector<float> reflectance;
};

/// A pack that is open for reading; images stay on disk until they are read. Threads: immutable, any number.
class TrainingPack {
public:
    /// Opens a pack and checks all of it: format, sizes and hashes of files, shapes, that numbers are finite. Errors
    /// start with "pack 'folder': ".
    static Expected<std::shared_ptr<const TrainingPack>> open(const std::string& folder);
    ~TrainingPack();
    TrainingPack(const TrainingPack&) = delete;
    TrainingPack& operator=(const TrainingPack&) = delete;

    const PackedImages& photos() const;
    const PackedImages& raws() const;
    const PackedCameras& cameras() const;
    /// pack.json's own hash, which covers the hashes of all files: "xxh64:…". It names the data in models.
    const std::string& hash() const;

private:
    struct State;
    explicit TrainingPack(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

} // namespace srisp
