// SPDX-License-Identifier: Apache-2.0
#include "srisp_command.h"

#include "base/near_names.h"

#include "../common/failure.h"
#include "command_table.h"

namespace srisp::tool {

static const std::vector<SrispCommand>& srisp_commands()
{
    static const std::vector<SrispCommand> commands = {
        { "srisp-unprocess",
          "REF",
          { "model", "params", "input", "precision", "hold", "seed" },
          Effect::replaces,
          "reverse",
          "apply" },
        { "srisp-process", nullptr, { "params", "model", "precision" }, Effect::replaces, "forward", "apply" },
        { "srisp-params", "REF", { "model", "input", "seed" }, Effect::reports, "reverse", "print" },
        { "srisp-save-params", "FILE", {}, Effect::reports, "reverse", "save" },
        { "srisp-help", nullptr, {}, Effect::helps, "", "" },
        { "quiet", nullptr, {}, Effect::configures, "", "" },
        { "no-progress", nullptr, {}, Effect::configures, "", "" },
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

} // namespace srisp::tool
