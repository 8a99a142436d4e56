// SPDX-License-Identifier: Apache-2.0
#include "train/settings/settings.h"

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp::train;
using nlohmann::json;

namespace {

struct Inner {
    double rate = 0.5;
    std::string kind = "slow";
    double low = 1, high = 2;
    template<class Visitor> void describe(Visitor& v)
    {
        v.number("rate", rate, 0, 1, "how fast");
        v.choice("kind", kind, { "slow", "fast" }, "which");
        v.range("span", low, high, 0, 10, "from where to where");
    }
};

struct Outer {
    int count = 3;
    bool on = false;
    std::string file;
    Inner inner;
    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("count", count, 1, 9, "how many");
        v.flag("on", on, "whether");
        v.path("file", file, "where");
        v.group("inner", inner);
    }
};

/// The message that reading gives; "" if it succeeds.
std::string read(Outer& settings, const json& object)
{
    SettingsReader reader(object, "recipe 'r'");
    settings.describe(reader);
    return reader.finish().error().message;
}

std::string read(const std::string& text)
{
    Outer settings;
    return read(settings, json::parse(text));
}

} // namespace

TEST_CASE("settings are read from an object, and what it does not name keeps its value")
{
    Outer settings;
    CHECK(read(settings, json::parse(R"({"count":4,"on":true,"file":"a b","inner":{"span":[0,3],"kind":"fast"}})")) ==
          "");
    CHECK(settings.count == 4);
    CHECK(settings.on);
    CHECK(settings.file == "a b");
    CHECK(settings.inner.kind == "fast");
    CHECK(settings.inner.low == 0);
    CHECK(settings.inner.high == 3);
    CHECK(settings.inner.rate == 0.5);
}

TEST_CASE("impossible settings are refused, each with its own message")
{
    CHECK(read(R"({"cuont":4})") == "recipe 'r': unknown setting 'cuont'; did you mean 'count'?");
    CHECK(read(R"({"inner":{"rat":0.1}})").find("recipe 'r': unknown setting 'inner.rat'; did you mean 'inner.rate'") ==
          0);
    CHECK(read(R"({"inner":1})").find("recipe 'r': unknown setting 'inner'") == 0);
    CHECK(read(R"({"count":0})") == "recipe 'r': 'count' must be a whole number from 1 to 9, has 0");
    CHECK(read(R"({"count":2.5})") == "recipe 'r': 'count' must be a whole number from 1 to 9, has 2.5");
    CHECK(read(R"({"count":"4"})") == "recipe 'r': 'count' must be a whole number from 1 to 9, has \"4\"");
    CHECK(read(R"({"on":1})") == "recipe 'r': 'on' must be true or false, has 1");
    CHECK(read(R"({"file":1})") == "recipe 'r': 'file' must be a string, has 1");
    CHECK(read(R"({"inner":{"rate":1.5}})") == "recipe 'r': 'inner.rate' must be a number from 0 to 1, has 1.5");
    CHECK(read(R"({"inner":{"rate":null}})") == "recipe 'r': 'inner.rate' must be a number from 0 to 1, has null");
    CHECK(read(R"({"inner":{"kind":"fats"}})") ==
          "recipe 'r': 'inner.kind' has an unknown value \"fats\"; did you mean 'fast'?");
    for (const char* span : { "[2,1]", "[1]", "[1,2,3]", "[-1,2]", "[1,11]", "3", "[\"1\",2]", "[]" })
        CHECK(read(std::string(R"({"inner":{"span":)") + span + "}}") ==
              std::string("recipe 'r': 'inner.span' must be two numbers, the lower one first, from 0 to 10, has ") +
                  span);
}

TEST_CASE("what is written reads back to the same values")
{
    Outer settings, again;
    settings.count = 7;
    settings.file = "x \"y\"";
    settings.inner.rate = 0.1;
    settings.inner.high = 10.0 / 3;
    SettingsWriter writer;
    settings.describe(writer);
    CHECK(read(again, json::parse(writer.object().dump())) == "");
    CHECK(again.count == 7);
    CHECK(again.file == "x \"y\"");
    CHECK(again.inner.rate == 0.1);
    CHECK(again.inner.high == 10.0 / 3);
}

TEST_CASE("the list of settings has key, value, range and text of each")
{
    Outer settings;
    SettingsLister lister;
    settings.describe(lister);
    std::string keys;
    for (const SettingRow& row : lister.rows())
        keys += row.key + " ";
    CHECK(keys == "count on file inner.rate inner.kind inner.span ");
    CHECK(lister.rows()[0].value == "3");
    CHECK(lister.rows()[0].range == "1 to 9");
    CHECK(lister.rows()[3].text == "how fast");
    CHECK(lister.rows()[4].range == "slow, fast");
    CHECK(lister.rows()[5].value == "[1, 2]");
}

TEST_CASE("assignments on the command line become settings of their type")
{
    const auto set = [](const std::string& assignment) {
        const Expected<json> value = parse_assignment(assignment);
        return value ? value->dump() : value.error().message;
    };
    CHECK(set("count=4") == R"({"count":4})");
    CHECK(set("on=true") == R"({"on":true})");
    CHECK(set("inner.rate=1e-3") == R"({"inner.rate":0.001})");
    CHECK(set("inner.span=1,2.5") == R"({"inner.span":[1,2.5]})");
    CHECK(set("inner.span=[1,2]") == R"({"inner.span":[1,2]})");
    CHECK(set("file=a/b=c.json") == R"({"file":"a/b=c.json"})");
    CHECK(set("file=") == R"({"file":""})");
    CHECK(set("=3") == "--set =3: expected key=value");
    CHECK(set("count") == "--set count: expected key=value");
}
