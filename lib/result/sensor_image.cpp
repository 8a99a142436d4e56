// SPDX-License-Identifier: Apache-2.0
#include "result/sensor_image.h"

#include <algorithm>
#include <cmath>

#include <OpenImageIO/strutil.h>

#include "base/hashes.h"
#include "base/parallel.h"
#include "photo/color_channels.h"
#include "recipe/noise_source.h"
#include "result/noise_choice.h"

namespace srisp {

namespace {

constexpr float kMostCode = 65535;
// Of a camera that is not known: enough room below black for any noise.
constexpr float kNeutralBlack = 2048, kNeutralWhite = kMostCode;

OIIO::ImageSpec one_channel(OIIO::ImageSpec spec)
{
    spec.nchannels = 1;
    spec.channelnames = { "Y" };
    spec.alpha_channel = spec.z_channel = -1;
    spec.erase_attribute("oiio:UnassociatedAlpha");
    return spec;
}

/// A whole code, as a part of the range of 16 bits.
float to_code(float value, float black_code, float white_code)
{
    const float code = std::clamp(black_code + value * (white_code - black_code), 0.0f, white_code);
    return std::round(code) / kMostCode;
}

} // namespace

/// Pixels that are being made: colour is in the first channel, or in the first three.
struct SensorImage::Piece {
    MosaicPlace place;
    int width, height, channels;
    float* out;
    std::size_t row_stride;
};

namespace {

/// Gives each colour value, with the number of its black level, to `change`.
template<class Piece, class Change> void each_value(const Piece& piece, int threads, const Change& change)
{
    constexpr int kRows = 32; // of a task
    const int colors = std::min(piece.channels, 3);
    parallel_tasks((piece.height + kRows - 1) / kRows, threads, [&](std::int64_t task) {
        const int last = std::min((int(task) + 1) * kRows, piece.height);
        for (int y = int(task) * kRows; y < last; ++y) {
            float* const row = piece.out + piece.row_stride * std::size_t(y);
            // Of a mosaic, two kinds of columns.
            const std::size_t black[2] = { bayer_level(piece.place.phase, piece.place.x, piece.place.y + y),
                                           bayer_level(piece.place.phase, piece.place.x + 1, piece.place.y + y) };
            for (int x = 0; x < piece.width; ++x)
                for (int c = 0; c < colors; ++c) {
                    float& value = row[std::ptrdiff_t(x) * piece.channels + c];
                    value = change(value, black[x & 1]);
                }
        }
    });
}

} // namespace

Expected<std::unique_ptr<SensorImage>> SensorImage::open(const Recipe& recipe, const std::string& name,
                                                         std::unique_ptr<ComputedImage> image, KeptResults& kept)
{
    auto sensor = std::unique_ptr<SensorImage>(new SensorImage(recipe, name, std::move(image), kept));
    if (!recipe.noise.empty())
        if (const auto source = parse_noise_source(recipe.noise); !source)
            return sensor->error(source.error().message);
    const auto first = sensor->header(0, 0);
    if (!first)
        return first.error();
    return sensor;
}

SensorImage::SensorImage(const Recipe& recipe, const std::string& name, std::unique_ptr<ComputedImage> image,
                         KeptResults& kept)
    : m_recipe(recipe), m_name(name), m_photo(recipe.photo_name()), m_image(std::move(image)), m_kept(kept)
{
}

Expected<SensorImage::Level> SensorImage::first_look(const OIIO::ImageSpec& spec) const
{
    Level level;
    level.spec = spec;
    level.channels = spec.nchannels;
    level.before = recorded_sensor_values(spec);
    const auto record = read_record(spec);
    if (record && record->direction == Direction::forward)
        return error("is a processed picture; a sensor sees RAW-like images");
    if (record && !record->development.empty())
        return error("is developed; a sensor sees RAW-like images");
    const bool is_mosaic = !level.before.cfa_pattern.empty();
    if (is_mosaic && m_recipe.mosaic)
        return error("is a mosaic already");
    if (!m_recipe.noise.empty() && !level.before.noise_profile.empty())
        return error("has noise already");
    if (!is_mosaic) {
        const auto channels = find_color_channels(spec, m_name);
        if (!channels)
            return channels.error();
        if (channels->color != std::vector<int>{ 0, 1, 2 })
            return error("has " + std::to_string(spec.nchannels) + " channel" + (spec.nchannels == 1 ? "" : "s") +
                         "; a sensor sees images whose first three are R, G, B");
    }
    if (!(level.before.white_level >
          *std::max_element(level.before.black_level.begin(), level.before.black_level.end())))
        return error("its black level is not below its white level");
    if (m_recipe.mosaic)
        level.spec = one_channel(level.spec);
    return level;
}

Expected<const OIIO::ImageSpec*> SensorImage::header(int subimage, int miplevel)
{
    const auto key = std::make_pair(subimage, miplevel);
    auto found = m_levels.find(key);
    if (found == m_levels.end()) {
        const auto spec = m_image->header(subimage, miplevel);
        if (!spec || !*spec)
            return spec;
        auto level = first_look(**spec);
        if (!level)
            return level.error();
        found = m_levels.emplace(key, std::move(*level)).first;
    }
    return static_cast<const OIIO::ImageSpec*>(&found->second.spec);
}

Expected<const OIIO::ImageSpec*> SensorImage::full_spec(int subimage, int miplevel, int threads)
{
    const auto known = m_levels.find({ subimage, miplevel });
    if (known != m_levels.end() && known->second.full)
        return static_cast<const OIIO::ImageSpec*>(&known->second.spec);
    const auto spec = m_image->full_spec(subimage, miplevel, threads);
    if (!spec || !*spec)
        return spec;
    auto level = first_look(**spec);
    if (!level)
        return level.error();
    if (const Status looked = look(*level, subimage); !looked)
        return looked.error();
    return static_cast<const OIIO::ImageSpec*>(&(m_levels[{ subimage, miplevel }] = std::move(*level)).spec);
}

/// What full_spec needs the reference for.
Status SensorImage::look(Level& level, int subimage) const
{
    const CameraFacts sensor = recorded_sensor(level.spec);
    std::vector<std::string> notes;
    if (const Status chosen = choose_phase(level, sensor, notes); !chosen)
        return chosen;
    level.seed = seeded_hash(m_recipe.noise_seed, m_photo + (subimage ? "#" + std::to_string(subimage) : ""));
    level.after = level.before;
    if (m_recipe.mosaic)
        level.after.cfa_pattern = bayer_phase_text(level.phase);
    if (!m_recipe.noise.empty()) {
        const auto noise = choose_noise(m_recipe, sensor, m_photo, level.seed, m_kept);
        if (!noise)
            return error(noise.error().message);
        level.noise = *noise;
        for (std::size_t c = 0; c < 3; ++c) {
            level.after.noise_profile.push_back(noise->shot[c]);
            level.after.noise_profile.push_back(noise->read[c]);
        }
    }
    choose_levels(level, sensor, notes);
    record_sensor_values(level.spec, level.after);
    append_history(level.spec, m_recipe.command);
    append_notes(level.spec, notes);
    if (m_recipe.notes)
        m_kept.print_notes(m_name, notes);
    level.full = true;
    return {};
}

Status SensorImage::choose_phase(Level& level, const CameraFacts& sensor, std::vector<std::string>& notes) const
{
    std::string pattern = level.before.cfa_pattern;
    std::string hint;
    if (m_recipe.mosaic == Mosaic::reference) {
        pattern = sensor.cfa_pattern;
        hint = "; phase=RGGB names one";
        if (pattern.empty()) {
            notes.push_back("the phase of the reference's filters is not known, so the mosaic has RGGB");
            pattern = "RGGB";
        }
    } else if (m_recipe.mosaic) {
        pattern = bayer_phase_text(BayerPhase(int(*m_recipe.mosaic) - int(Mosaic::rggb)));
    } else if (pattern.empty()) {
        return {};
    }
    const auto phase = parse_bayer_phase(pattern);
    if (!phase)
        return error(phase.error().message + hint);
    level.phase = *phase;
    return {};
}

void SensorImage::choose_levels(Level& level, const CameraFacts& sensor, std::vector<std::string>& notes) const
{
    CameraFacts levels;
    levels.black_level = sensor.black_level;
    levels.white_level = sensor.white_level;
    const bool as_codes = m_recipe.mosaic && m_recipe.levels == Levels::camera;
    if (!sensor.has_integer_levels() && (as_codes || level.noise)) {
        levels.black_level.fill(kNeutralBlack);
        levels.white_level = kNeutralWhite;
        write_camera(level.spec, levels);
        notes.push_back("the reference's levels are not known, so black is 2048 and white 65535");
    }
    if (!as_codes)
        return;
    for (std::size_t c = 0; c < 4; ++c)
        level.after.black_level[c] = levels.black_level[c] / kMostCode;
    level.after.white_level = levels.white_level / kMostCode;
}

Status SensorImage::read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                         std::size_t row_stride)
{
    if (const auto spec = full_spec(subimage, miplevel, threads); !spec)
        return spec.error();
    const Level& level = m_levels.at({ subimage, miplevel });
    const int width = x1 - x0, height = y1 - y0;
    const MosaicPlace place{ level.phase, level.spec.x + x0, level.spec.y + y0 };
    const Piece piece{ place, width, height, level.spec.nchannels, out, row_stride };
    if (!m_recipe.mosaic) {
        const Status read = m_image->read(subimage, miplevel, threads, x0, x1, y0, y1, out, row_stride);
        return read ? finish(level, piece, threads) : read;
    }
    const std::size_t seen_row = std::size_t(width) * std::size_t(level.channels);
    std::vector<float> seen(seen_row * std::size_t(height));
    if (const Status read = m_image->read(subimage, miplevel, threads, x0, x1, y0, y1, seen.data(), seen_row); !read)
        return read;
    const ImageView image{ seen.data(), width, height, level.channels, std::ptrdiff_t(seen_row) };
    const Status made = make_mosaic(image, place, { out, width, height, 1, std::ptrdiff_t(row_stride) }, threads);
    return made ? finish(level, piece, threads) : error(made.error().message);
}

