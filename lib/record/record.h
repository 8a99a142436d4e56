// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/camera.h>
#include <srisp/options.h>

#include "base/scene_linear_space.h"

// All that a result says of itself, each thing by its one name here: a line in its ImageDescription, and attributes.

namespace srisp {

/// The attributes of a result; those of the camera are in write_camera.
namespace attribute {
constexpr char kPrefix[] = "unprocess:";
constexpr char kRecord[] = "unprocess:record"; ///< the line of format_record
constexpr char kColorSpace[] = "unprocess:colorspace";
constexpr char kSynthetic[] = "unprocess:synthetic"; ///< synthetic_mark
constexpr char kModel[] = "unprocess:model";
constexpr char kModelHash[] = "unprocess:model_hash";
constexpr char kReference[] = "unprocess:reference";
constexpr char kReferenceHash[] = "unprocess:reference_hash";
constexpr char kNeutral[] = "unprocess:neutral";            ///< camera RGB of what is neutral in the result, G = 1
constexpr char kNotes[] = "unprocess:notes";                ///< what was ignored or assumed
constexpr char kCfaPattern[] = "unprocess:cfa_pattern";     ///< of a mosaic, from pixel (0, 0) on: "RGGB", …
constexpr char kBlackLevel[] = "unprocess:black_level";     ///< of R, first G, B, second G in its values; absent: 0
constexpr char kWhiteLevel[] = "unprocess:white_level";     ///< in its values; absent: 1
constexpr char kNoiseProfile[] = "unprocess:noise_profile"; ///< shot and read noise that was added to R, G, B
} // namespace attribute

/// The line in a result's ImageDescription.
struct RecordLine {
    Direction direction = Direction::reverse;
    std::string parameters;    ///< JSON object as srisp::to_json writes; empty: not known yet
    std::string description;   ///< the source's own ImageDescription
    std::string sensor;        ///< JSON object of SensorValues; empty: there are none
    std::string development{}; ///< JSON object of what made scene-linear colour of camera RGB; empty: it is camera RGB
};

/// How the values of a result follow a sensor: as attributes, and in the line, which TIFF and PNG keep, too.
struct SensorValues {
    /// Of a mosaic: the filters over pixel (0, 0), its right neighbour and the two below, "RGGB", …; else empty. The
    /// data window may begin elsewhere, so that a crop keeps the phase.
    std::string cfa_pattern;
    std::array<float, 4> black_level{}; ///< R, first G, B, second G
    float white_level = 1;
    std::vector<double> noise_profile; ///< shot and read noise that was added to R, G, B; empty: none

    /// Levels as codes of 16 bits: whole ones are whole, though a float holds a part of 65535 with an error.
    float black_code(std::size_t which) const { return code_of(black_level[which]); }
    float white_code() const { return code_of(white_level); }
    static float code_of(float part);

    bool has_levels() const { return black_level != std::array<float, 4>{} || white_level != 1; }
};

/// Takes the place of what an image says of it so far; the rest of its record stays.
void record_sensor_values(OIIO::ImageSpec& spec, const SensorValues& values);
/// An image of more than one channel has no filters and levels.
SensorValues recorded_sensor_values(const OIIO::ImageSpec& spec);

/// Says of a RAW-like or camera RGB image that its values are scene-linear colour now. `development`: what made it so,
/// a JSON object for the record, where there is one.
void record_development(OIIO::ImageSpec& spec, const SceneLinearSpace& space, const std::string& development);
/// The same as recorded; empty: the image is not developed, or not by us.
std::string recorded_development(const OIIO::ImageSpec& spec);
/// The space of such an image; empty: not known. (Of "oiio:ColorSpace" readers have ideas of their own.)
std::string recorded_space(const OIIO::ImageSpec& spec);

/// Adds a command to the image's history, once: a command line may hold several of our commands. Of absolute paths in
/// it the last names.
void append_history(OIIO::ImageSpec& spec, const std::string& typed);

/// Adds to what the image says was ignored or assumed; of absolute paths the last names.
void append_notes(OIIO::ImageSpec& spec, const std::vector<std::string>& notes);

/// The plain mark that an image is synthetic.
const char* synthetic_mark(Direction direction);

/// One line of JSON, ASCII.
std::string format_record(const RecordLine& record);

/// Finds such a line in a text that may hold more (programs append checksums). None: there is none, or it is damaged.
std::optional<RecordLine> find_record(const std::string& text);

/// The record in an image; ImageDescription is what most formats keep.
std::optional<RecordLine> read_record(const OIIO::ImageSpec& spec);
void write_record(OIIO::ImageSpec& spec, const RecordLine& record);

/// Writes the known facts of the reference's camera.
void write_camera(OIIO::ImageSpec& spec, const CameraFacts& facts);

/// The camera that a result imitates, as far as it holds for the result's own pixels, too; empty for other images.
CameraFacts recorded_camera(const OIIO::ImageSpec& spec);

/// The same with the reference's filters, levels and noise, which a file for RAW programs should have, too.
CameraFacts recorded_sensor(const OIIO::ImageSpec& spec);

/// Camera RGB of what was neutral in the reference's light; 0: not known.
std::array<float, 3> recorded_reference_neutral(const OIIO::ImageSpec& spec);

} // namespace srisp
