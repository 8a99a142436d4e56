// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/commands.h"

#include <map>
#include <sstream>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Name (without dashes) → number of arguments, from the lines "    --create GEOM NCHANS          Create a blank
/// image".
std::map<std::string, int> commands_in_help()
{
    std::map<std::string, int> commands;
    std::istringstream help(output_of("COLUMNS=1000 oiiotool --help"));
    bool in_list = false;
    for (std::string line; std::getline(help, line);) {
        in_list |= line.rfind("Options (general flags)", 0) == 0;
        if (!in_list || line.rfind("    -", 0) != 0)
            continue;
        std::istringstream words(line.substr(4, line.find("  ", 4) - 4));
        std::string name, argument;
        words >> name;
        int arguments = 0;
        while (words >> argument)
            ++arguments;
        commands[command_name(name)] = arguments;
    }
    return commands;
}

} // namespace

TEST_CASE("every command of the installed oiiotool --help is in the table, with its number of arguments")
{
    const std::map<std::string, int> help = commands_in_help();
    REQUIRE(help.size() > 150);
    for (const auto& [name, arguments] : help) {
        CAPTURE(name);
        const OiiotoolCommand* command = find_oiiotool_command("--" + name);
        REQUIRE(command);
        CHECK(command->arguments == arguments);
    }
}

TEST_CASE("every command of the table that --help does not show is one that the installed oiiotool knows")
{
    const std::map<std::string, int> help = commands_in_help();
    for (const OiiotoolCommand& command : oiiotool_commands()) {
        if (help.count(command.name) || std::string(command.name) == "crash" || std::string(command.name) == "unittest")
            continue;
        CAPTURE(command.name);
        // With too few arguments an option that takes some says so; an unknown one is called invalid.
        const std::string answer = output_of(std::string("oiiotool --") + command.name);
        CHECK(answer.find("Invalid option") == std::string::npos);
        const bool lacks_argument = answer.find("Missing parameter") != std::string::npos;
        CHECK(lacks_argument == (command.arguments > 0));
    }
}

TEST_CASE("commands are found by one dash or two, with or without modifiers")
{
    for (const char* word : { "-resize", "--resize", "--resize:filter=box", "-resize:filter=box" }) {
        const OiiotoolCommand* command = find_oiiotool_command(word);
        REQUIRE(command);
        CHECK(command->name == std::string("resize"));
    }
    CHECK(!find_oiiotool_command("resize"));
    CHECK(!find_oiiotool_command("--resiz"));
    CHECK(!find_oiiotool_command("---resize"));
}

TEST_CASE("a word is a command if a letter follows one or two dashes")
{
    CHECK(is_command("-o"));
    CHECK(is_command("--srisp-unprocess:model=a"));
    for (const char* word : { "", "-", "--", "-5", "--5", "a-b", "---o" })
        CHECK(!is_command(word));
}
