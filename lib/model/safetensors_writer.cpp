// SPDX-License-Identifier: Apache-2.0
#include "model/safetensors_writer.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/output_file.h"
#include "model/safetensors_header.h"

namespace srisp {

namespace {

std::uint64_t byte_count(const TensorView& tensor)
{
    std::uint64_t bytes = safetensors_element_size(tensor.type);
    for (const std::int64_t extent : tensor.shape)
        bytes *= static_cast<std::uint64_t>(extent);
    return bytes;
}

} // namespace

Status write_safetensors(const std::string& path, std::vector<TensorView> tensors,
                         const std::map<std::string, std::string>& metadata)
{
    nlohmann::json header = nlohmann::json::object();
    if (!metadata.empty())
        header["__metadata__"] = metadata;
    std::stable_sort(tensors.begin(), tensors.end(), [](const TensorView& a, const TensorView& b) {
        return safetensors_element_size(a.type) > safetensors_element_size(b.type);
    });
    std::uint64_t end = 0;
    for (const TensorView& tensor : tensors) {
        if (safetensors_element_size(tensor.type) == 0)
            return Error{ "'" + path + "': tensor '" + tensor.name + "' has unknown type '" + tensor.type + "'" };
        if (header.contains(tensor.name))
            return Error{ "'" + path + "': two tensors are named '" + tensor.name + "'" };
        const std::uint64_t begin = end;
        end += byte_count(tensor);
        header[tensor.name] = { { "dtype", tensor.type },
                                { "shape", tensor.shape },
                                { "data_offsets", { begin, end } } };
    }
    // Texts that are no UTF-8 (a path in metadata) are replaced: nlohmann would throw.
    std::string text = header.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    text.resize((text.size() + 7) / 8 * 8, ' ');

    OutputFile file(path);
    const std::uint64_t length = text.size();
    file.write(&length, 8);
    file.write(text);
    for (const TensorView& tensor : tensors)
        file.write(tensor.data, byte_count(tensor));
    return file.finish();
}

} // namespace srisp
