// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/common/shell_quote.h"

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("plain words stay as they are, others are quoted")
{
    CHECK(shell_line({ "srisptool", "a.jpg", "-o:bits=16", "/x/y_1.exr" }) == "srisptool a.jpg -o:bits=16 /x/y_1.exr");
    CHECK(shell_line({ "a b", "it's", "" }) == "'a b' 'it'\\''s' ''");
}

TEST_CASE("a shell reads a line back to the same words")
{
    const std::string line = shell_line({ "a b", "it's", "#", "$HOME", "`x`", "\\", "\"", "é{1}", "*", "~", "" });
    CHECK(output_of("printf '[%s]' " + line) == "[a b][it's][#][$HOME][`x`][\\][\"][é{1}][*][~][]");
}
