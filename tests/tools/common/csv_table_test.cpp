// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/common/csv_table.h"

#include <doctest/doctest.h>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp::tool;

TEST_CASE("a table of too many columns is refused")
{
    const ScratchFolder folder;
    const auto table = [&](int columns) {
        std::string text = "c0";
        for (int i = 1; i < columns; ++i)
            text += ",c" + std::to_string(i);
        return folder.file("a.csv", text + "\n");
    };
    CHECK(read_csv(table(10000)).columns.size() == 10000);
    const std::string path = table(10001);
    CHECK(failure_of([&] { read_csv(path); }) == "1: '" + path + "': has 10001 columns, limit 10000");
}
