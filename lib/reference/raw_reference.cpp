// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_reference.h"

#include <srisp/thumbnail.h>

#include "base/file_bytes.h"
#include "base/hashes.h"
#include "raw_file/decoder_process.h"
#include "reference/decoders.h"
#include "reference/reference_bytes.h"
#include "reference/sample_layout.h"

namespace srisp {

Expected<HashedRaw> read_raw(const std::string& path)
{
    const auto file = read_whole_file(path);
    if (!file)
        return file.error();
    auto image = decode_raw(*file);
    if (!image)
        return image.error();
    return HashedRaw{ std::move(*image), hash_of_bytes(file->data.get(), file->size) };
}

Expected<HashedRaw> read_samples(const std::string& path, const SampleLayout& layout)
{
    const auto file = read_whole_file(path);
    if (!file)
        return file.error();
    auto image = decode_plain_samples(*file, layout);
    if (!image)
        return image.error();
    const std::string both = hash_of_bytes(file->data.get(), file->size) + layout.text;
    return HashedRaw{ std::move(*image), hash_of_bytes(both.data(), both.size()) };
}

Reference reference_of(const HashedRaw& raw)
{
    const RawImage& image = raw.image;
    return {
        "", "", raw.hash, oriented(raw_thumbnail(image.pixels), image.facts.orientation), image.facts, image.notes
    };
}

Expected<Reference> load_raw(const std::string& path, bool isolate)
{
    if (isolate) {
        const auto bytes = run_decoder(DecoderTask::reference, path);
        return bytes ? reference_of_bytes(*bytes) : bytes.error();
    }
    const auto raw = read_raw(path);
    return raw ? Expected<Reference>(reference_of(*raw)) : raw.error();
}

} // namespace srisp
