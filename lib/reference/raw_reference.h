// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>
#include <srisp/reference.h>

#include "reference/raw_pixels.h"

namespace srisp {

struct SampleLayout;

/// A RAW image, and the hash of what it was decoded from, as Reference has it.
struct HashedRaw {
    RawImage image;
    std::string hash;
};

/// Reads and decodes a RAW file in this process. Errors, without the file's name: it cannot be read; those of
/// decode_raw.
Expected<HashedRaw> read_raw(const std::string& path);

/// The same for plain samples. Errors: it cannot be read; those of decode_plain_samples.
Expected<HashedRaw> read_samples(const std::string& path, const SampleLayout& layout);

/// All of a reference but its name and path.
Reference reference_of(const HashedRaw& raw);

/// The same from a RAW file. `isolate`: it is read and decoded in a process of its own (decoder_process.h). Errors:
/// those of read_raw and of that process.
Expected<Reference> load_raw(const std::string& path, bool isolate);

} // namespace srisp
