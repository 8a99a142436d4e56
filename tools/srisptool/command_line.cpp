// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <algorithm>

#include "../common/failure.h"

namespace srisp::tool {

std::vector<Step> parse_command_line(const std::vector<std::string>& words)
{
    std::vector<Step> steps;
    for (std::size_t i = 0; i < words.size(); ++i) {
        Step step;
        step.words = { words[i] };
        std::size_t arguments = 0;
        if (is_command(words[i])) {
            step.srisp = find_srisp_command(words[i]);
            step.oiiotool = step.srisp ? nullptr : find_oiiotool_command(words[i]);
            arguments = step.srisp ? (step.srisp->argument ? 1 : 0) : step.oiiotool ? step.oiiotool->arguments : 0;
        }
        for (; arguments > 0 && i + 1 < words.size(); --arguments)
            step.words.push_back(words[++i]);
        if (step.srisp && arguments > 0)
            fail_usage(step.words[0] + " needs an argument: " + step.srisp->argument);
        steps.push_back(step);
    }
    return steps;
}

bool contains(const std::vector<Step>& steps, const std::string& name)
{
    return std::any_of(steps.begin(), steps.end(), [&](const Step& step) { return step.is_named(name); });
}

} // namespace srisp::tool
