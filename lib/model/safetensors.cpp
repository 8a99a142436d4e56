// SPDX-License-Identifier: Apache-2.0
#include "model/safetensors.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "base/half_float.h"

namespace srisp {

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
