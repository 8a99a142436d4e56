// SPDX-License-Identifier: Apache-2.0
// The bytes of a safetensors file: its header alone, and whole.
#include "model/safetensors.h"

#include <cstring>

#include "base/input_file.h"
#include "fuzz_target.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

const std::vector<std::string> kTypes = { "F64", "F32", "F16", "BF16", "I64", "I32", "I16", "I8", "U16", "U8", "BOOL" };

/// Tensors lie in the file one after the other, and are as long as shape and type say.
void check_header(const SafeTensorsHeader& header, std::size_t size)
{
    std::uint64_t end = 0;
    for (const TensorEntry& entry : header.entries) {
        fuzz::must_hold(entry.begin == end && entry.end >= entry.begin, "tensors leave no gap");
        std::uint64_t bytes = safetensors_element_size(entry.type);
        for (const std::int64_t extent : entry.shape)
            bytes *= std::uint64_t(extent);
        fuzz::must_hold(bytes == entry.end - entry.begin, "a tensor has the size of its shape");
        end = entry.end;
    }
    fuzz::must_hold(header.data_begin + end == size, "tensors fill the file");
}

/// What is written is what is read.
void check_round_trip(const SafeTensors& file)
{
    static const ScratchFolder scratch;
    std::vector<TensorView> views;
    for (const auto& [name, tensor] : file.tensors)
        views.push_back({ name, "F32", tensor.shape, tensor.values.data() });
    const std::string path = scratch.path("file.safetensors");
    fuzz::must_hold(bool(write_safetensors(path, views, file.metadata)), "what was read can be written");
    const auto bytes = read_file(path, 1 << 26, "file");
    const auto again = parse_safetensors(*bytes, "file");
    fuzz::must_hold(bool(again), "what was written can be read");
    fuzz::must_hold(again->metadata == file.metadata && again->tensors.size() == file.tensors.size(),
                    "metadata and names come back");
    for (const auto& [name, tensor] : file.tensors) {
        const Tensor& back = again->tensors.at(name);
        const bool same = back.shape == tensor.shape && back.values.size() == tensor.values.size() &&
                          (tensor.values.empty() || std::memcmp(back.values.data(), tensor.values.data(),
                                                                tensor.values.size() * sizeof(float)) == 0);
        fuzz::must_hold(same, "tensors come back to the bit");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string bytes = fuzz::text_of(data, size);
    if (const auto header = parse_safetensors_header(bytes.data(), size, kTypes, "file"); fuzz::is_accepted(header))
        check_header(*header, size);
    if (const auto file = parse_safetensors(bytes, "file"); fuzz::is_accepted(file))
        check_round_trip(*file);
    return 0;
}
