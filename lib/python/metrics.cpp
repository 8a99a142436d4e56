// SPDX-License-Identifier: Apache-2.0
#include <srisp/metrics.h>

#include <pybind11/stl.h>

#include "arrays.h"
#include "unlocked.h"

namespace srisp::python {

namespace {

using Matrix = std::array<std::array<float, 3>, 3>;

/// Two images of one size.
std::pair<ImageView, ImageView> pair_of(const py::array& result, const py::array& truth)
{
    const ImageView a = view_of(result, "result"), b = view_of(truth, "truth");
    if (a.width != b.width || a.height != b.height)
        throw py::value_error("result has shape " + text_of(result.attr("shape")) + ", truth " +
                              text_of(truth.attr("shape")) + ": the same is needed");
    return { a, b };
}

template<class Measure> auto measured(const py::array& result, const py::array& truth, Measure measure)
{
    const auto [a, b] = pair_of(result, truth);
    const Unlocked unlocked;
    return measure(a, b);
}

} // namespace

void bind_metrics(py::module_& module)
{
    module.def("psnr", [](const py::array& result, const py::array& truth) { return measured(result, truth, &psnr); });
    module.def("ssim", [](const py::array& result, const py::array& truth) { return measured(result, truth, &ssim); });
    module.def("delta_e2000", [](const py::array& result, const py::array& truth, const Matrix& camera_to_xyz) {
        return measured(result, truth, [matrix = row_major(camera_to_xyz)](ImageView a, ImageView b) {
            return mean_delta_e2000(a, b, matrix);
        });
    });
    module.def("angular_error", [](const py::array& result, const py::array& truth) {
        return measured(result, truth, &angular_error).mean();
    });
    module.def("highlight_errors", [](const py::array& result, const py::array& truth) {
        const HighlightErrors errors = measured(result, truth, &highlight_errors);
        return py::make_tuple(errors.mean(), errors.mean_at_gain());
    });
    module.def("lab_intersection", [](const py::array& result, const py::array& truth, const Matrix& camera_to_xyz) {
        const auto views = std::pair(view_of(result, "result"), view_of(truth, "truth"));
        const std::array<float, 9> matrix = row_major(camera_to_xyz);
        const Unlocked unlocked;
        LabHistogram a, b;
        a.add(views.first, matrix);
        b.add(views.second, matrix);
        return a.intersection(b);
    });
}

} // namespace srisp::python