/// Noise and levels, in place.
Status SensorImage::finish(const Level& level, const Piece& piece, int threads) const
{
    const bool mosaic = piece.channels == 1;
    if (const SensorValues& stored = level.before; stored.has_levels())
        each_value(piece, threads, [&](float value, std::size_t which) {
            return (value - stored.black_level[which]) / (stored.white_level - stored.black_level[which]);
        });
    if (level.noise) {
        for (int c = 0; c < (mosaic ? 1 : 3); ++c) {
            NoiseModel noise = *level.noise;
            if (!mosaic) { // each channel as a plane of one colour
                noise.shot.fill(level.noise->shot[std::size_t(c)]);
                noise.read.fill(level.noise->read[std::size_t(c)]);
            }
            const MutablePlaneView plane{ piece.out + c, piece.width, piece.height, piece.channels,
                                          std::ptrdiff_t(piece.row_stride) };
            const std::uint64_t seed = mosaic ? level.seed : seeded_hash(level.seed, std::to_string(c));
            if (const Status added = add_noise(plane, piece.place, noise, seed, threads); !added)
                return error(added.error().message);
        }
        each_value(piece, threads, [](float value, std::size_t) { return std::min(value, 1.0f); });
    }
    if (level.after.has_levels()) {
        std::array<float, 4> black;
        for (std::size_t which = 0; which < black.size(); ++which)
            black[which] = level.after.black_code(which);
        const float white = level.after.white_code();
        each_value(piece, threads, [&](float value, std::size_t which) { return to_code(value, black[which], white); });
    }
    return {};
}

} // namespace srisp
