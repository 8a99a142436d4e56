// SPDX-License-Identifier: Apache-2.0
#include "image_limits_option.h"

#include <cstdlib>

#include "base/parsed_number.h"
#include "base/shown_text.h"
#include "failure.h"

namespace srisp::tool {

void describe_image_limits(CLI::App& app)
{
    app.add_option_function<std::string>("--max-megapixels", set_max_megapixels);
}

void set_max_megapixels(const std::string& text)
{
    constexpr int kMost = 1'000'000;
    const auto number = parsed_number<int>(text);
    if (!number || *number < 1 || *number > kMost)
        fail_usage("--max-megapixels '" + shown_text(text) + "' is not a whole number from 1 to 1000000");
    ::setenv("SRISP_MAX_MEGAPIXELS", text.c_str(), 1);
}

} // namespace srisp::tool
