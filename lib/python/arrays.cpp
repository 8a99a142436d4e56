// SPDX-License-Identifier: Apache-2.0
#include "arrays.h"

namespace srisp::python {

namespace {

OIIO::TypeDesc type_of(const py::dtype& dtype)
{
    const char kind = dtype.kind();
    const auto size = dtype.itemsize();
    const bool native = dtype.attr("isnative").cast<bool>();
    if (native && kind == 'u' && size <= 2)
        return size == 1 ? OIIO::TypeUInt8 : OIIO::TypeUInt16;
    if (native && kind == 'f' && size == 2)
        return OIIO::TypeHalf;
    if (native && kind == 'f' && size == 4)
        return OIIO::TypeFloat;
    if (native && kind == 'f' && size == 8)
        return OIIO::TypeDesc(OIIO::TypeDesc::DOUBLE);
    throw py::type_error("array of " + text_of(dtype) + ": uint8, uint16, float16, float32 or float64 is needed");
}

std::string shape_of(const py::array& array)
{
    return text_of(array.attr("shape"));
}

void require_sides(const py::array& array)
{
    for (py::ssize_t i = 0; i < array.ndim(); ++i)
        if (array.shape(i) < 1 || array.shape(i) > (1 << 20))
            throw py::value_error("array of shape " + shape_of(array) + ": 1 to 1048576 a side are possible");
}

template<class Float> BasicImageView<Float> view(Float* data, const py::array& array, const char* what)
{
    if (array.dtype().kind() != 'f' || array.itemsize() != 4)
        throw py::type_error(std::string(what) + " is an array of " + text_of(array.dtype()) + ": float32 is needed");
    require_sides(array);
    constexpr py::ssize_t value = sizeof(float);
    if (array.ndim() != 3 || array.shape(2) != 3)
        throw py::value_error(std::string(what) + " has shape " + shape_of(array) + ": height x width x 3 is needed");
    if (array.strides(2) != value || array.strides(0) % value != 0 || array.strides(1) % value != 0)
        throw py::value_error(std::string(what) + " has strides " + text_of(array.attr("strides")) +
                              ": channels must be adjacent and others whole float32 apart");
    return { data, int(array.shape(1)), int(array.shape(0)), array.strides(1) / value, array.strides(0) / value };
}

} // namespace

MemoryImage image_of(const py::array& array, const Metadata& metadata, const std::string& name)
{
    if (array.ndim() != 2 && array.ndim() != 3)
        throw py::value_error("array of shape " + shape_of(array) +
                              ": height x width, or height x width x channels is needed");
    require_sides(array);
    MemoryImage image;
    const int channels = array.ndim() == 3 ? int(array.shape(2)) : 1;
    OIIO::ImageSpec layout(int(array.shape(1)), int(array.shape(0)), channels, type_of(array.dtype()));
    layout.extra_attribs = metadata.spec.extra_attribs;
    if (metadata.spec.channelnames.size() == std::size_t(channels)) {
        layout.channelnames = metadata.spec.channelnames;
        layout.alpha_channel = metadata.spec.alpha_channel;
        layout.z_channel = metadata.spec.z_channel;
    } else if (channels == 2) {
        layout.channelnames = { "Y", "A" };
        layout.alpha_channel = 1;
    } else if (channels == 1) {
        layout.channelnames = { "Y" };
    }
    image.spec = std::move(layout);
    image.pixels = array.data();
    image.channel_stride = array.ndim() == 3 ? array.strides(2) : array.itemsize();
    image.x_stride = array.strides(1);
    image.y_stride = array.strides(0);
    image.name = name;
    return image;
}

ImageInput input_of(const py::object& image, const Metadata& metadata, const std::string& name)
{
    return py::isinstance<py::bytes>(image) ? ImageInput(image.cast<std::string>())
                                            : ImageInput(image_of(image.cast<py::array>(), metadata, name));
}

int checked_threads(int threads)
{
    if (threads < 0)
        throw py::value_error("threads is " + std::to_string(threads) + ": 0 (all), or 1 and more are possible");
    return threads;
}

std::array<float, 9> row_major(const std::array<std::array<float, 3>, 3>& rows)
{
    std::array<float, 9> values;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = rows[i / 3][i % 3];
    return values;
}

ImageView view_of(const py::array& array, const char* what)
{
    return view(static_cast<const float*>(array.data()), array, what);
}

MutableImageView mutable_view_of(py::array& array, const char* what)
{
    if (!array.writeable())
        throw py::value_error(std::string(what) + " is read-only");
    return view(static_cast<float*>(array.mutable_data()), array, what);
}

} // namespace srisp::python
