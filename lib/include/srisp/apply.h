// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/options.h>
#include <srisp/parameters.h>

namespace srisp {

class Model;
struct Pipeline;

struct ApplyOptions {
    int threads = 0; ///< 0: all of OpenImageIO's threads; 1: the calling thread only
    /// Called from the calling thread with the part done (0 … 1); returning false cancels.
    std::function<bool(float)> progress;
};

/// Parameters made ready to run: tone kernels mixed and packed. Immutable; any number of threads may use one.
class SRISP_API Applier {
public:
    /// `parameters` must belong to `model` (check_parameters); C must not be singular.
    static Expected<std::shared_ptr<const Applier>> create(const Model& model, const Parameters& parameters,
                                                           Direction direction,
                                                           Precision precision = Precision::float32);
    ~Applier();

    /// Rows and columns of neighbours that a region of interest needs around it for exact results: 4 (spatial), 17
    /// (spatial, fast without bf16), 0 (pointwise).
    int halo() const;

    /// Computes `roi` of the image. `source` is any part of the whole image, which is `full_width` × `full_height`
    /// pixels; its pixel (0, 0) is (source_x, source_y) of the whole. It must hold `roi` and the halo around it as far
    /// as the whole image goes. `target` is the image of `roi` alone. Values in [0,1] in and out. `target` may be the
    /// memory of `source`. Same bits for any number of threads, any tiling and any region. Errors: sizes that do not
    /// fit; cancelled.
    Status run(ImageView source, int source_x, int source_y, int full_width, int full_height, Roi roi,
               MutableImageView target, const ApplyOptions& options = {}) const;

    /// The whole image; `target` may be `source`.
    Status run(ImageView source, MutableImageView target, const ApplyOptions& options = {}) const;

private:
    explicit Applier(std::unique_ptr<const Pipeline> pipeline);
    std::unique_ptr<const Pipeline> m_pipeline;
};

} // namespace srisp
