// SPDX-License-Identifier: Apache-2.0
#include "base/json_text.h"

#include <doctest/doctest.h>

#include "base/json_object.h"

using namespace srisp;
using nlohmann::json;
using nlohmann::ordered_json;

namespace {

std::string refused(const std::string& text, std::size_t most = kLargestJson)
{
    const auto parsed = parse_json<json>(text, most);
    return parsed ? "no error" : parsed.error().message;
}

std::string object_refused(const std::string& text)
{
    const auto parsed = parse_json_object(text, "'a.json'", "file");
    return parsed ? "no error" : parsed.error().message;
}

std::string nested(int levels)
{
    return std::string(std::size_t(levels), '[') + std::string(std::size_t(levels), ']');
}

} // namespace

TEST_CASE("JSON comes in as nlohmann's own parser reads it, in both kinds of objects")
{
    const std::string text = R"( {"z": [1, -2, 3.5, true, false, null, "ü\u00e4", {}, []], "a": {"b": {"c": [[0]]}}} )";
    CHECK(*parse_json<json>(text) == json::parse(text));
    CHECK(parse_json<ordered_json>(text)->dump() == ordered_json::parse(text).dump());
    for (const char* value : { "7", "\"x\"", "null", "[]", "18446744073709551615", "-9223372036854775808" })
        CHECK(*parse_json<json>(value) == json::parse(value));
}

TEST_CASE("JSON is refused where it breaks the grammar, is too large, too deep, or says a thing twice")
{
    for (const char* text : { "", "{", "[1,]", "{\"a\":}", "nul", "1 2", "\"\xff\"" })
        CHECK(refused(text) == "not JSON");
    CHECK(refused("[1e999]") == "has a number that is too large");
    CHECK(refused("[1, 2]", 5) == "has 6 bytes of JSON, limit 5");
    CHECK(refused(R"([{"a":1,"b":{"a":2}},{"a":3}])") == "no error");
    CHECK(refused(R"([{"a":1,"b":2,"a":3}])") == "has 'a' twice in one object");
    CHECK(object_refused("{\n \"a\": 3,\n}") == "'a.json': file is not a JSON object (line 3, column 1)");
    CHECK(object_refused("[1]") == "'a.json': file is not a JSON object");
    CHECK(object_refused(R"({"a":1,"a":2})") == "'a.json': 'a' appears twice in the file");
    CHECK(object_refused(R"({"a":1e999})") ==
          "'a.json': file is not a JSON object that can be read (a number is too large)");
}

TEST_CASE("JSON that is nested a hundred thousand times is refused, closed or not")
{
    CHECK(refused(nested(kDeepestJson)) == "no error");
    const std::string deep = "is nested more than 32 levels deep";
    CHECK(refused(nested(kDeepestJson + 1)) == deep);
    CHECK(refused(nested(100000)) == deep);
    CHECK(refused(std::string(100000, '[')) == deep);
    std::string objects;
    for (int i = 0; i < 100000; ++i)
        objects += "{\"a\":";
    CHECK(refused(objects) == deep);
    CHECK(object_refused("{\"a\":" + nested(100000) + "}") == "'a.json': file " + deep);
}

TEST_CASE("a hundred thousand objects in an object, or keys that a reader does not know, take no time")
{
    std::string text = "{";
    for (int i = 0; i < 100000; ++i)
        text += (i ? ",\"unknown_key_" : "\"unknown_key_") + std::to_string(i) + "\":{}";
    text += "}";
    const auto object = parse_json_object(text, "x", "file", text.size());
    REQUIRE(object);
    CHECK(object->size() == 100000);
    JsonObjectReader reader(*object, "x");
    CHECK(reader.take_optional("known") == nullptr);
    CHECK(reader.finish().error().message == "x has an unknown key 'unknown_key_0'; known: known");
}

TEST_CASE("a message shows a value, but not all of a long one")
{
    CHECK(shown_json(json{ 1, "a" }) == "[1,\"a\"]");
    const std::string shown = shown_json(json(std::string(100000, 'x')));
    CHECK(shown.size() < 200);
    CHECK(shown.substr(0, 4) == "\"xxx");
    const json object = { { "n", json::array({ json(std::string(100000, 'x')) }) } };
    JsonObjectReader reader(object, "x");
    reader.take_list("n");
    CHECK(reader.finish().error().message.size() < 200);
}
