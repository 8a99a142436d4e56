// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <algorithm>

#include "base/near_names.h"

#include "../common/failure.h"

namespace srisp::tool {

const std::vector<SrispCommand>& srisp_commands()
{
    static const std::vector<SrispCommand> commands = {
        { "srisp-unprocess", "REF", kUnprocess, Effect::replaces, "reverse", "apply",
          "Turn the photo on top of the stack into the linear image that the camera of REF would have recorded" },
        { "srisp-process", nullptr, kProcess, Effect::replaces, "forward", "apply",
          "Turn a RAW-like image into a photo again, by the parameters recorded in it" },
        { "srisp-params", "REF", kParams, Effect::reports, "reverse", "print",
          "Print the parameters that --srisp-unprocess would choose, as JSON on stdout, one line per image; the image "
          "stays as it is" },
        { "srisp-save-params", "FILE", kNoDoor, Effect::reports, "reverse", "save",
          "Write the parameters recorded in the image to FILE; # or %04d in its name is the frame number" },
        { "srisp-help", nullptr, kNoDoor, Effect::helps, "", "", "Print this" },
        { "quiet", nullptr, kNoDoor, Effect::configures, "", "", "No notes and no progress; the same as -q" },
        { "no-progress", nullptr, kNoDoor, Effect::configures, "", "", "No progress on the terminal" },
    };
    return commands;
}

const SrispCommand* find_srisp_command(const std::string& word)
{
    const std::string name = command_name(word);
    std::vector<std::string> known;
    for (const SrispCommand& command : srisp_commands()) {
        if (name == command.name)
            return &command;
        if (command.effect != Effect::configures)
            known.push_back(std::string("--") + command.name);
    }
    if (name.rfind("srisp", 0) == 0)
        fail_usage("unknown command '" + word + "'" + near_names("--" + name, known));
    return nullptr;
}

namespace {

/// Takes the value that begins at `position`, and moves `position` behind it.
std::string take_value(const std::string& word, std::size_t& position)
{
    const char quote = position < word.size() ? word[position] : '\0';
    std::string value;
    if (quote != '"' && quote != '\'') {
        const std::size_t end = std::min(word.find(':', position), word.size());
        value = word.substr(position, end - position);
        position = end;
        return value;
    }
    for (++position; position < word.size() && word[position] != quote; ++position) {
        if (word[position] == '\\' && position + 1 < word.size() &&
            (word[position + 1] == quote || word[position + 1] == '\\'))
            ++position;
        value += word[position];
    }
    if (position == word.size())
        fail_usage("'" + word + "': the quote " + quote + " is not closed");
    ++position;
    if (position < word.size() && word[position] != ':')
        fail_usage("'" + word + "': expected ':' after the closing quote");
    return value;
}

} // namespace

Modifiers parse_modifiers(const std::string& word)
{
    Modifiers modifiers;
    std::size_t position = std::min(word.find(':'), word.size());
    while (position < word.size()) {
        const std::size_t start = position + 1;
        const std::size_t end = word.find_first_of(":=", start);
        const std::string name = word.substr(start, end - start);
        if (end == std::string::npos || word[end] == ':' || name.empty())
            fail_usage("'" + word + "': expected name=value at '" + name +
                       "' (a value that holds ':' needs quotes that the shell leaves: 'params=\"a:b.json\"')");
        position = end + 1;
        std::string value = take_value(word, position);
        if (value.empty())
            fail_usage("'" + word + "': " + name + "= has no value");
        modifiers.emplace_back(name, value);
    }
    return modifiers;
}

bool has_modifier(const std::string& word, const std::string& name)
{
    return word.find(":" + name + "=") != std::string::npos;
}

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
