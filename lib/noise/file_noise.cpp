// SPDX-License-Identifier: Apache-2.0
#include "noise/file_noise.h"

#include <cstring>

#include "noise/estimate_noise.h"
#include "raw_file/decoder_process.h"
#include "reference/raw_reference.h"
#include "reference/reference_type.h"
#include "reference/sample_layout.h"

namespace srisp {

namespace {

constexpr std::size_t kFigures = sizeof(NoiseModel); // bytes

Expected<FileNoise> noise_of(const Expected<HashedRaw>& raw)
{
    if (!raw)
        return raw.error();
    if (raw->image.lossy)
        return Error{ "its lossy compression has taken noise away" };
    const auto noise = estimate_noise(raw->image.pixels);
    return noise ? FileNoise{ *noise, raw->hash } : Expected<FileNoise>(noise.error());
}

} // namespace

Expected<FileNoise> estimate_file_noise(const std::string& path, bool isolate)
{
    const auto type = reference_type(path);
    if (!type)
        return type.error();
    if (type->kind == FileKind::headerless) {
        const auto layout = needed_sample_layout(path);
        return layout ? noise_of(read_samples(path, *layout)) : layout.error();
    }
    if (!isolate)
        return noise_of(read_raw(path));
    const auto bytes = run_decoder(DecoderTask::noise, path);
    return bytes ? noise_of_bytes(*bytes) : bytes.error();
}

std::string bytes_of_noise(const FileNoise& noise)
{
    return std::string(reinterpret_cast<const char*>(&noise.noise), kFigures) + noise.hash;
}

Expected<FileNoise> noise_of_bytes(const std::string& bytes)
{
    FileNoise result;
    if (bytes.size() >= kFigures) {
        std::memcpy(&result.noise, bytes.data(), kFigures);
        result.hash = bytes.substr(kFigures);
    }
    if (bytes.size() < kFigures || !check_noise(result.noise))
        return decoder_nonsense();
    return result;
}

} // namespace srisp
