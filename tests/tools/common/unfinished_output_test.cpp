// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/common/unfinished_output.h"

#include <doctest/doctest.h>

using srisp::tool::is_unfinished_output;

TEST_CASE("names that oiiotool writes to are known, whatever else is in the path")
{
    for (const char* path :
         { "raw.0123abcd.temp.exr", "/a/b/raw.0123ABCD.temp.png", "my.tempfolder/x.12345678.temp.png",
           "shot.template.12345678.temp.png", "a.temp.12345678.temp.temp", ".12345678.temp.jpg",
           "a.12345678.temp.dir/x.87654321.temp.sgi", "a.12345678.temp.87654321.temp.tga", "no_extension.12345678.temp",
           "a.temp.b.temp.12345678.temp.j2k" })
        CHECK_MESSAGE(is_unfinished_output(path), path);
}

TEST_CASE("names that a user gives are not taken for them")
{
    for (const char* path : { "", "/", "raw.exr", ".temp", "x.temp.exr", "x.1234567.temp.exr", "x.1234567g.temp.exr",
                              "x12345678.temp.exr", "x.12345678.temporary.exr", "x.12345678.temp.exr.bak",
                              "a.12345678.temp.dir/x.png", "a.12345678.temp.png/", "a.12345678.temp.png/x" })
        CHECK_MESSAGE(!is_unfinished_output(path), path);
}
