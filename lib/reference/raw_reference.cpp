// SPDX-License-Identifier: Apache-2.0
#include "reference/raw_reference.h"

#include <srisp/thumbnail.h>

#include "base/file_bytes.h"
#include "base/hashes.h"
#include "raw_file/decoder_process.h"
#include "reference/decoders.h"
#include "reference/reference_bytes.h"

namespace srisp {

Reference reference_of(const RawImage& image, const std::string& hash)
{
    return { "", "", hash, oriented(raw_thumbnail(image.pixels), image.facts.orientation), image.facts, image.notes };
}

Expected<Reference> load_raw(const std::string& path, bool isolate)
{
    if (isolate) {
        const auto bytes = run_decoder(DecoderTask::reference, path);
        return bytes ? reference_of_bytes(*bytes) : bytes.error();
    }
    const auto file = read_whole_file(path);
    if (!file)
        return file.error();
    const auto image = decode_raw(*file);
    if (!image)
        return image.error();
    return reference_of(*image, hash_of_bytes(file->data.get(), file->size));
}

} // namespace srisp
