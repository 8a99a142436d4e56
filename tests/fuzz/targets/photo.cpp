// SPDX-License-Identifier: Apache-2.0
// Photos of all formats through the front door: whatever OpenImageIO's readers, libheif and libwebp make of a file, and
// our own readers of containers, colours, gain maps and damage. The size's last bits say what is asked for.
#include <srisp/photo.h>

#include <cstdlib>
#include <filesystem>

#include "memory_file.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

/// The path of what `file` holds, with an ending that decides where the first bytes do not.
std::string as_targa(const std::string& file)
{
    static const ScratchFolder scratch;
    const std::string path = scratch.path("photo.tga");
    if (!std::filesystem::is_symlink(path))
        std::filesystem::create_symlink(file, path);
    return path;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    static const int kLimited = ::setenv("SRISP_MAX_MEGAPIXELS", "1", 1); // time is for many small images
    fuzz::must_hold(kLimited == 0, "the environment can be set");
    Options options;
    options.threads = 1;
    options.isolate = false;
    options.allow_partial = size & 1;
    options.gain_map = size & 2 ? GainMapUse::apply : GainMapUse::ignore;
    const auto thumbnail = load_photo_thumbnail(as_targa(file.holding(data, size)), options);
    if (fuzz::is_accepted(thumbnail))
        fuzz::must_be_in_unit_range(thumbnail->rgb, "a thumbnail's values are in [0,1]");
    return 0;
}
