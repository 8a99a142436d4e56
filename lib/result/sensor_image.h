// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <srisp/mosaic.h>
#include <srisp/noise.h>

#include "record/record.h"
#include "result/computed_image.h"

namespace srisp {

/// A RAW-like image as a sensor would give it: through its colour filters (Recipe::mosaic), with its noise
/// (Recipe::noise), both or one of them. A mosaic has one channel; noise of three channels is each channel's own. With
/// noise nothing is above 1, where a sensor is full; values below 0 stay. Pixels depend on their place in the image
/// (not in the data window), the seed, and the photo's name alone.
class SensorImage final : public ComputedImage {
public:
    /// `name`: of the image in messages.
    static Expected<std::unique_ptr<SensorImage>> open(const Recipe& recipe, const std::string& name,
                                                       std::unique_ptr<ComputedImage> image, KeptResults& kept);

    bool is_lazy() const override { return m_image->is_lazy(); }
    Expected<const OIIO::ImageSpec*> header(int subimage, int miplevel) override;
    Expected<const OIIO::ImageSpec*> full_spec(int subimage, int miplevel, int threads) override;
    Status read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                std::size_t row_stride) override;

private:
    /// One level of the image.
    struct Level {
        OIIO::ImageSpec spec;
        int channels = 0;  ///< of the image that the sensor sees
        bool full = false; ///< what follows, and all of `spec`, is known
        BayerPhase phase = BayerPhase::rggb;
        std::optional<NoiseModel> noise;
        std::uint64_t seed = 0;
        SensorValues before, after;
    };

    SensorImage(const Recipe& recipe, const std::string& name, std::unique_ptr<ComputedImage> image, KeptResults& kept);

    struct Piece;

    Expected<Level> first_look(const OIIO::ImageSpec& spec) const;
    Status look(Level& level, int subimage) const;
    Status choose_phase(Level& level, const CameraFacts& sensor, std::vector<std::string>& notes) const;
    void choose_levels(Level& level, const CameraFacts& sensor, std::vector<std::string>& notes) const;
    Status finish(const Level& level, const Piece& piece, int threads) const;
    Error error(const std::string& message) const { return { m_name + ": " + message }; }

    Recipe m_recipe;
    std::string m_name, m_photo; ///< the second one is the photo's base name
    std::unique_ptr<ComputedImage> m_image;
    KeptResults& m_kept;
    std::map<std::pair<int, int>, Level> m_levels;
};

} // namespace srisp
