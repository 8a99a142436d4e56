// SPDX-License-Identifier: Apache-2.0
#include "model/safetensors.h"

#include <algorithm>
#include <cstring>

#include "base/file_part.h"
#include "base/half_float.h"
#include "base/json_object.h"
#include "base/output_file.h"
#include "base/shown_text.h"

namespace srisp {

namespace {

using nlohmann::json;

// Far above what a model, a checkpoint or a pack holds, and little enough to be read at once.
constexpr std::uint64_t kMaxHeaderBytes = std::uint64_t(16) << 20;
constexpr std::size_t kMaxTensors = 1 << 16;
constexpr std::uint64_t kMaxRank = 8;

/// "F32, F16 or BF16"
std::string alternatives(const std::vector<std::string>& names)
{
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i)
        text += (i == 0 ? "" : i + 1 < names.size() ? ", " : " or ") + names[i];
    return text;
}

Expected<TensorEntry> parse_entry(const std::string& name, const json& value, const std::vector<std::string>& types,
                                  const std::string& where)
{
    const std::string tensor = where + ": tensor '" + shown_text(name) + "'";
    if (!value.is_object() || !value.contains("dtype") || !value.contains("shape") || !value.contains("data_offsets"))
        return Error{ tensor + " needs dtype, shape and data_offsets" };
    const json &type = value["dtype"], &shape = value["shape"], &offsets = value["data_offsets"];
    const auto is_count = [](const json& number) { return number.is_number_unsigned(); };
    if (!type.is_string() || !shape.is_array() || !std::all_of(shape.begin(), shape.end(), is_count) ||
        !offsets.is_array() || offsets.size() != 2 || !std::all_of(offsets.begin(), offsets.end(), is_count))
        return Error{ tensor + ": dtype, shape or data_offsets have the wrong type" };
    if (shape.size() > kMaxRank)
        return Error{ tensor + " has " + std::to_string(shape.size()) + " dimensions, limit 8" };
    TensorEntry entry{ name, type.get<std::string>(), shape.get<std::vector<std::int64_t>>(), offsets[0], offsets[1] };
    if (std::find(types.begin(), types.end(), entry.type) == types.end())
        return Error{ tensor + " has type " + shown_text(entry.type) + ", not " + alternatives(types) };
    return entry;
}

/// Whether the entry's bytes lie in the file and are as many as shape and type say.
Status check_extent(const TensorEntry& entry, std::uint64_t data_bytes, const std::string& where)
{
    const std::string tensor = where + ": tensor '" + shown_text(entry.name) + "'";
    if (entry.begin > entry.end)
        return Error{ tensor + " begins at byte " + std::to_string(entry.begin) + " after its end " +
                      std::to_string(entry.end) };
    if (entry.end > data_bytes)
        return Error{ tensor + " ends at byte " + std::to_string(entry.end) + ", file has " +
                      std::to_string(data_bytes) };
    std::uint64_t needed = safetensors_element_size(entry.type);
    for (const std::int64_t extent : entry.shape) {
        if (extent <= 0 || static_cast<std::uint64_t>(extent) > data_bytes || needed > data_bytes)
            return Error{ tensor + " has impossible shape " + shape_text(entry.shape) };
        needed *= static_cast<std::uint64_t>(extent);
    }
    if (needed != entry.end - entry.begin)
        return Error{ tensor + " of shape " + shape_text(entry.shape) + " needs " + std::to_string(needed) +
                      " bytes, has " + std::to_string(entry.end - entry.begin) };
    return {};
}

/// The tensors must fill the data without gap or overlap.
Status check_layout(std::vector<TensorEntry>& entries, std::uint64_t data_bytes, const std::string& where)
{
    std::sort(entries.begin(), entries.end(),
              [](const TensorEntry& a, const TensorEntry& b) { return a.begin < b.begin; });
    std::uint64_t expected = 0;
    for (const TensorEntry& entry : entries) {
        if (entry.begin != expected)
            return Error{ where + ": tensor '" + shown_text(entry.name) + "' begins at byte " +
                          std::to_string(entry.begin) +
                          (entry.begin < expected ? ", overlaps the one before, which ends at "
                                                  : ", leaves a gap after the one before, which ends at ") +
                          std::to_string(expected) };
        expected = entry.end;
    }
    if (expected != data_bytes)
        return Error{ where + ": tensors end at byte " + std::to_string(expected) + ", file has " +
                      std::to_string(data_bytes) };
    return {};
}

Status read_metadata(const json& value, SafeTensorsHeader& header, const std::string& where)
{
    if (!value.is_object())
        return Error{ where + ": __metadata__ is not an object" };
    for (const auto& [key, text] : value.items()) {
        if (!text.is_string())
            return Error{ where + ": metadata '" + shown_text(key) + "' is not a string" };
        header.metadata[key] = text.get<std::string>();
    }
    return {};
}

} // namespace

