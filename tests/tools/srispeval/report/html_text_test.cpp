// SPDX-License-Identifier: Apache-2.0
#include "../../../../tools/srispeval/report/html_text.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "../../../../tools/srispeval/report/base64.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("text of strangers cannot leave its place in HTML")
{
    CHECK(html("<script>alert(1)</script>") == "&lt;script&gt;alert(1)&lt;/script&gt;");
    CHECK(html("a\" onload='x' & b") == "a&quot; onload=&#39;x&#39; &amp; b");
    CHECK(html("Größe, 日本") == "Größe, 日本");
}

TEST_CASE("bytes that are no UTF-8 and control characters are shown as numbers")
{
    CHECK(html("caf\xe9") == "caf\\xe9");
    CHECK(html("\xed\xa0\x80") == "\\xed\\xa0\\x80"); // a surrogate
    CHECK(html(std::string_view("a\0b\x1b\x7f", 5)) == "a\\x00b\\x1b\\x7f");
    CHECK(html("a\n\tb") == "a\n\tb");
}

TEST_CASE("numbers have a real minus sign, and none where they are 0")
{
    CHECK(number(-1.2, 2) == "−1.20");
    CHECK(number(-0.001, 2) == "0.00");
    CHECK(number(31.416, 1) == "31.4");
    CHECK(number(std::numeric_limits<double>::quiet_NaN(), 2) == "–");
    CHECK(number(std::numeric_limits<double>::infinity(), 2) == "–");
    CHECK(number(1e300, 2).size() < 10);
    CHECK(signed_number(5.6, 1) == "+5.6");
    CHECK(signed_number(-5.6, 1) == "−5.6");
    CHECK(signed_number(0.001, 1) == "0.0");
}

TEST_CASE("an interval around 0 is noise, one without ends is nothing")
{
    const double none = std::numeric_limits<double>::quiet_NaN();
    CHECK(is_within_noise({ 0.1, -0.1, 0.3 }));
    CHECK(is_within_noise({ 0.1, 0, 0.3 }));
    CHECK_FALSE(is_within_noise({ 0.2, 0.1, 0.3 }));
    CHECK_FALSE(is_within_noise({ none, none, none }));
    CHECK(signed_range_text({ 0.1, -0.1, 0.3 }, 1) == "−0.1 to +0.3");
    CHECK(range_text({ 1, none, none }, 1) == "");
}

TEST_CASE("base64 is that of RFC 4648, however long the bytes are")
{
    const auto base64 = [](const std::string& bytes) {
        MemorySink sink;
        write_base64(sink, bytes);
        return sink.bytes();
    };
    CHECK(base64("") == "");
    CHECK(base64("f") == "Zg==");
    CHECK(base64("fo") == "Zm8=");
    CHECK(base64("foo") == "Zm9v");
    CHECK(base64("foobar") == "Zm9vYmFy");
    CHECK(base64("\xff\xfe\xfd") == "//79");
    const std::string many = base64(std::string(100000, 'M'));
    CHECK(many.size() == 133336);
    CHECK(many.find('=') == many.size() - 2);
    CHECK(many.substr(0, 133332).find_first_not_of("TU1N") == std::string::npos);
}
