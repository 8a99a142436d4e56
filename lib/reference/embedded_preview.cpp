// SPDX-License-Identifier: Apache-2.0
#include "reference/embedded_preview.h"

#include <libraw/libraw.h>

#include "raw_file/decoder_process.h"
#include "raw_file/libraw_traps.h"

namespace srisp {

Expected<std::string> embedded_preview(const std::string& path, bool isolate)
{
    if (isolate)
        return run_decoder(DecoderTask::preview, path);
    const auto file = read_whole_file(path);
    if (!file)
        return file.error();
    if (Status status = check_libraw_traps(*file); !status)
        return status.error();
    LibRaw raw;
    int code = raw.open_file(path.c_str());
    if (code == LIBRAW_SUCCESS)
        code = raw.unpack_thumb();
    if (code != LIBRAW_SUCCESS)
        return Error{ std::string("has no embedded picture: LibRaw: ") + LibRaw::strerror(code) };
    const libraw_thumbnail_t& picture = raw.imgdata.thumbnail;
    if (picture.tformat != LIBRAW_THUMBNAIL_JPEG || !picture.thumb || picture.tlength == 0)
        return Error{ "its embedded picture is no JPEG" };
    return std::string(picture.thumb, picture.tlength);
}

} // namespace srisp
