// SPDX-License-Identifier: Apache-2.0
// Decodes RAW files for the programs of srisp, so that what these files do to LibRaw is done to nobody else.
#include "noise/file_noise.h"
#include "raw_file/decoder_process.h"
#include "reference/embedded_preview.h"
#include "reference/libraw_trial.h"
#include "reference/raw_reference.h"
#include "reference/reference_bytes.h"

using namespace srisp;

static Expected<std::string> decode(DecoderTask task, const std::string& path)
{
    if (task == DecoderTask::trial) {
        const Status tried = try_libraw(path);
        return tried ? Expected<std::string>("") : tried.error();
    }
    if (task == DecoderTask::preview)
        return embedded_preview(path, false);
    if (task == DecoderTask::noise) {
        const auto noise = estimate_file_noise(path, false);
        return noise ? Expected<std::string>(bytes_of_noise(*noise)) : noise.error();
    }
    const auto reference = load_raw(path, false);
    return reference ? Expected<std::string>(bytes_of_reference(*reference)) : reference.error();
}

int main(int argc, char** argv)
{
    return serve_decoder(argc, argv, decode);
}
