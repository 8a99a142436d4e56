// SPDX-License-Identifier: Apache-2.0
#include "reference/libraw_trial.h"

#include <libraw/libraw.h>

#include "raw_file/libraw_traps.h"

namespace srisp {

Status try_libraw(const std::string& path)
{
    const auto file = read_whole_file(path);
    if (!file)
        return file.error();
    if (Status status = check_libraw_traps(*file); !status)
        return status;
    LibRaw raw; // its complaints on stderr go nowhere in the decoder's process
    int code = raw.open_file(path.c_str());
    if (code == LIBRAW_SUCCESS)
        code = raw.unpack();
    return code == LIBRAW_SUCCESS ? Status() : Status(Error{ std::string("LibRaw: ") + LibRaw::strerror(code) });
}

} // namespace srisp
