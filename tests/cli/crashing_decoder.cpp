// SPDX-License-Identifier: Apache-2.0
// Preloaded, it makes libjpeg do to photos of certain widths what broken decoders do: 61 pixels crash it, 67 hang it,
// 71 make it take memory without end, and 73 crash it once, until the file that $once names is there.

#include <cstdio>
#include <cstdlib>
#include <vector>

#include <dlfcn.h>
#include <jpeglib.h>
#include <unistd.h>

extern "C" __attribute__((visibility("default"))) boolean jpeg_start_decompress(j_decompress_ptr decoder)
{
    switch (decoder->image_width) {
    case 61:
        std::abort();
    case 67:
        for (;;)
            ::pause();
    case 71:
        for (std::vector<char> taken;;)
            taken.resize(taken.size() + (std::size_t(64) << 20), 1);
    case 73:
        if (const char* const once = std::getenv("once"))
            if (::access(once, F_OK) != 0) {
                std::fclose(std::fopen(once, "w"));
                std::abort();
            }
        break;
    default:
        break;
    }
    using Function = boolean (*)(j_decompress_ptr);
    static const auto real = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "jpeg_start_decompress"));
    return real(decoder);
}
