// SPDX-License-Identifier: Apache-2.0
#include "safetensors.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <set>

#include <nlohmann/json.hpp>

#include "half_float.h"

namespace srisp {

namespace {

using nlohmann::json;

constexpr std::uint64_t kMaxHeaderBytes = 100'000'000; // the format's own limit
constexpr std::uint64_t kMaxRank = 8;

/// One entry of the header.
struct Entry {
    std::string name, type;
    std::vector<std::int64_t> shape;
    std::uint64_t begin, end; // bytes after the header
};

std::uint64_t element_size(const std::string& type)
{
    return type == "F32" ? 4 : type == "F16" || type == "BF16" ? 2 : 0;
}

/// JSON with duplicate keys refused, which nlohmann's parser would silently merge.
Expected<json> parse_header(const std::string& text, const std::string& where)
{
    std::vector<std::set<std::string>> open_objects;
    std::string duplicate;
    const auto watch = [&](int, json::parse_event_t event, json& parsed) {
        if (event == json::parse_event_t::object_start)
            open_objects.emplace_back();
        else if (event == json::parse_event_t::object_end)
            open_objects.pop_back();
        else if (event == json::parse_event_t::key && !open_objects.back().insert(parsed.get<std::string>()).second)
            duplicate = parsed.get<std::string>();
        return true;
    };
    json header = json::parse(text, watch, false);
    if (header.is_discarded() || !header.is_object())
        return Error{ where + ": header is not a JSON object" };
    if (!duplicate.empty())
        return Error{ where + ": '" + duplicate + "' appears twice in the header" };
    return header;
}

Expected<Entry> parse_entry(const std::string& name, const json& value, const std::string& where)
{
    const std::string tensor = where + ": tensor '" + name + "'";
    if (!value.is_object() || !value.contains("dtype") || !value.contains("shape") || !value.contains("data_offsets"))
        return Error{ tensor + " needs dtype, shape and data_offsets" };
    const json &type = value["dtype"], &shape = value["shape"], &offsets = value["data_offsets"];
    const auto is_count = [](const json& number) { return number.is_number_unsigned(); };
    if (!type.is_string() || !shape.is_array() || !std::all_of(shape.begin(), shape.end(), is_count) ||
        !offsets.is_array() || offsets.size() != 2 || !std::all_of(offsets.begin(), offsets.end(), is_count))
        return Error{ tensor + ": dtype, shape or data_offsets have the wrong type" };
    if (shape.size() > kMaxRank)
        return Error{ tensor + " has " + std::to_string(shape.size()) + " dimensions, limit 8" };
    Entry entry{ name, type.get<std::string>(), shape.get<std::vector<std::int64_t>>(), offsets[0], offsets[1] };
    if (element_size(entry.type) == 0)
        return Error{ tensor + " has type " + entry.type + ", not F32, F16 or BF16" };
    return entry;
}

/// Whether the entry's bytes lie in the file and are as many as shape and type say.
Status check_extent(const Entry& entry, std::uint64_t data_bytes, const std::string& where)
{
    const std::string tensor = where + ": tensor '" + entry.name + "'";
    if (entry.begin > entry.end)
        return Error{ tensor + " begins at byte " + std::to_string(entry.begin) + " after its end " +
                      std::to_string(entry.end) };
    if (entry.end > data_bytes)
        return Error{ tensor + " ends at byte " + std::to_string(entry.end) + ", file has " +
                      std::to_string(data_bytes) };
    std::uint64_t needed = element_size(entry.type);
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
Status check_layout(std::vector<Entry>& entries, std::uint64_t data_bytes, const std::string& where)
{
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) { return a.begin < b.begin; });
    std::uint64_t expected = 0;
    for (const Entry& entry : entries) {
        if (entry.begin != expected)
            return Error{ where + ": tensor '" + entry.name + "' begins at byte " + std::to_string(entry.begin) +
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

Tensor decode(const Entry& entry, const char* data)
{
    const std::uint64_t size = element_size(entry.type);
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

} // namespace

std::string shape_text(const std::vector<std::int64_t>& shape)
{
    std::string text = "[";
    for (const std::int64_t extent : shape)
        text += (text.size() > 1 ? ", " : "") + std::to_string(extent);
    return text + "]";
}

Expected<SafeTensors> parse_safetensors(const std::string& bytes, const std::string& where)
{
    if (bytes.size() < 8)
        return Error{ where + ": no safetensors file, it has " + std::to_string(bytes.size()) +
                      " bytes, at least 8 needed" };
    std::uint64_t header_bytes;
    std::memcpy(&header_bytes, bytes.data(), 8);
    if (header_bytes > kMaxHeaderBytes || header_bytes > bytes.size() - 8)
        return Error{ where + ": header of " + std::to_string(header_bytes) + " bytes, file has " +
                      std::to_string(bytes.size() - 8) + " after the length (truncated, or no safetensors file)" };
    Expected<json> header = parse_header(bytes.substr(8, header_bytes), where);
    if (!header)
        return header.error();

    SafeTensors file;
    std::vector<Entry> entries;
    const std::uint64_t data_bytes = bytes.size() - 8 - header_bytes;
    for (const auto& [name, value] : header->items()) {
        if (name == "__metadata__") {
            if (!value.is_object())
                return Error{ where + ": __metadata__ is not an object" };
            for (const auto& [key, text] : value.items()) {
                if (!text.is_string())
                    return Error{ where + ": metadata '" + key + "' is not a string" };
                file.metadata[key] = text.get<std::string>();
            }
            continue;
        }
        Expected<Entry> entry = parse_entry(name, value, where);
        if (!entry)
            return entry.error();
        if (Status status = check_extent(*entry, data_bytes, where); !status)
            return status.error();
        entries.push_back(std::move(*entry));
    }
    if (Status status = check_layout(entries, data_bytes, where); !status)
        return status.error();
    for (const Entry& entry : entries)
        file.tensors[entry.name] = decode(entry, bytes.data() + 8 + header_bytes);
    return file;
}

Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where)
{
    struct stat info;
    if (stat(path.c_str(), &info) != 0)
        return Error{ where + ": cannot open '" + path + "': " + std::strerror(errno) };
    if (S_ISDIR(info.st_mode))
        return Error{ where + ": '" + path + "' is a folder, not a file" };
    std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file)
        return Error{ where + ": cannot open '" + path + "': " + std::strerror(errno) };
    if (static_cast<std::uint64_t>(info.st_size) > max_bytes)
        return Error{ where + ": file has " + std::to_string(info.st_size) + " bytes, limit " +
                      std::to_string(max_bytes) };
    std::string bytes(static_cast<std::size_t>(info.st_size), '\0');
    const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
    if (count != bytes.size())
        return Error{ where + ": read " + std::to_string(count) + " of " + std::to_string(bytes.size()) + " bytes" };
    return bytes;
}

} // namespace srisp
