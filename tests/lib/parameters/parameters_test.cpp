// SPDX-License-Identifier: Apache-2.0
#include <srisp/parameters.h>

#include <cmath>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include "random_model.h"

using namespace srisp;
using nlohmann::json;

namespace {

Parameters random_parameters(std::uint64_t seed)
{
    Random random(seed);
    const auto weights = [&] {
        std::vector<float> values(5);
        for (float& value : values)
            value = std::exp(random.uniform(-20, 0));
        return values;
    };
    Parameters p;
    for (std::vector<float>& layer : p.tone_weights)
        layer = weights();
    p.gamma_weights = weights();
    p.color_weights = weights();
    p.white_balance_weights = weights();
    p.gain_weights = weights();
    p.gamma = random.uniform(1, 4);
    p.gain = std::exp(random.uniform(-3, 3));
    p.white_balance = { random.uniform(0.5f, 3), 1, random.uniform(0.5f, 3) };
    p.color = { 1.6f, -0.4f, -0.2f, random.uniform(-0.4f, 0), 1.5f, -0.2f, 0.05f, random.uniform(-0.6f, 0), 1.55f };
    p.model_name = "m";
    p.model_hash = "xxh128:1";
    p.reference_name = "r\xc3\xa9"
                       "f \"1\".dng";
    p.reference_hash = "xxh128:2";
    return p;
}

/// What is said of good parameters after a change of their JSON.
template<class Change> std::string message_after(Change change)
{
    json object = json::parse(to_json(random_parameters(1)));
    change(object);
    Expected<Parameters> parameters = parameters_from_json(object.dump(), "'p.json'");
    return parameters ? "no error" : parameters.error().message;
}

} // namespace

TEST_CASE("parameters come back from JSON to the bit, pretty or in one line")
{
    for (std::uint64_t seed = 0; seed < 500; ++seed)
        for (const int indent : { 2, -1 }) {
            const Parameters p = random_parameters(seed);
            const std::string text = to_json(p, indent);
            CHECK((text.find('\n') == std::string::npos) == (indent < 0));
            Expected<Parameters> back = parameters_from_json(text, "test");
            REQUIRE_MESSAGE(back, (back ? "" : back.error().message));
            CHECK(back->tone_weights == p.tone_weights);
            CHECK(back->gamma_weights == p.gamma_weights);
            CHECK(back->color_weights == p.color_weights);
            CHECK(back->white_balance_weights == p.white_balance_weights);
            CHECK(back->gain_weights == p.gain_weights);
            CHECK(back->gamma == p.gamma);
            CHECK(back->gain == p.gain);
            CHECK(back->white_balance == p.white_balance);
            CHECK(back->color == p.color);
            CHECK(back->model_name == p.model_name);
            CHECK(back->model_hash == p.model_hash);
            CHECK(back->reference_name == p.reference_name);
            CHECK(back->reference_hash == p.reference_hash);
        }
}

TEST_CASE("the pretty form has one line per value, for people who edit it")
{
    const std::string text = to_json(random_parameters(1));
    CHECK(text.find("\n  \"gain\": ") != std::string::npos);
    CHECK(text.find("\n  \"white_balance\": [") != std::string::npos);
    CHECK(text.find("\n    \"tone\": [[") != std::string::npos);
}

TEST_CASE("parameters without weights are JSON, too")
{
    CHECK(json::parse(to_json(Parameters()))["weights"]["gain"] == json::array());
    REQUIRE(parameters_from_json(to_json(Parameters()), "test"));
}

TEST_CASE("a line that srisptool printed is parameters, too")
{
    const std::string text = to_json(random_parameters(1), -1);
    const auto printed = parameters_from_json("{\"image\": \"a b.jpg\", " + text.substr(1), "test");
    REQUIRE_MESSAGE(printed, printed.error().message);
    CHECK(to_json(*printed, -1) == text);
    CHECK(message_after([](json& o) { o["image"] = 1; }) == "parameters in 'p.json' 'image' must be a string");
}

TEST_CASE("an edited gain and white balance win as written")
{
    json object = json::parse(to_json(random_parameters(1)));
    object["gain"] = 2;
    object["white_balance"] = { 1.5, 1, 2.5 };
    Expected<Parameters> p = parameters_from_json(object.dump(), "test");
    REQUIRE(p);
    CHECK(p->gain == 2.0f);
    CHECK(p->white_balance == std::array<float, 3>{ 1.5f, 1, 2.5f });
}

