// SPDX-License-Identifier: Apache-2.0
// The text of an OpenColorIO config, to which sections are added; without OpenColorIO's own reading of it.
#include "fuzz_target.h"
#include "tools/common/failure.h"
#include "tools/srispbake/config_text.h"

using namespace srisp;

namespace {

bool has_line(const std::string& text, const std::string& line)
{
    return ("\n" + text).find("\n" + line + "\n") != std::string::npos;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text = fuzz::text_of(data, size);
    tool::YamlSections sections(text);
    const std::string before = sections.text();
    fuzz::must_hold(before == text || before == text + "\n", "a text comes back as it was");
    try {
        sections.append("looks", { "  - !<Look>", "    name: made" });
        fuzz::must_hold(sections.has("looks"), "what was added to is there");
        const std::string once = sections.text();
        fuzz::must_hold(once.find("- !<Look>") != std::string::npos, "a line was added");
        sections.append("looks", { "  - !<Look>", "    name: again" });
        sections.set("search_path", ".");
        fuzz::must_hold(has_line(sections.text(), "search_path: ."), "a value was set");
        const bool had_such =
            before.find("name: made") != std::string::npos || before.find("name: again") != std::string::npos;
        fuzz::must_hold(had_such || sections.text().find("name: made") < sections.text().find("name: again"),
                        "entries stand in their order");
    } catch (const tool::Failure& failure) {
        fuzz::check_message(valid_utf8(failure.message));
    }
    return 0;
}
