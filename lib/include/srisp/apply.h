// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
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

struct ApplyOptions {
    int threads = 0; ///< 0: all of OpenImageIO's threads; 1: the calling thread only
    /// Called from the calling thread with the part done (0 … 1); returning false cancels.
    std::function<bool(float)> progress;
};

/// The part of an image that is in memory.
struct ImagePart {
    ImageView pixels;
    int x, y;                    ///< where its pixel (0, 0) lies in the whole
    int full_width, full_height; ///< of the whole, pixels
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

    /// Computes the region `roi` of the whole image. `source` must hold it and the halo around it as far as the whole
    /// image goes. `target` is the image of `roi` alone. Values in [0,1] out, whatever comes in: what is outside
    /// counts as 0 or 1, NaN as 0. `target` may be the memory of `source`. Same bits for any number of threads, any
    /// tiling and any region. Errors: sizes that do not fit; cancelled.
    Status run(const ImagePart& source, Roi roi, MutableImageView target, const ApplyOptions& options = {}) const;

    /// The whole image; `target` may be `source`.
    Status run(ImageView source, MutableImageView target, const ApplyOptions& options = {}) const;

private:
    struct State;
    explicit Applier(std::unique_ptr<const State> state);
    std::unique_ptr<const State> m_state;
};

/// v + φ(v) of single colours, **not** clamped: for those who tabulate the tone map of a pointwise model. `rgb` and
/// `out`: `count` × 3 floats, display-encoded; they may be the same memory. Uses OpenImageIO's threads; any number of
/// threads may call it. Errors: a model whose tone map looks at neighbours (kernel size other than 1); parameters of
/// another model. [method 1]
SRISP_API Status tone_map_values(const Model& model, const Parameters& parameters, Direction direction,
                                 const float* rgb, std::int64_t count, float* out);

} // namespace srisp
