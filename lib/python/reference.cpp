// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <optional>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <srisp/noise.h>

#include "bindings.h"
#include "interruption.h"
#include "loaded_reference.h"

namespace srisp::python {

namespace {

template<class Values> py::object or_none(const Values& values)
{
    for (const auto value : values)
        if (value != 0)
            return py::tuple(py::cast(values));
    return py::none();
}

py::object or_none(float value)
{
    return value == 0 ? py::object(py::none()) : py::object(py::float_(value));
}

py::array matrix(const std::array<float, 9>& values)
{
    return py::array_t<float>({ 3, 3 }, values.data());
}

py::list color_matrices(const CameraFacts& facts)
{
    using namespace py::literals;
    py::list all;
    for (const CameraFacts::ColorMatrix& known : facts.color_matrices) {
        const bool forward = std::any_of(known.forward.begin(), known.forward.end(), [](float v) { return v != 0; });
        all.append(py::dict("illuminant"_a = known.illuminant, "xyz_to_camera"_a = matrix(known.xyz_to_camera),
                            "forward"_a = forward ? py::object(matrix(known.forward)) : py::none()));
    }
    return all;
}

std::string shown(const CameraFacts& facts)
{
    return "CameraFacts(make=" + shown_as(any_text(facts.make)) + ", model=" + shown_as(any_text(facts.model)) +
           ", size=(" + std::to_string(facts.width) + ", " + std::to_string(facts.height) +
           "), cfa_pattern=" + quoted(facts.cfa_pattern) + ", iso=" + shown_as(or_none(facts.iso)) + ")";
}

void bind_facts(py::module_& module)
{
    using F = CameraFacts;
    py::class_<F>(
        module, "CameraFacts",
        "What a RAW file says of its camera and exposure; None, or empty: not known. Levels are in its own units.")
        .def_property_readonly("make", [](const F& f) { return any_text(f.make); })
        .def_property_readonly("model", [](const F& f) { return any_text(f.model); })
        .def_property_readonly(
            "size", [](const F& f) { return py::make_tuple(f.width, f.height); },
            "(width, height) of the active area as stored, pixels.")
        .def_readonly("orientation", &F::orientation, "EXIF orientation of the stored pixels, 1 to 8.")
        .def_readonly("cfa_pattern", &F::cfa_pattern,
                      "'RGGB', ... from the active area's top left; '' for demosaiced images.")
        .def_property_readonly(
            "black_level", [](const F& f) { return py::tuple(py::cast(f.black_level)); },
            "Mean black levels of R, first G, B, second G.")
        .def_property_readonly("white_level", [](const F& f) { return or_none(f.white_level); })
        .def_property_readonly("color_matrices", &color_matrices,
                               "One dict per calibration light: illuminant (EXIF LightSource), xyz_to_camera (3 x 3), "
                               "forward (3 x 3 or None).")
        .def_property_readonly(
            "as_shot_neutral", [](const F& f) { return or_none(f.as_shot_neutral); },
            "Camera RGB of a neutral surface, G = 1.")
        .def_property_readonly("iso", [](const F& f) { return or_none(f.iso); })
        .def_property_readonly("exposure_time_s", [](const F& f) { return or_none(f.exposure_time_s); })
        .def_property_readonly("f_number", [](const F& f) { return or_none(f.f_number); })
        .def("__repr__", &shown);
}

/// One figure for all three colours, or one each.
std::array<double, 3> three(const py::object& figures)
{
    if (!py::isinstance<py::sequence>(figures)) {
        std::array<double, 3> same;
        same.fill(figures.cast<double>());
        return same;
    }
    return figures.cast<std::array<double, 3>>();
}

NoiseModel checked(NoiseModel noise)
{
    require(check_noise(noise));
    return noise;
}

void bind_noise(py::module_& module)
{
    using N = NoiseModel;
    py::class_<N>(module, "NoiseModel", R"(A sensor's noise: the variance of a value v in [0, 1] is shot * v + read.

    NoiseModel(shot=0.01, read=1e-4)     one figure each for all colours, or three: R, G, B; in [0, 1]
    Reference("ref.dng").noise           of a reference
    NoiseModel.darktable("Canon EOS 5D Mark II", iso=800)
    NoiseModel.random(seed=1)            drawn as in Brooks et al. 2019, Unprocessing images)")
        .def(py::init([](const py::object& shot, const py::object& read) {
                 return checked({ three(shot), three(read) });
             }),
             py::arg("shot"), py::arg("read"))
        .def_static("random", &upi_noise, py::arg("seed"), "Drawn as in Brooks et al. 2019, the same for all colours.")
        .def_static(
            "darktable",
            [](const std::string& camera, double iso, const std::string& path, const std::string& make) {
                return value_of(darktable_noise(path, make, camera, iso));
            },
            py::arg("camera"), py::arg("iso"), py::arg("path") = "/usr/share/darktable/noiseprofiles.json",
            py::arg("make") = "",
            "From darktable's profiles, by the camera's name, interpolated between two ISOs. Raises srisp.Error "
            "for a camera or an ISO that is not there.")
        .def_property_readonly(
            "shot", [](const N& n) { return py::tuple(py::cast(n.shot)); },
            "Of R, G, B: how much of the value is variance.")
        .def_property_readonly(
            "read", [](const N& n) { return py::tuple(py::cast(n.read)); }, "Of R, G, B: the variance of black.")
        .def(
            "__eq__", [](const N& a, const N& b) { return a.shot == b.shot && a.read == b.read; }, py::is_operator())
        .def(py::pickle([](const N& n) { return py::make_tuple(n.shot, n.read); },
                        [](const py::tuple& state) {
                            return N{ state[0].cast<std::array<double, 3>>(), state[1].cast<std::array<double, 3>>() };
                        }))
        .def("__repr__", [](const N& n) {
            return "NoiseModel(shot=" + shown_as(py::tuple(py::cast(n.shot))) +
                   ", read=" + shown_as(py::tuple(py::cast(n.read))) + ")";
        });
}

LoadedReference load(const std::string& path, bool isolate)
{
    auto loaded = wait_for([path, isolate] { return load_reference_cached(path, isolate); });
    return LoadedReference(value_of(std::move(loaded)));
}

py::array thumbnail_of(const py::object& self)
{
    const Thumbnail& thumbnail = self.cast<const LoadedReference&>().get().thumbnail;
    py::array_t<float> view({ kThumbnailSize, kThumbnailSize, 3 }, thumbnail.rgb.data(), self);
    view.attr("flags").attr("writeable") = false;
    return std::move(view);
}

NoiseModel noise_of(const LoadedReference& reference)
{
    const auto shared = reference.shared();
    return value_of(wait_for([shared] { return reference_noise(*shared); }));
}

} // namespace

void bind_reference(py::module_& module)
{
    bind_facts(module);
    bind_noise(module);
    using R = LoadedReference;
    py::class_<R>(module, "Reference", R"(A camera in a light, as one RAW file showed it.

    Reference("ref.dng")

path: any RAW file that LibRaw decodes, a DNG, a linear EXR or TIFF. It is decoded once, here, by a program of its own, so
that a damaged file cannot crash Python (isolate=False: in this process). Raises srisp.Error for files that are missing or
damaged, and for those that are no RAW images of three colours. It never changes, so any number of threads may use it;
pickled it travels as its path and is loaded again.)")
        .def(py::init([](const py::object& path, bool isolate) { return load(path_of(path), isolate); }),
             py::arg("path"), py::arg("isolate") = true)
        .def_property_readonly(
            "name", [](const R& r) { return path_text(r.get().name); }, "Base name of the file.")
        .def_property_readonly(
            "path", [](const R& r) { return path_text(r.get().path); }, "As it was given.")
        .def_property_readonly(
            "hash", [](const R& r) { return r.get().hash; }, "'xxh128:' and 32 hex digits, of the file's bytes.")
        .def_property_readonly(
            "facts", [](const R& r) { return r.get().facts; }, "CameraFacts of the file.")
        .def_property_readonly("thumbnail", &thumbnail_of,
                               "256 x 256 x 3 float32, linear camera RGB in [0, 1], upright; read-only.")
        .def_property_readonly(
            "notes",
            [](const R& r) {
                py::list notes;
                for (const std::string& note : r.get().notes)
                    notes.append(any_text(note));
                return notes;
            },
            "What was ignored or assumed, one sentence each.")
        .def_property_readonly(
            "noise", &noise_of,
            R"(NoiseModel of its sensor at its ISO: from the DNG's NoiseProfile, else estimated from the mosaic in the
file, which is read again. Raises srisp.Error where there is neither.)")
        .def(py::pickle(
            [](const R& r) {
                const py::object path = py::module_::import("os").attr("path").attr("abspath")(path_text(r.get().path));
                return py::make_tuple(path, r.get().hash);
            },
            [](const py::tuple& state) {
                R loaded = load(path_of(state[0]), true);
                if (loaded.get().hash != state[1].cast<std::string>())
                    throw LibraryError("reference '" + loaded.get().path + "' has changed since it was pickled");
                return loaded;
            }))
        .def(
            "__eq__", [](const R& a, const R& b) { return a.get().hash == b.get().hash; }, py::is_operator())
        .def("__hash__", [](const R& r) { return py::hash(py::str(r.get().hash)); })
        .def("__repr__", [](const R& r) {
            const CameraFacts& facts = r.get().facts;
            return "Reference(" + shown_as(path_text(r.get().path)) + ", " +
                   shown_as(any_text(facts.make + " " + facts.model)) + ")";
        });
}

} // namespace srisp::python
