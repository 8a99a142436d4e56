// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/apply.h>
#include <srisp/camera.h>
#include <srisp/develop.h>
#include <srisp/expected.h>
#include <srisp/export.h>
#include <srisp/image.h>
#include <srisp/image_input.h>
#include <srisp/metadata.h>
#include <srisp/metrics.h>
#include <srisp/model.h>
#include <srisp/neutral_rendition.h>
#include <srisp/options.h>
#include <srisp/parameters.h>
#include <srisp/photo.h>
#include <srisp/reference.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

// The front door: from files to pixels in one call. Nothing throws; any number of threads may call.

namespace srisp {

/// An image that owns its pixels: float32, all channels of a pixel adjacent, rows from top to bottom.
class SRISP_API Image {
public:
    Image(OIIO::ImageSpec spec, std::vector<float> pixels) : m_spec(std::move(spec)), m_pixels(std::move(pixels)) {}

    /// Size, names of channels, and what the image says of itself (metadata.h).
    const OIIO::ImageSpec& spec() const { return m_spec; }
    /// spec().width × spec().height × spec().nchannels values.
    const std::vector<float>& pixels() const { return m_pixels; }
    /// The first three channels: R, G, B.
    ImageView view() const
    {
        return { m_pixels.data(), m_spec.width, m_spec.height, m_spec.nchannels,
                 std::ptrdiff_t(m_spec.width) * m_spec.nchannels };
    }

    /// Writes a file of the kind that its name ends in, with all metadata that it can hold: OpenEXR in half, TIFF, FITS
    /// and Radiance in float, others in 16 bits, or in 8 where they have no more. It appears under its name only when
    /// it is complete. Errors start with "image 'path' cannot be written: ".
    /// `type`: how values are stored instead; a writer takes the nearest that it has.
    Status save(const std::string& path, OIIO::TypeDesc type = OIIO::TypeUnknown) const;

    /// The bytes of the file that `save` would write under such a name. `compression`: as the writer calls it; empty:
    /// its usual one. Errors start with "image 'name' cannot be written: ".
    Expected<std::vector<unsigned char>> encode(const std::string& name, OIIO::TypeDesc type = OIIO::TypeUnknown,
                                                const std::string& compression = {}) const;

private:
    OIIO::ImageSpec m_spec;
    std::vector<float> m_pixels;
};

/// Takes an image as it is computed: first what it says of itself, then its rows from top to bottom, some megabytes at
/// a time, all channels of a pixel adjacent. An error of theirs ends it.
struct ImageSink {
    std::function<Status(const OIIO::ImageSpec& spec)> begin;
    std::function<Status(const float* rows, int count)> rows;
    /// What takes the rows keeps them all in memory: an error where that is more than one image may take
    /// (SRISP_MAX_MEMORY).
    bool holds_all = false;
    std::function<bool()> cancelled{}; ///< asked now and then by the calling thread; true ends it with an error
};

/// A reference to select by: a path that load_reference takes, or a folder or glob, of which one file is taken by
/// `Options::seed`; or one that is loaded. Empty where `Options::parameters` are given.
struct ReferenceInput {
    ReferenceInput(const char* reference_path) : path(reference_path) {}
    ReferenceInput(std::string reference_path) : path(std::move(reference_path)) {}
    ReferenceInput(std::shared_ptr<const Reference> reference) : loaded(std::move(reference)) {}

    std::string path;
    std::shared_ptr<const Reference> loaded;
};

/// What the camera of the reference would have recorded of the photo's scene, in the reference's light: linear camera
/// RGB in [0,1]. Photo: any image that OpenImageIO reads (its first subimage), or one in memory; alpha and further
/// channels are kept. Errors: missing or damaged files, a model that is not there, an image that is RAW-like already.
SRISP_API Expected<Image> unprocess(const ImageInput& photo, const ReferenceInput& reference,
                                    const Options& options = {});

/// A RAW-like image, or one that was developed → a display-encoded photo, by the parameters that the image records or
/// `options` give.
SRISP_API Expected<Image> process(const ImageInput& raw, const Options& options = {});

/// A RAW-like image of ours, or a camera's RAW file (LibRaw demosaics it) → scene-linear colour, in the space that
/// `options.develop` names, else ACEScg. unprocess() with options.develop does both at once. Errors: as there, and
/// those of choose_development.
SRISP_API Expected<Image> develop(const ImageInput& raw, const Options& options = {});

/// A RAW-like image as a sensor gives it: its `options.mosaic`, with `options.noise`, or one of both. unprocess() with
/// these options does all at once. Errors: neither of them asked for, a picture that is no RAW-like image, a mosaic of
/// a mosaic, figures of noise that cannot be had.
SRISP_API Expected<Image> sense(const ImageInput& raw, const Options& options);

/// A photo as the model sees it: display-encoded sRGB in [0,1], whatever colours the file has; colour straight, alpha
/// and further channels behind it; as stored (`Orientation` says how it is turned).
SRISP_API Expected<Image> read_photo(const ImageInput& photo, const Options& options = {});

/// The same for images that need not be in memory as a whole.
SRISP_API Status unprocess(const ImageInput& photo, const ReferenceInput& reference, const Options& options,
                           const ImageSink& sink);
SRISP_API Status process(const ImageInput& raw, const Options& options, const ImageSink& sink);
SRISP_API Status develop(const ImageInput& raw, const Options& options, const ImageSink& sink);
SRISP_API Status sense(const ImageInput& raw, const Options& options, const ImageSink& sink);
SRISP_API Status read_photo(const ImageInput& photo, const Options& options, const ImageSink& sink);

} // namespace srisp
