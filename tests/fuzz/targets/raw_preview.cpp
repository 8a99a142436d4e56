// SPDX-License-Identifier: Apache-2.0
// What else LibRaw is asked for: the trial before OpenImageIO's reader may have a file, and the embedded picture.
#include "memory_file.h"
#include "reference/embedded_preview.h"
#include "reference/libraw_trial.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    const std::string& path = file.holding(data, size);
    fuzz::is_accepted(try_libraw(path));
    if (const auto picture = embedded_preview(path, false); fuzz::is_accepted(picture))
        fuzz::must_hold(!picture->empty() && picture->size() <= size, "a picture lies in its file");
    return 0;
}
