// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/camera.h>
#include <srisp/options.h>

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
constexpr char kCfaPattern[] = "unprocess:cfa_pattern";     ///< of a mosaic, from its first pixel: "RGGB", …
constexpr char kBlackLevel[] = "unprocess:black_level";     ///< of R, first G, B, second G in its values; absent: 0
constexpr char kWhiteLevel[] = "unprocess:white_level";     ///< in its values; absent: 1
constexpr char kNoiseProfile[] = "unprocess:noise_profile"; ///< shot and read noise that was added to R, G, B
} // namespace attribute

/// The line in a result's ImageDescription.
struct RecordLine {
    Direction direction = Direction::reverse;
    std::string parameters;  ///< JSON object as srisp::to_json writes; empty: not known yet
    std::string description; ///< the source's own ImageDescription
};

/// The plain mark that an image is synthetic.
const char* synthetic_mark(Direction direction);

/// One line of JSON, ASCII.
std::string format_record(const RecordLine& record);

/// Finds such a line in a text that may hold more (programs append checksums). None: there is none, or it is damaged.
std::optional<RecordLine> find_record(const std::string& text);

/// Writes the known facts of the reference's camera.
void write_camera(OIIO::ImageSpec& spec, const CameraFacts& facts);

/// The camera that a result imitates, as far as it holds for the result's own pixels, too; empty for other images.
CameraFacts recorded_camera(const OIIO::ImageSpec& spec);

/// The same with the reference's filters, levels and noise, which a file for RAW programs should have, too.
CameraFacts recorded_sensor(const OIIO::ImageSpec& spec);

} // namespace srisp
