// SPDX-License-Identifier: Apache-2.0
// JSON, as our reader and as nlohmann's own take it, and its way through the writer.
#include "base/json_text.h"

#include "fuzz_target.h"

using namespace srisp;
using nlohmann::json;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text = fuzz::text_of(data, size);
    fuzz::is_accepted(parse_json_object(text, "file", "header"));
    const auto ordered = parse_json<nlohmann::ordered_json>(text);
    const auto read = parse_json<json>(text);
    fuzz::must_hold(bool(ordered) == bool(read), "both kinds of object are read alike");
    if (!fuzz::is_accepted(read)) {
        // Theirs takes more: what is nested deeply, or has a key twice.
        fuzz::must_hold(read.error().message != kNotJson || !json::accept(text), "what is JSON is not called none");
        return 0;
    }
    fuzz::must_hold(json::accept(text), "what is no JSON is not accepted");
    fuzz::must_hold(*read == json::parse(text), "values are those of nlohmann's reader");
    const auto again = parse_json<json>(read->dump());
    fuzz::must_hold(again && *again == *read, "what was written is read", read->dump());
    const std::string shown = shown_json(*read);
    fuzz::must_hold(shown.size() <= kLongestShown + 3 && valid_utf8(shown) == shown, "a value is shown shortly", shown);
    return 0;
}
