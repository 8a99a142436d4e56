// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/noise.h>

namespace srisp {

/// The noise of a RAW file's image, estimated from it.
struct FileNoise {
    NoiseModel noise;
    std::string hash; ///< of what the image was decoded from, as Reference has it
};

/// Reads and decodes a RAW file, or plain samples that a file beside them describes. `isolate`: RAW files are read and
/// decoded in a process of their own (decoder_process.h). Errors, without the file's name: it cannot be read or
/// decoded, its compression has taken noise away, those of estimate_noise and of that process.
Expected<FileNoise> estimate_file_noise(const std::string& path, bool isolate);

/// As bytes for the program at the other end of a pipe: same machine, same version.
std::string bytes_of_noise(const FileNoise& noise);

/// What is in such bytes. Errors: they are not what bytes_of_noise makes, or hold figures that cannot be.
Expected<FileNoise> noise_of_bytes(const std::string& bytes);

} // namespace srisp
