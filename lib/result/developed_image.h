// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>

#include <srisp/develop.h>

#include "result/computed_image.h"

namespace srisp {

class KeptResults;

/// A RAW-like image, or a camera's, in a scene-linear colour space (Recipe::develop).
class DevelopedImage final : public ComputedImage {
public:
    /// `name`: of the image in messages.
    static Expected<std::unique_ptr<DevelopedImage>> open(const Recipe& recipe, const std::string& name,
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
        int alpha = -1;    ///< channel that colour is multiplied with; −1: there is none
        bool full = false; ///< `development`, and all of `spec`, is known
        Development development;
    };

    DevelopedImage(const Recipe& recipe, const std::string& name, std::unique_ptr<ComputedImage> image,
                   KeptResults& kept)
        : m_recipe(recipe), m_name(name), m_image(std::move(image)), m_kept(kept)
    {
    }

    Expected<Level> first_look(const OIIO::ImageSpec& spec) const;
    Status choose(Level& level) const;
    Error error(const std::string& message) const { return { m_name + ": " + message }; }

    Recipe m_recipe;
    std::string m_name;
    std::unique_ptr<ComputedImage> m_image;
    KeptResults& m_kept;
    std::map<std::pair<int, int>, Level> m_levels;
};

} // namespace srisp
