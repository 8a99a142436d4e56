// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/photo.h>
#include <srisp/select.h>

#include "arrays.h"
#include "interruption.h"
#include "loaded_reference.h"

namespace srisp::python {

namespace {

py::array array_of(const Thumbnail& thumbnail)
{
    return py::array_t<float>({ kThumbnailSize, kThumbnailSize, 3 }, thumbnail.rgb.data());
}

/// The thumbnail of a photo: of a path, or of an array.
py::array photo_thumbnail(const py::object& image, const Metadata& metadata, const std::string& name,
                          const std::string& encoding, int threads)
{
    Options options;
    require(set_option(options, "input", encoding));
    options.threads = checked_threads(threads);
    const ImageInput input = input_of(image, metadata, name);
    Interruption interruption;
    Expected<Thumbnail> thumbnail = Error{};
    {
        const Unlocked unlocked;
        thumbnail = load_photo_thumbnail(input, options, [&] { return interruption.pending(); });
    }
    interruption.rethrow();
    return array_of(value_of(std::move(thumbnail)));
}

Thumbnail thumbnail_of(const py::array& array, const char* what)
{
    const ImageView view = view_of(array, what);
    if (view.width != kThumbnailSize || view.height != kThumbnailSize)
        throw py::value_error(std::string(what) + " is no thumbnail of 256 x 256 x 3");
    Thumbnail thumbnail;
    for (int y = 0, i = 0; y < kThumbnailSize; ++y)
        for (int x = 0; x < kThumbnailSize; ++x, i += 3)
            std::copy_n(view.pixel(x, y), 3, thumbnail.rgb.data() + i);
    return thumbnail;
}

Parameters select_parameters(const Model& model, const py::array& photo, const py::object& reference)
{
    const Thumbnail source = thumbnail_of(photo, "photo");
    const bool loaded = py::isinstance<LoadedReference>(reference);
    const Thumbnail shown = loaded ? reference.cast<LoadedReference>().get().thumbnail
                                   : thumbnail_of(reference.cast<py::array>(), "reference");
    Expected<Parameters> parameters = Error{};
    {
        const Unlocked unlocked;
        parameters = select(model, source, shown);
    }
    Parameters chosen = value_of(std::move(parameters));
    if (loaded) {
        chosen.reference_name = reference.cast<LoadedReference>().get().name;
        chosen.reference_hash = reference.cast<LoadedReference>().get().hash;
    }
    return chosen;
}

/// The library's never change; pybind11 knows no pointers to what is const.
class PreparedApplier {
public:
    PreparedApplier(const Model& model, const Parameters& parameters, bool forward, bool fast)
        : m_applier(value_of(Applier::create(model, parameters, forward ? Direction::forward : Direction::reverse,
                                             fast ? Precision::fast : Precision::float32)))
    {
    }

    int halo() const { return m_applier->halo(); }

    /// `part`: of the image the pixels from (x, y) on; `region`: x0, x1, y0, y1 of what `out` gets.
    void run(const py::array& part, int x, int y, int full_width, int full_height, const std::array<int, 4>& region,
             py::array& out, int threads) const
    {
        const ImagePart source{ view_of(part, "image"), x, y, full_width, full_height };
        const MutableImageView target = mutable_view_of(out, "out");
        Interruption interruption;
        ApplyOptions options;
        options.threads = checked_threads(threads);
        options.progress = [&](float) { return !interruption.pending(); };
        Status done;
        {
            const Unlocked unlocked;
            done = m_applier->run(source, { region[0], region[1], region[2], region[3] }, target, options);
        }
        interruption.rethrow();
        require(done);
    }

private:
    std::shared_ptr<const Applier> m_applier;
};

/// The floats that OpenImageIO makes of any values, which are those that a file of them gives.
py::array floats_of(const py::array& array)
{
    const MemoryImage image = image_of(array, {}, "");
    const auto& spec = image.spec;
    std::vector<py::ssize_t> shape(array.shape(), array.shape() + array.ndim());
    py::array_t<float> floats(shape);
    auto* const to = reinterpret_cast<unsigned char*>(floats.mutable_data());
    const py::ssize_t value = sizeof(float), pixel = value * spec.nchannels;
    const Unlocked unlocked;
    for (int c = 0; c < spec.nchannels; ++c)
        OIIO::convert_image(1, spec.width, spec.height, 1,
                            static_cast<const unsigned char*>(image.pixels) + c * image.channel_stride, spec.format,
                            image.x_stride, image.y_stride, OIIO::AutoStride, to + c * value, OIIO::TypeFloat, pixel,
                            pixel * spec.width, OIIO::AutoStride);
    return std::move(floats);
}

} // namespace

void bind_selection(py::module_& module)
{
    module.def("photo_thumbnail", &photo_thumbnail);
    module.def("select", &select_parameters);
    py::class_<PreparedApplier>(module, "Applier")
        .def(py::init<const Model&, const Parameters&, bool, bool>())
        .def_property_readonly("halo", &PreparedApplier::halo)
        .def("run", &PreparedApplier::run);
    module.def("floats", &floats_of);
}

} // namespace srisp::python
