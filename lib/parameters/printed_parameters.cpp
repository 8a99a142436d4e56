// SPDX-License-Identifier: Apache-2.0
#include "parameters/printed_parameters.h"

#include <nlohmann/json.hpp>

namespace srisp {

std::string without_image_name(const std::string& text)
{
    nlohmann::json printed = nlohmann::json::parse(text, nullptr, false);
    return printed.is_object() && printed.erase("image") > 0 ? printed.dump() : text;
}

} // namespace srisp