TEST_CASE("broken parameters are refused, each with its own message")
{
    const std::string what = "parameters in 'p.json'";
    const auto parsed = [](const std::string& text) {
        Expected<Parameters> p = parameters_from_json(text, "'p.json'");
        return p ? "no error" : p.error().message;
    };
    CHECK(parsed("{") == what + ": not JSON");
    CHECK(parsed("[]") == what + " is not a JSON object");
    CHECK(message_after([](json& o) { o["gian"] = 1; }) == what + " has an unknown key 'gian'; did you mean 'gain'?");
    CHECK(message_after([](json& o) { o.erase("gamma"); }) == what + " has no 'gamma'");
    CHECK(message_after([](json& o) { o["format"] = "x"; }) == what + " have format 'x', must be 'srisp-parameters-1'");
    CHECK(message_after([](json& o) { o["gain"] = -1; }) == what + ": 'gain' has -1, must be finite and > 0");
    CHECK(message_after([](json& o) { o["gain"] = 1e300; }) == what + " 'gain' must hold finite numbers, has 1e+300");
    CHECK(message_after([](json& o) { o["gain"] = "2"; }) == what + " 'gain' must hold finite numbers, has \"2\"");
    CHECK(message_after([](json& o) {
              o["white_balance"] = { 1, 2 };
          }) == what + " 'white_balance' must have 3 numbers, has 2");
    CHECK(message_after([](json& o) {
              o["color"] = { { 1, 2, 3 }, { 2, 4, 6 }, { 1, 1, 1 } };
          }) == what + ": 'color' is singular (determinant 0)");
    CHECK(message_after([](json& o) { o["color"] = { 1, 2 }; }) == what + " 'color' must be a list of 3 lists");
    CHECK(message_after([](json& o) { o["weights"]["tone"] = { 1 }; }) ==
          what + " is refused: " + what + ": 'weights' 'tone' must be a list of 4 lists");
    CHECK(message_after([](json& o) { o["model"] = "default"; }) ==
          what + " 'model' must be an object with name and hash");
}

TEST_CASE("parameters that a stranger has nested, filled or swollen are refused in a short message")
{
    const auto refused = [](const std::string& text) {
        const auto parameters = parameters_from_json(text, "'p.json'");
        return parameters ? "no error" : parameters.error().message;
    };
    const std::string what = "parameters in 'p.json': ", deep = std::string(100000, '[') + std::string(100000, ']');
    CHECK(refused(deep) == what + "is nested more than 32 levels deep");
    CHECK(refused("{\"gain\":" + deep + "}") == what + "is nested more than 32 levels deep");
    CHECK(refused("{\"gain\":1,\"gain\":2}") == what + "has 'gain' twice in one object");
    CHECK(refused("[\"" + std::string(2000000, 'x') + "\"]") == what + "has 2000004 bytes of JSON, limit 1048576");
    json object = json::parse(to_json(random_parameters(1)));
    object["gain"] = std::string(100000, 'x');
    CHECK(refused(object.dump()).size() < 300);
    object["format"] = std::string(100000, 'x');
    CHECK(refused(object.dump()).size() < 300);
    object = json::parse(to_json(random_parameters(1)));
    for (int i = 0; i < 50000; ++i)
        object["k" + std::to_string(i)] = 0;
    CHECK(refused(object.dump()).find("unknown key 'k0'") != std::string::npos);
}

TEST_CASE("how unsure the brightness is, and by how much it was changed, come back from JSON; older ones lack both")
{
    Parameters p = random_parameters(3);
    CHECK(to_json(p).find("brightness") == std::string::npos);
    p.brightness_sd_ev = 0.7390625f;
    p.brightness_ev = -1.1f;
    for (const int indent : { 2, -1 }) {
        const auto read = parameters_from_json(to_json(p, indent), "'p.json'");
        REQUIRE(read);
        CHECK(read->brightness_sd_ev == p.brightness_sd_ev);
        CHECK(read->brightness_ev == p.brightness_ev);
    }
    CHECK(json::parse(to_json(p, -1)).at("brightness_sd_ev").get<float>() == p.brightness_sd_ev);
    const auto older = parameters_from_json(to_json(random_parameters(3)), "'p.json'");
    REQUIRE(older);
    CHECK(!older->brightness_sd_ev);
    CHECK(older->brightness_ev == 0);
}

TEST_CASE("an impossible deviation of the brightness is refused")
{
    CHECK(message_after([](json& object) { object["brightness_sd_ev"] = -0.5; }) ==
          "parameters in 'p.json': 'brightness_sd_ev' has -0.5, must be 0 to 20");
    CHECK(message_after([](json& object) { object["brightness_sd_ev"] = 21; }) ==
          "parameters in 'p.json': 'brightness_sd_ev' has 21, must be 0 to 20");
    CHECK(message_after([](json& object) {
              object["brightness_sd_ev"] = "x";
          }).find("parameters in 'p.json' 'brightness_sd_ev' must hold finite numbers") == 0);
    CHECK(message_after([](json& object) {
              object["brightness_ev"] = nullptr;
          }).find("parameters in 'p.json' 'brightness_ev' must hold finite numbers") == 0);
}