std::uint64_t safetensors_element_size(const std::string& type)
{
    static const std::map<std::string, std::uint64_t> sizes = { { "F64", 8 }, { "I64", 8 }, { "F32", 4 }, { "I32", 4 },
                                                                { "F16", 2 }, { "U16", 2 }, { "I16", 2 }, { "BF16", 2 },
                                                                { "I8", 1 },  { "U8", 1 },  { "BOOL", 1 } };
    const auto found = sizes.find(type);
    return found == sizes.end() ? 0 : found->second;
}

std::string shape_text(const std::vector<std::int64_t>& shape)
{
    std::string text = "[";
    for (const std::int64_t extent : shape)
        text += (text.size() > 1 ? ", " : "") + std::to_string(extent);
    return text + "]";
}

static Expected<std::uint64_t> header_length(const char* bytes, std::uint64_t size, const std::string& where)
{
    if (size < 8)
        return Error{ where + ": not a safetensors file, it has " + std::to_string(size) +
                      " bytes, at least 8 needed" };
    std::uint64_t length;
    std::memcpy(&length, bytes, 8);
    if (length > size - 8)
        return Error{ where + ": header of " + std::to_string(length) + " bytes, file has " + std::to_string(size - 8) +
                      " after the length (truncated, or not a safetensors file)" };
    if (length > kMaxHeaderBytes)
        return Error{ where + ": header of " + std::to_string(length) + " bytes, limit " +
                      std::to_string(kMaxHeaderBytes) };
    return length;
}

Expected<SafeTensorsHeader> read_safetensors_header(const RegularFile& file, const std::vector<std::string>& types,
                                                    const std::string& where)
{
    std::string bytes(std::min<std::size_t>(file.size(), 8), '\0');
    if (const Status status = read_bytes(file, bytes.data(), 0, bytes.size()); !status)
        return Error{ where + ": " + status.error().message };
    const auto length = header_length(bytes.data(), file.size(), where);
    if (!length)
        return length.error();
    bytes.resize(8 + *length);
    if (const Status status = read_bytes(file, bytes.data(), 0, bytes.size()); !status)
        return Error{ where + ": " + status.error().message };
    return parse_safetensors_header(bytes.data(), file.size(), types, where);
}

Expected<SafeTensorsHeader> parse_safetensors_header(const char* bytes, std::uint64_t size,
                                                     const std::vector<std::string>& types, const std::string& where)
{
    const auto length = header_length(bytes, size, where);
    if (!length)
        return length.error();
    const std::uint64_t header_bytes = *length;
    Expected<json> parsed = parse_json_object({ bytes + 8, header_bytes }, where, "header", kMaxHeaderBytes);
    if (!parsed)
        return parsed.error();
    if (parsed->size() > kMaxTensors)
        return Error{ where + ": has " + std::to_string(parsed->size()) + " tensors, limit " +
                      std::to_string(kMaxTensors) };

    SafeTensorsHeader header;
    header.data_begin = 8 + header_bytes;
    const std::uint64_t data_bytes = size - header.data_begin;
    for (const auto& [name, value] : parsed->items()) {
        if (name == "__metadata__") {
            if (Status status = read_metadata(value, header, where); !status)
                return status.error();
            continue;
        }
        Expected<TensorEntry> entry = parse_entry(name, value, types, where);
        if (!entry)
            return entry.error();
        if (Status status = check_extent(*entry, data_bytes, where); !status)
            return status.error();
        header.entries.push_back(std::move(*entry));
    }
    if (Status status = check_layout(header.entries, data_bytes, where); !status)
        return status.error();
    return header;
}

static Tensor decode(const TensorEntry& entry, const char* data)
{
    const std::uint64_t size = safetensors_element_size(entry.type);
    Tensor tensor{ entry.shape, std::vector<float>((entry.end - entry.begin) / size) };
    for (std::size_t i = 0; i < tensor.values.size(); ++i) {
        const char* bytes = data + entry.begin + i * size;
        if (size == 4) {
            std::memcpy(&tensor.values[i], bytes, 4);
            continue;
        }
        std::uint16_t bits;
        std::memcpy(&bits, bytes, 2);
        tensor.values[i] = entry.type == "F16" ? float_from_half(bits) : float_from_bfloat16(bits);
    }
    return tensor;
}

Expected<SafeTensors> parse_safetensors(const std::string& bytes, const std::string& where)
{
    Expected<SafeTensorsHeader> header =
        parse_safetensors_header(bytes.data(), bytes.size(), { "F32", "F16", "BF16" }, where);
    if (!header)
        return header.error();
    SafeTensors file;
    file.metadata = std::move(header->metadata);
    for (const TensorEntry& entry : header->entries)
        file.tensors[entry.name] = decode(entry, bytes.data() + header->data_begin);
    return file;
}

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
