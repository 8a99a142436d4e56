// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace srisp::fuzz {

/// One file of targets/.
struct Target {
    std::string name;
    int (*run)(const std::uint8_t* data, std::size_t size);
};

const std::vector<Target>& targets();

} // namespace srisp::fuzz
