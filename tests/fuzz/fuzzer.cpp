// SPDX-License-Identifier: Apache-2.0
// libFuzzer's entry: one program for all targets, which it takes from the name that it is called by.
#include <cstdio>
#include <cstdlib>
#include <filesystem>

#include "target_table.h"

namespace {

const srisp::fuzz::Target* chosen = nullptr;

} // namespace

extern "C" int LLVMFuzzerInitialize(int*, char*** arguments)
{
    const std::string name = std::filesystem::path((*arguments)[0]).filename().string();
    for (const auto& target : srisp::fuzz::targets())
        if (target.name == name)
            chosen = &target;
    if (chosen)
        return 0;
    for (const auto& target : srisp::fuzz::targets())
        std::printf("%s\n", target.name.c_str());
    std::exit(name == "fuzz_targets" ? 0 : 2);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    return chosen->run(data, size);
}
