// SPDX-License-Identifier: Apache-2.0
// darktable's profiles of noise.
#include <srisp/noise.h>

#include "memory_file.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    const std::string& path = file.holding(data, size);
    for (const double iso : { 100.0, 150.0, 0.0 })
        if (const auto noise = darktable_noise(path, "Canon", "EOS 5D", iso); fuzz::is_accepted(noise))
            fuzz::must_hold(bool(check_noise(*noise)), "figures of noise can be used");
    return 0;
}
