// SPDX-License-Identifier: Apache-2.0
#include "base/progress.h"

#include <doctest/doctest.h>

using namespace srisp;

TEST_CASE("durations are told in seconds below 100 s, then in minutes and hours, and never as nothing")
{
    CHECK(duration_text(0) == "1 s");
    CHECK(duration_text(45.4) == "45 s");
    CHECK(duration_text(99.4) == "99 s");
    CHECK(duration_text(100) == "2 min");
    CHECK(duration_text(3600 + 20 * 60) == "1 h 20 min");
}

TEST_CASE("counted work is told with its rate and the time left, without what an earlier run did")
{
    CHECK(WorkCount{ "srisppack", "images", 3458 }.text(1240, 4) == "srisppack: 1240 of 3458 images, 310/s, 7 s left");
    CHECK(WorkCount{ "fit", "pairs", 100, 80 }.text(90, 2) == "fit: 90 of 100 pairs, 5.0/s, 2 s left");
}
