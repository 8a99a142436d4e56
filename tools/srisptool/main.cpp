// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "../common/failure.h"
#include "../common/image_limits_option.h"
#include "command_line.h"
#include "help.h"
#include "output_depth.h"
#include "stock_oiiotool.h"

using namespace srisp;
using namespace srisp::tool;

static int run(const std::string& program, const std::vector<std::string>& words)
{
    const std::vector<Step> steps = parse_command_line(words);
    for (const Step& step : steps)
        if (step.is_named("max-megapixels"))
            set_max_megapixels(step.words.back());
    if (contains(steps, "srisp-help")) {
        std::fputs(help_text().c_str(), stdout);
        return 0;
    }
    if (words.empty() || contains(steps, "help")) {
        std::fputs(help_text().c_str(), stdout);
        std::fputs("\n", stdout);
    } else if (contains(steps, "version") && program == "srisptool") {
        std::puts("srisptool " SRISP_VERSION ", with oiiotool");
    }
    std::fflush(stdout);
    const auto is_rewritten = [](const Step& step) { return is_for_images(step) || writes_dng(step); };
    if (std::none_of(steps.begin(), steps.end(), is_rewritten))
        run_unchanged(steps);
    return run_rewritten(program, steps);
}

int main(int argc, char** argv)
{
    return run_tool("srisptool", [&] {
        return run(std::filesystem::path(argv[0]).filename(), { argv + 1, argv + argc });
    });
}
