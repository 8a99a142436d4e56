// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/options.h>
#include <srisp/parameters.h>

namespace srisp {

class Model;
struct ReferenceFeatures;

/// What selection needs of a reference alone, for one model. A value that any number of threads may share.
class SRISP_API PreparedReference {
public:
    const ReferenceFeatures& features() const { return *m_features; } ///< for the rooms of this library

private:
    friend SRISP_API Expected<PreparedReference> prepare_reference(const Model& model, const Thumbnail& reference);
    explicit PreparedReference(std::shared_ptr<const ReferenceFeatures> features) : m_features(std::move(features)) {}

    std::shared_ptr<const ReferenceFeatures> m_features;
};

/// About half of what `select` has to do. `reference`: linear RAW, upright, values in [0,1]; NaN is an error.
SRISP_API Expected<PreparedReference> prepare_reference(const Model& model, const Thumbnail& reference);

/// Chooses the parameters that turn the photo into what the camera of the reference would have recorded in its light.
/// `source`: display-encoded photo, upright, values in [0,1]; NaN is an error, and so is a reference that was prepared
/// for another model. Sets all but `reference_name` and `reference_hash`. Gain and white balance stay within what
/// training showed the model; where they had to be moved, a sentence on it is added to `notes`, as on a brightness that
/// is unsure. Same bits for the same input on one machine. [P 3.1]
SRISP_API Expected<Parameters> select(const Model& model, const Thumbnail& source, const PreparedReference& reference,
                                      std::vector<std::string>* notes = nullptr);

/// The same with a reference that is not prepared.
SRISP_API Expected<Parameters> select(const Model& model, const Thumbnail& source, const Thumbnail& reference,
                                      std::vector<std::string>* notes = nullptr);

/// Makes the result of the parameters brighter: divides their gain by 2^EV, and records that in `brightness_ev`. A
/// sample depends on the seed, the photo's name and the parameters' brightness_sd_ev alone; a sentence on it is added
/// to `notes`. Errors: a sample where there is no brightness_sd_ev, a gain that becomes 0 or infinite.
SRISP_API Status choose_brightness(Parameters& parameters, const Brightness& brightness, std::uint64_t seed,
                                   const std::string& photo_name, std::vector<std::string>* notes = nullptr);

/// A sentence on how unsure the brightness is and how to correct it, where its standard deviation is above 0.7 EV; else
/// empty. `select` adds it to its notes.
SRISP_API std::string brightness_note(const Parameters& parameters);

} // namespace srisp
