// SPDX-License-Identifier: Apache-2.0
#include "recipe/noise_source.h"

#include <doctest/doctest.h>

using namespace srisp;

namespace {

std::string error_of(const std::string& text)
{
    const auto source = parse_noise_source(text);
    return source ? "" : source.error().message;
}

} // namespace

TEST_CASE("noise comes from the reference, an ISO, figures, or UPI's line")
{
    CHECK(parse_noise_source("reference")->kind == NoiseSource::Kind::reference);
    CHECK(parse_noise_source("upi")->kind == NoiseSource::Kind::upi);
    CHECK(parse_noise_source("iso=1250")->iso == 1250);
    const NoiseSource one = *parse_noise_source("read=1e-5,shot=0.01");
    CHECK(one.kind == NoiseSource::Kind::figures);
    CHECK(one.shot == std::array<double, 3>{ 0.01, 0.01, 0.01 });
    CHECK(one.read == std::array<double, 3>{ 1e-5, 1e-5, 1e-5 });
    const NoiseSource three = *parse_noise_source("shot=0.01,0.02,0.03,read=0");
    CHECK(three.shot == std::array<double, 3>{ 0.01, 0.02, 0.03 });
}

TEST_CASE("other texts are refused, each with what is wrong")
{
    CHECK(error_of("refrence") == "noise 'refrence': noise comes from reference, iso=N, shot=S,read=R or upi");
    CHECK(error_of("") != "");
    for (const char* iso : { "iso=", "iso=0", "iso=-100", "iso=nan", "iso=1e300", "iso=800x" }) {
        INFO(iso);
        CHECK(error_of(iso).find("the ISO is a number above 0") != std::string::npos);
    }
    CHECK(error_of("shot=0.01") == "noise 'shot=0.01': shot= and read= need one figure each, or three for R, G, B");
    CHECK(error_of("shot=1,2,read=0").find("is not in [0,1]") != std::string::npos);
    CHECK(error_of("shot=0.1,0.2,read=0").find("need one figure each") != std::string::npos);
    CHECK(error_of("shot=nan,read=0").find("'nan' is not a number") != std::string::npos);
    CHECK(error_of("shot=0.01,read=0,shot=0.02").find("shot= is said twice") != std::string::npos);
    CHECK(error_of("shot=0.01,gain=2").find("'gain=2' is not a number") != std::string::npos);
    CHECK(error_of("shot=0.01,,read=0").find("'' is not a number") != std::string::npos);
}
