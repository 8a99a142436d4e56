// SPDX-License-Identifier: Apache-2.0
#include "base/shown_text.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("a text for a message is one line of UTF-8, cut between two characters")
{
    CHECK(shown_text("grün 日本 😀") == "grün 日本 😀");
    CHECK(shown_text("") == "");
    CHECK(shown_text("a\nb\x7f\x01") == "a\\x0ab\\x7f\\x01");
    CHECK(shown_text("a\xff\xe4 b") == "a\\xff\\xe4 b");
    CHECK(shown_text("日本", 5) == "日…");
    CHECK(shown_text("日本", 6) == "日本");
    CHECK(shown_text("ab\n", 5) == "ab…");
    CHECK(shown_text(std::string(1000000, 'x')).size() == kLongestShown + 3);
}

TEST_CASE("bytes that are no UTF-8 are escaped, all else stays")
{
    CHECK(valid_utf8("line\n'grün' 😀") == "line\n'grün' 😀");
    CHECK(valid_utf8("gr\xfcn.jpg") == "gr\\xfcn.jpg");
    CHECK(valid_utf8("\xc3") == "\\xc3");                            // cut
    CHECK(valid_utf8("\xe6\x97x") == "\\xe6\\x97x");                 // cut, then another
    CHECK(valid_utf8("\xc0\xaf") == "\\xc0\\xaf");                   // longer than it needs to be
    CHECK(valid_utf8("\xed\xa0\x80") == "\\xed\\xa0\\x80");          // a surrogate
    CHECK(valid_utf8("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80"); // above U+10FFFF
    CHECK(valid_utf8("\xf8\x88\x80\x80\x80") == "\\xf8\\x88\\x80\\x80\\x80");
}

TEST_CASE("characters are counted, not bytes")
{
    CHECK(first_characters("%ü日x", 3) == "%ü日");
    CHECK(first_characters("%ü", 3) == "%ü");
    CHECK(first_characters("%\xff\xfe\xfd", 2) == "%\xff");
    CHECK(first_characters("", 3).empty());
}

TEST_CASE("numbers have as many digits as are asked for")
{
    CHECK(shown_number(1.23456789) == "1.23457");
    CHECK(shown_number(1e-7, 3) == "1e-07");
    CHECK(shown_number(double(0.1f), 9) == "0.100000001");
    CHECK(shown_number(-250) == "-250");
    CHECK(shown_decimals(1.005, 1) == "1.0");
    CHECK(shown_decimals(-1e300, 2).size() == 1 + 301 + 3);
}
