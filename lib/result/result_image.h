// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "result/band_reader.h"
#include "result/chooser.h"
#include "result/computed_image.h"

namespace srisp {

/// What the method makes of a photo, or of a RAW-like image. Parameters are selected late (is_lazy) or with the spec.
class ResultImage final : public ComputedImage {
public:
    /// `kept` outlives the object. Reads headers only; finds what can be wrong without decoding the photo or the
    /// reference.
    static Expected<std::unique_ptr<ResultImage>> open(const Recipe& recipe, std::unique_ptr<PixelSource> source,
                                                       const OIIO::ImageSpec& config, KeptResults& kept);

    bool is_lazy() const override { return m_recipe.lazy; }
    /// All but the parameters where these must be selected first.
    Expected<const OIIO::ImageSpec*> header(int subimage, int miplevel) override;
    /// Decodes the photo if parameters must be selected (once per process and photo).
    Expected<const OIIO::ImageSpec*> full_spec(int subimage, int miplevel, int threads) override;
    Status read(int subimage, int miplevel, int threads, int x0, int x1, int y0, int y1, float* out,
                std::size_t row_stride) override;

    /// The parameters of one subimage.
    Expected<ChoicePtr> choice(int subimage, int threads);

private:
    /// One level of the source, and what is made of it.
    struct Level {
        OIIO::ImageSpec stored, result;
        std::shared_ptr<const PhotoConverter> converter;
        bool recorded = false;             ///< `result` holds the parameters
        std::shared_ptr<BandReader> bands; ///< null until pixels are read
    };

    ResultImage(const Recipe& recipe, std::unique_ptr<PixelSource> source, Chooser chooser, bool associate,
                KeptResults& kept)
        : m_recipe(recipe), m_source(std::move(source)), m_chooser(std::move(chooser)), m_associate(associate),
          m_kept(kept)
    {
    }

    Expected<Level*> level(int subimage, int miplevel);
    Expected<Level*> existing_level(int subimage, int miplevel);
    void record(Level& level, const Choice& choice) const;
    void mark_straight(Level& level) const;
    void drop_idle_readers();
    Expected<std::shared_ptr<BandReader>> band_reader(int subimage, int miplevel, int threads);
    void tell(const Level& level, const std::vector<std::string>& notes) const;

    Recipe m_recipe;
    std::unique_ptr<PixelSource> m_source;
    Chooser m_chooser;
    bool m_associate;
    KeptResults& m_kept;
    std::map<std::pair<int, int>, Level> m_levels;
    std::map<int, std::shared_ptr<const Applier>> m_appliers; ///< by subimage
};

} // namespace srisp
