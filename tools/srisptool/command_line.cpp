// SPDX-License-Identifier: Apache-2.0
#include "command_line.h"

#include <algorithm>

#include "../common/failure.h"

namespace srisp::tool {

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

bool is_for_images(const Step& step)
{
    return step.srisp && (step.srisp->effect == Effect::replaces || step.srisp->effect == Effect::reports);
}

std::string name_read_by(const Step& step)
{
    const bool reads = step.oiiotool && step.oiiotool->role == Role::reads && step.words.size() == 2;
    return step.is_operand() || reads ? step.words.back() : "";
}

std::size_t end_of_reading(const std::vector<Step>& steps)
{
    std::size_t end = 0;
    for (std::size_t i = 0; i < steps.size(); ++i)
        if (is_for_images(steps[i]) || (end > 0 && (steps[i].is_named("endfor") || steps[i].is_named("endwhile"))))
            end = i + 1;
    return end;
}

} // namespace srisp::tool
