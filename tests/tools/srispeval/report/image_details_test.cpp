// SPDX-License-Identifier: Apache-2.0
#include "../../../../tools/srispeval/report/image_details.h"

#include <doctest/doctest.h>

using namespace srisp::tool;

TEST_CASE("parameters are laid out with lists on one line and few digits")
{
    CHECK(readable_parameters(R"({"gain":0.123456789,"color":[[1,2],[3,4]],"name":"x","none":{}})") ==
          "{\n  \"gain\": 0.12346,\n  \"color\": [\n    [1, 2],\n    [3, 4]\n  ],\n  \"name\": \"x\",\n  \"none\": "
          "{}\n}");
    CHECK(readable_parameters("not JSON <b>") == "not JSON <b>");
    CHECK(readable_parameters("[]") == "[]");
    const std::string deep = std::string(100000, '[');
    CHECK(readable_parameters(deep) == deep);
}

TEST_CASE("the heaviest weights are named, heaviest first")
{
    const std::string text =
        weights_html(R"({"weights":{"tone":[[0.1,0.9],[1,0]],"gain":[0.002,0.998],"<b>":[1],"odd":"x"}})");
    CHECK(text.find(">tone 1</th><td>90 % of no. 1, 10 % of no. 0<") != std::string::npos);
    CHECK(text.find(">tone 2</th><td>100 % of no. 0<") != std::string::npos);
    CHECK(text.find(">gain</th><td>100 % of no. 1<") != std::string::npos);
    CHECK(text.find("<b>") == std::string::npos);
    CHECK(text.find("odd") == std::string::npos);
    for (const char* other : { "", "3", "{}", R"({"weights": 3})", R"({"weights": {"tone": []}})" })
        CHECK(weights_html(other) == "");
}
