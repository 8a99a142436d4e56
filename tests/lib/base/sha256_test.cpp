// SPDX-License-Identifier: Apache-2.0
#include "base/sha256.h"

#include <doctest/doctest.h>

using namespace srisp;

// FIPS 180-4's examples; `printf %s abc | sha256sum`, and so on.
TEST_CASE("SHA-256 is what sha256sum prints, with the processor's instructions and without")
{
    const auto is = [](const std::string& text, const std::string& hash) {
        CHECK(sha256_of_bytes(text.data(), text.size()) == hash);
        CHECK(sha256_of_bytes_plain(text.data(), text.size()) == hash);
    };
    is("", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    is("abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    is("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    is(std::string(1000000, 'a'), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("SHA-256 is the same in both ways at every length to three blocks")
{
    std::string text;
    for (int length = 0; length <= 192; ++length, text += char(length * 37 + 11))
        CHECK(sha256_of_bytes(text.data(), text.size()) == sha256_of_bytes_plain(text.data(), text.size()));
}
