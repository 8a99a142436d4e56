// SPDX-License-Identifier: Apache-2.0
#include "orientation_words.h"

#include "base/png_orientation.h"

namespace srisp::tool::orientation {

Words ensure()
{
    return { "--orientcw", "--orientccw" };
}

Words turn_upright()
{
    return { "--if",
             "{TOP.Orientation==5}",
             "--transpose",
             "--orientation",
             "1",
             "--endif",
             "--if",
             "{TOP.Orientation==7}",
             "--transpose",
             "--rotate180",
             "--orientation",
             "1",
             "--endif",
             "--reorient" };
}

Words mark_for_png()
{
    return { "--sattrib", kPngOrientationKey, std::string("{TOP.Orientation}") + kPngOrientationRest };
}

Words unmark()
{
    return { "--eraseattrib", kPngOrientationKey };
}

Words tell_turned(const std::string& path)
{
    return { "--if", "{TOP.Orientation!=1}", "--create", "1x1", "1", "-o", path, "--pop", "--endif" };
}

} // namespace srisp::tool::orientation
