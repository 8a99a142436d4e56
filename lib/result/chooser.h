// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <srisp/model.h>
#include <srisp/parameters.h>
#include <srisp/reference.h>

#include "photo/photo_converter.h"
#include "photo/pixel_source.h"
#include "recipe/recipe.h"
#include "result/kept_results.h"

namespace srisp {

/// Parameters for one subimage, and where they come from.
struct Choice {
    std::shared_ptr<const Model> model;
    Parameters parameters;
    std::shared_ptr<const Reference> reference; ///< null where parameters were given without one
    std::vector<std::string> notes;             ///< about reference and pixels
};
using ChoicePtr = std::shared_ptr<const Choice>;

/// Finds the parameters that a recipe asks for. What was selected is kept (a bounded number; key: state of the photo
/// and the reference files, subimage, model's hash, settings), since hosts open a file several times.
class Chooser {
public:
    /// Finds what can be wrong without decoding anything: model, parameters, reference's path.
    static Expected<Chooser> create(const Recipe& recipe, KeptResults& kept);

    /// The parameters if they are known without decoding anything: given, held, selected before, or recorded in the
    /// image (forward). Null: they must be selected. `stored`: spec of MIP level 0.
    Expected<ChoicePtr> known(const PixelSource& source, int subimage, const OIIO::ImageSpec& stored) const;

    /// The same, selected from the pixels of MIP level 0 and the reference where they are not known.
    Expected<ChoicePtr> choose(PixelSource& source, int subimage, const OIIO::ImageSpec& stored,
                               const PhotoConverter& converter, int threads) const;

private:
    explicit Chooser(KeptResults& kept) : m_kept(&kept) {}
    /// The parameters of the recipe.
    Choice given() const;
    Expected<std::shared_ptr<const Reference>> reference() const;
    bool has_reference() const { return m_recipe.reference || !m_reference.empty(); }
    /// As bright as the recipe asks for; held from now on where it says so.
    Expected<ChoicePtr> finished(const PixelSource& source, int subimage, ChoicePtr choice) const;
    Expected<std::shared_ptr<const PreparedReference>> prepared(const Reference& reference) const;
    std::string key(const PixelSource& source, int subimage) const;
    Expected<ChoicePtr> select_new(PixelSource& source, int subimage, const OIIO::ImageSpec& stored,
                                   const PhotoConverter& converter, int threads) const;

    KeptResults* m_kept;
    Recipe m_recipe;
    std::shared_ptr<const Model> m_model; ///< null: the image's record says which (forward)
    std::string m_reference;              ///< path of the chosen file; empty: the recipe has it loaded, or has none
};

} // namespace srisp
