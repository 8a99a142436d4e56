// SPDX-License-Identifier: Apache-2.0
#include "recipe/frame_pattern.h"

#include <doctest/doctest.h>

using namespace srisp;
using namespace srisp;

TEST_CASE("the wildcard of a file name becomes printf's, that of a folder stays")
{
    CHECK(frame_pattern_of_file("p.json") == "p.json");
    CHECK(frame_pattern_of_file("p.#.json") == "p.%04d.json");
    CHECK(frame_pattern_of_file("/x/p##") == "/x/p%08d");
    CHECK(frame_pattern_of_file("#") == "%04d");
    CHECK(frame_pattern_of_file("1#.json") == "1%04d.json");
    CHECK(frame_pattern_of_file("/a#b/p.json") == "/a#b/p.json");
    CHECK(frame_pattern_of_file("/a#b/#.json") == "/a#b/%04d.json");
    CHECK(frame_pattern_of_file("me@home.%03d.json") == "me@home.%03d.json");
}

TEST_CASE("the wildcard of an image may be @ and begin with a range")
{
    CHECK(frame_pattern_of_image("s.#.tif") == "s.%04d.tif");
    CHECK(frame_pattern_of_image("s.1-9x2@@@.tif") == "s.%03d.tif");
    CHECK(frame_pattern_of_image("1-3#.tif") == "%04d.tif");
    CHECK(frame_pattern_of_image("/a1/1-3,7#.tif") == "/a1/%04d.tif");
    CHECK(frame_pattern_of_image("/a@b/s.tif") == "/a@b/s.tif");
    CHECK(frame_pattern_of_image("box-x2,1-3#@.tif") == "box-x%05d.tif");
    CHECK(frame_pattern_of_image("s.1-3%03d.tif") == "s.%03d.tif");
}

TEST_CASE("the wildcard of an image is found with its range")
{
    const auto found = [](const std::string& path) {
        const FrameWildcard wildcard = find_frame_wildcard(path);
        return path.substr(wildcard.begin, wildcard.length) + (wildcard.has_range ? " with range" : "");
    };
    CHECK(found("s.#.tif") == "#");
    CHECK(found("/a.1-2#/s2.-3--1x2,7#@.tif") == "-3--1x2,7#@ with range");
    CHECK(found("s.1-2,3x1@.tif") == "1@ with range");
    CHECK(found("s%d.tif") == "%d");
    CHECK(found("100%.tif") == "");
    CHECK(found("/a#/s.tif") == "");
}

TEST_CASE("frame numbers replace # and %d in file names")
{
    CHECK(with_frame("p.####.json", "0007") == "p.0007.json");
    CHECK(with_frame("p.#.json", "0012") == "p.12.json");
    CHECK(with_frame("p%04d.json", "7") == "p0007.json");
    CHECK(with_frame("p%d.json", "0007") == "p7.json");
    CHECK(with_frame("p.####.json", "-3") == "p.-003.json");
    CHECK(with_frame("p.####.json", "0") == "p.0000.json");
    CHECK(with_frame("p.json", "7") == "p.json");
    CHECK(with_frame("p.#.json", "") == "p.#.json");
}

TEST_CASE("names that are nothing but wildcards or digits, however long, are no trouble")
{
    const std::string hashes(1000000, '#'), digits(1000000, '1');
    CHECK(with_frame(hashes, "7").size() == hashes.size());
    CHECK(with_frame(digits + "%d", "7") == digits + "7");
    CHECK(with_frame("%" + digits + "d", "7") == "%" + digits + "d");
    CHECK(find_frame_wildcard(hashes).length == 0);
    CHECK(find_frame_wildcard(digits + "-" + digits).length == 0);
    CHECK(with_frame("a%123d.%00d.%2d", "7") == "a%123d.7.%2d");
    CHECK(with_frame("a%x.%04d", "-7") == "a%x.-007");
}
