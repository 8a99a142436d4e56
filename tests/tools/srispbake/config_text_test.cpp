// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbake/config_text.h"

#include <doctest/doctest.h>

#include "../failure_of.h"

using namespace srisp;
using namespace srisp::tool;

static std::string appended(const std::string& text)
{
    YamlSections sections(text);
    sections.append("looks", { "", "  - a", "    b" });
    return sections.text();
}

TEST_CASE("entries go to the end of their section, indented as the others are, and comments stay where they are")
{
    CHECK(appended("# head\nlooks:  # ours\n- x\n  y\n\n# next\nviews:\n  - v\n") ==
          "# head\nlooks:  # ours\n- x\n  y\n\n- a\n  b\n\n# next\nviews:\n  - v\n");
    CHECK(appended("looks:\n    - x\n      y\n") == "looks:\n    - x\n      y\n\n    - a\n      b\n");
}

TEST_CASE("an empty section is filled, a missing one is made")
{
    for (const char* text : { "looks: []\nv: 1\n", "looks:\nv: 1\n", "looks: {}\nv: 1\n", "looks:\n  []\nv: 1\n" })
        CHECK(appended(text) == "looks:\n\n  - a\n    b\nv: 1\n");
    CHECK(appended("v: 1") == "v: 1\n\nlooks:\n\n  - a\n    b\n");
    CHECK(!YamlSections("looks_like: 1\n").has("looks"));
}

TEST_CASE("a value is put where there is none")
{
    for (const char* text : { "path: \"\"\nv: 1\n", "path:\nv: 1\n" }) {
        YamlSections sections(text);
        sections.set("path", ".");
        CHECK(sections.text() == "path: .\nv: 1\n");
    }
    YamlSections sections("v: 1\n");
    sections.set("path", ".");
    CHECK(sections.text() == "v: 1\n\npath: .\n");
}

TEST_CASE("a section in brackets is not taken apart")
{
    CHECK(failure_of([] { appended("looks: [!<Look> {name: x}]\n"); }).find("1: section 'looks' is written as '[") ==
          0);
}
