// SPDX-License-Identifier: Apache-2.0
// Settings of a training recipe: the reader that all of them go through, with settings of each type.
#include "base/json_text.h"
#include "fuzz_target.h"
#include "train/settings/settings.h"

using namespace srisp;

namespace {

struct Inner {
    int steps = 3;
    double low = 0.2, high = 0.5;
    template<class Visitor> void describe(Visitor& v)
    {
        v.integer("steps", steps, 1, 1000, "steps");
        v.range("range", low, high, 0, 1, "a range");
    }
};

struct Outer {
    double rate = 0.1;
    bool flag = false;
    std::string target = "raw", init;
    Inner inner;
    template<class Visitor> void describe(Visitor& v)
    {
        v.number("rate", rate, 1e-6, 1, "a rate");
        v.flag("flag", flag, "a flag");
        v.choice("target", target, { "raw", "rgb" }, "a choice");
        v.path("init", init, "a path");
        v.group("inner", inner);
    }
    nlohmann::json written()
    {
        train::SettingsWriter writer;
        describe(writer);
        return writer.object();
    }
};

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string text = fuzz::text_of(data, size);
    fuzz::is_accepted(train::parse_assignment(text));
    const auto object = parse_json_object(text, "recipe", "text");
    if (!fuzz::is_accepted(object))
        return 0;
    Outer settings;
    train::SettingsReader reader(*object, "recipe 'a.json'");
    settings.describe(reader);
    if (!fuzz::is_accepted(reader.finish()))
        return 0;
    fuzz::must_hold(settings.rate >= 1e-6 && settings.rate <= 1 && settings.inner.steps >= 1 &&
                        settings.inner.low <= settings.inner.high,
                    "settings lie within their limits");
    Outer again;
    train::SettingsReader rereader(settings.written(), "recipe 'a.json'");
    again.describe(rereader);
    fuzz::must_hold(bool(rereader.finish()), "what was written can be read");
    fuzz::must_hold(again.written() == settings.written(), "settings come back as they were");
    return 0;
}
