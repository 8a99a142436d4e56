// SPDX-License-Identifier: Apache-2.0
#include <cstring>
#include <map>
#include <optional>

#include <pybind11/stl.h>
#include <srisp/srisp.h>

#include "arrays.h"
#include "interruption.h"
#include "loaded_reference.h"

namespace srisp::python {

namespace {

using Texts = std::map<std::string, std::string>;

/// `texts`: as set_option takes them.
Options options_of(const Texts& texts, const std::optional<Parameters>& parameters, int threads)
{
    Options options;
    for (const auto& [key, text] : texts)
        if (const Status set = set_option(options, key, text); !set)
            raise(set.error());
    options.parameters = parameters;
    options.threads = checked_threads(threads);
    options.straight_alpha = true;
    return options;
}

/// Runs one of the library's functions that compute an image, without the interpreter's lock: array and metadata.
template<class Run> py::tuple computed(const Run& run)
{
    py::array_t<float> pixels;
    Metadata metadata;
    float* next = nullptr;
    std::size_t row = 0;
    Interruption interruption;
    ImageSink sink;
    sink.holds_all = true;
    sink.begin = [&](const OIIO::ImageSpec& spec) -> Status {
        const py::gil_scoped_acquire lock;
        metadata.spec = spec;
        row = std::size_t(spec.width) * std::size_t(spec.nchannels);
        try {
            pixels = spec.nchannels == 1 ? py::array_t<float>({ spec.height, spec.width })
                                         : py::array_t<float>({ spec.height, spec.width, spec.nchannels });
        } catch (const std::exception&) {
            PyErr_Clear();
            return Error{ "not enough memory for " + std::to_string(spec.width) + " x " + std::to_string(spec.height) +
                          " pixels" };
        }
        next = pixels.mutable_data();
        return {};
    };
    sink.rows = [&](const float* rows, int count) -> Status {
        std::memcpy(next, rows, row * std::size_t(count) * sizeof(float));
        next += row * std::size_t(count);
        return {};
    };
    sink.cancelled = [&] { return interruption.pending(); };
    Status done;
    {
        const Unlocked unlocked;
        done = run(sink);
    }
    interruption.rethrow();
    require(done);
    return py::make_tuple(pixels, metadata);
}

py::tuple unprocess_image(const py::object& image, const Metadata& metadata, const std::string& name,
                          const py::object& reference, const Texts& texts, const std::optional<Parameters>& parameters,
                          int threads)
{
    const ImageInput input = input_of(image, metadata, name);
    const ReferenceInput chosen = reference.is_none()                    ? ReferenceInput("")
                                  : py::isinstance<py::bytes>(reference) ? ReferenceInput(reference.cast<std::string>())
                                                                         : reference.cast<LoadedReference>().shared();
    const Options options = options_of(texts, parameters, threads);
    return computed([&](const ImageSink& sink) { return unprocess(input, chosen, options, sink); });
}

template<Status (*Function)(const ImageInput&, const Options&, const ImageSink&)>
py::tuple changed(const py::object& image, const Metadata& metadata, const std::string& name, const Texts& texts,
                  const std::optional<Parameters>& parameters, int threads)
{
    const ImageInput input = input_of(image, metadata, name);
    const Options options = options_of(texts, parameters, threads);
    return computed([&](const ImageSink& sink) { return Function(input, options, sink); });
}

void write(const py::bytes& file, const py::array& array, const Metadata& metadata, const std::string& type)
{
    if (array.dtype().kind() != 'f' || array.itemsize() != 4 || !(array.flags() & py::array::c_style))
        throw py::type_error("array of " + text_of(array.dtype()) + ": contiguous float32 is needed");
    const std::string path = file;
    const MemoryImage image = image_of(array, metadata, "");
    const auto* const values = static_cast<const float*>(image.pixels);
    const OIIO::TypeDesc stored = type.empty() ? OIIO::TypeUnknown : OIIO::TypeDesc(type);
    Status saved;
    {
        const Unlocked unlocked;
        saved = Image(image.spec, std::vector<float>(values, values + array.size())).save(path, stored);
    }
    require(saved);
}

} // namespace

void bind_images(py::module_& module)
{
    module.def("unprocess", &unprocess_image);
    module.def("process", &changed<&process>);
    module.def("develop", &changed<&develop>);
    module.def("sense", &changed<&sense>);
    module.def("read_photo", &changed<&read_photo>);
    module.def("write", &write);
}

} // namespace srisp::python
