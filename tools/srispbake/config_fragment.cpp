// SPDX-License-Identifier: Apache-2.0
#include "config_fragment.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <OpenColorIO/OpenColorIO.h>

#include "../common/failure.h"
#include "base/device_output.h"
#include "base/file_bytes.h"
#include "base/installed_files.h"
#include "base/output_file.h"
#include "base/shown_reason.h"
#include "config_text.h"
#include "linear_srgb.h"

namespace srisp::tool {

namespace OCIO = OCIO_NAMESPACE;
namespace fs = std::filesystem;

namespace {

constexpr std::size_t kLargestConfig = 64 << 20;
const char kVariable[] = "SRISP_REFERENCE", kNeutral[] = "srisp_neutral";

std::string read_text(const std::string& path, const std::string& what)
{
    auto text = read_head(path, kLargestConfig);
    if (!text)
        fail(what + " '" + path + "': " + text.error().message);
    if (text->size() == kLargestConfig)
        fail(what + " '" + path + "': has too many bytes, the limit is " + std::to_string(kLargestConfig - 1));
    return *text;
}

OCIO::ConstConfigRcPtr config_of(const std::string& text, const std::string& path)
{
    std::istringstream stream(text);
    const auto config = OCIO::Config::CreateFromStream(stream)->createEditableCopy();
    config->setWorkingDir(fs::absolute(path).parent_path().c_str());
    return config;
}

std::string serialized(const OCIO::ConstConfigRcPtr& config)
{
    std::ostringstream stream;
    config->serialize(stream);
    return stream.str();
}

bool has_look(const OCIO::ConstConfigRcPtr& config, const std::string& name)
{
    return config->getLook(name.c_str()) != nullptr;
}

/// Whether all that is added is there; fails where a part is, or something else has the name.
bool is_extended(const OCIO::ConstConfigRcPtr& config)
{
    std::size_t there = 0;
    std::string first;
    const auto count = [&](bool found, const std::string& name) {
        there += found;
        first = found && first.empty() ? name : first;
    };
    for (const std::string& name : kAddedLooks)
        count(has_look(config, name), name);
    for (const auto* names : { &kAddedColorSpaces, &kAddedAliases })
        for (const std::string& name : *names)
            count(config->getColorSpace(name.c_str()) != nullptr, name);
    if (there != 0 && there != kAddedLooks.size() + kAddedColorSpaces.size() + kAddedAliases.size())
        fail("it has a look or colour space '" + first +
             "' already, but not all that would be added; rename or remove it");
    return there != 0;
}

/// Those that the config does not declare.
std::vector<AddedVariable> new_variables(const OCIO::ConstConfigRcPtr& config)
{
    std::vector<AddedVariable> variables = kAddedVariables;
    for (int i = 0; i < config->getNumEnvironmentVars(); ++i) {
        const std::string declared = config->getEnvironmentVarNameByIndex(i);
        variables.erase(std::remove_if(variables.begin(), variables.end(),
                                       [&](const AddedVariable& each) { return each.name == declared; }),
                        variables.end());
    }
    return variables;
}

bool has_search_path(const OCIO::ConstConfigRcPtr& config)
{
    return *config->getSearchPath() != '\0';
}

std::string extended_text(const std::string& text, const OCIO::ConstConfigRcPtr& config, const LinearSrgb& linear)
{
    YamlSections sections(text);
    const ConfigEntries entries = config_entries(linear.to_reference);
    // Where there is no such section, the host loads all variables by itself; with one, it would load no others any
    // more.
    if (sections.has("environment"))
        for (const AddedVariable& variable : new_variables(config))
            sections.append("environment", { variable.line() });
    if (!has_search_path(config)) // built-in configs; with files, OpenColorIO takes no config for valid that has none
        sections.set("search_path", ".");
    sections.append("looks", entries.looks);
    sections.append("colorspaces", entries.colorspaces);
    return sections.text();
}

/// The config without what was changed in it, in OpenColorIO's own words.
std::string without_additions(const OCIO::ConstConfigRcPtr& extended, const OCIO::ConstConfigRcPtr& original)
{
    auto config = extended->createEditableCopy();
    for (const std::string& name : kAddedColorSpaces)
        config->removeColorSpace(name.c_str());
    std::vector<OCIO::ConstLookRcPtr> looks;
    for (int i = 0; i < config->getNumLooks(); ++i) {
        const auto look = config->getLook(config->getLookNameByIndex(i));
        if (std::find(kAddedLooks.begin(), kAddedLooks.end(), look->getName()) == kAddedLooks.end())
            looks.push_back(look);
    }
    config->clearLooks();
    for (const auto& look : looks)
        config->addLook(look);
    for (const AddedVariable& variable : new_variables(original))
        config->addEnvironmentVar(variable.name.c_str(), nullptr);
    config->setSearchPath(original->getSearchPath());
    return serialized(config);
}

/// Loads, validates, disturbs nothing, and gives processors with the neutral bakes.
void check_extended(const OCIO::ConstConfigRcPtr& extended, const OCIO::ConstConfigRcPtr& original)
{
    const auto with_variable = extended->createEditableCopy();
    with_variable->addEnvironmentVar(kVariable, kNeutral); // where there is no environment section, the user sets it
    with_variable->validate();
    if (extended->getEnvironmentMode() != original->getEnvironmentMode() ||
        without_additions(extended, original) != serialized(original))
        fail("what was there would not stay as it is; nothing is written (add the entries of srisp.ocio by hand)");
    const auto context = extended->getCurrentContext()->createEditableCopy();
    context->setStringVar(kVariable, kNeutral);
    for (const char* name :
         { "srisp camera RGB", "srisp process", "srisp scene linear", "srisp ACEScg", "srisp photo" })
        extended->getProcessor(context, "srisp sRGB", name);
    for (const std::string& name : kAddedLooks) {
        auto look = OCIO::LookTransform::Create();
        look->setSrc("srisp sRGB");
        look->setDst("srisp sRGB");
        look->setLooks(name.c_str());
        extended->getProcessor(context, look, OCIO::TRANSFORM_DIR_FORWARD);
    }
}

/// The first folder of the search path without variables in it; the config's own where there is no search path.
fs::path neutral_folder(const OCIO::ConstConfigRcPtr& config, const std::string& config_path)
{
    const fs::path own = fs::absolute(config_path).parent_path();
    for (int i = 0; i < config->getNumSearchPaths(); ++i) {
        const std::string folder = config->getSearchPath(i);
        if (folder.find_first_of("$%") == std::string::npos)
            return (own / folder).lexically_normal();
    }
    if (has_search_path(config))
        fail("its search path has variables only, so there is no folder for the neutral bakes");
    return own;
}

/// Neutral bakes that were put where they are found; they and folders that were made for them are removed where what
/// follows fails.
class NeutralBakes {
public:
    void put_into(const fs::path& folder)
    {
        for (const char* end : { ".unprocess.clf", ".process.clf", ".develop.clf" }) {
            const std::string name = kNeutral + std::string(end);
            const std::string text = read_text((shared_folder("ocio") / name).string(), "our own file");
            std::error_code error;
            if (fs::exists(folder / name, error))
                continue;
            make_folder(folder);
            if (const Status status = write_output_file((folder / name).string(), text); !status)
                fail("neutral bake " + status.error().message);
            m_made.push_back(folder / name);
        }
    }
    /// Leaves what others put into the folders meanwhile.
    ~NeutralBakes()
    {
        std::error_code error;
        for (auto path = m_made.rbegin(); path != m_made.rend(); ++path)
            fs::remove(*path, error);
    }
    void keep() { m_made.clear(); }

private:
    void make_folder(const fs::path& folder)
    {
        std::error_code error;
        if (fs::is_directory(folder, error))
            return;
        if (folder.has_relative_path())
            make_folder(folder.parent_path());
        if (fs::create_directory(folder, error))
            m_made.push_back(folder);
        if (error)
            fail("folder '" + folder.string() + "' for the neutral bakes cannot be made: " + error.message());
    }

    std::vector<fs::path> m_made;
};

/// Before anything is made for it.
void check_output_folder(const std::string& output)
{
    const fs::path folder = fs::absolute(output).parent_path();
    std::error_code error;
    if (!fs::is_directory(folder, error))
        fail("output '" + output + "' cannot be created: the folder '" + folder.string() + "' does not exist");
}

FragmentReport add_checked(const std::string& path, const std::string& output, const std::string& linear_srgb)
{
    const std::string text = read_text(path, "config");
    check_output_folder(output);
    // The folder that paths in it are relative to; a device lies in none.
    const std::string place = is_device_output(output) ? path : output;
    const OCIO::ConstConfigRcPtr original = config_of(text, place);
    if (original->getMajorVersion() < 2)
        fail("has profile version 1; aliases, file rules and exact sRGB curves need version 2 (ocio_profile_version: "
             "2)");
    if (is_extended(original))
        return { "", "", "", true };
    const LinearSrgb linear = find_linear_srgb(original, linear_srgb);
    const std::string extended = extended_text(text, original, linear);
    const fs::path folder = neutral_folder(original, place);
    NeutralBakes bakes;
    bakes.put_into(folder);
    check_extended(config_of(extended, place), original);
    if (const Status status = write_output_file(output, extended); !status)
        fail(status.error().message);
    bakes.keep();
    return { output, folder.string(), linear.found_by, YamlSections(text).has("environment"),
             has_search_path(original) };
}

} // namespace

FragmentReport add_fragment(const std::string& path, const std::string& output, const std::string& linear_srgb)
{
    const std::string where = "config '" + path + "': ";
    try {
        return add_checked(path, output.empty() ? path : output, linear_srgb);
    } catch (const Failure& failure) {
        const bool named = failure.message.rfind("config '", 0) == 0;
        throw Failure{ failure.exit_code, named ? failure.message : where + failure.message };
    } catch (const OCIO::Exception& error) {
        fail(where + shown_reason(error.what()));
    }
}

std::string fragment_text(const FragmentReport& report)
{
    if (report.config.empty())
        return "The config has srisp's looks and colour spaces already.\n";
    std::string text = report.config +
                       ": looks 'srisp unprocess' and 'srisp process', colour spaces 'srisp photo', 'srisp camera "
                       "RGB' and five more\n  linear sRGB: " +
                       report.linear_srgb + "\n  neutral bakes: " + report.neutral_folder + "\n";
    if (!report.search_path)
        text += "  Its search path was empty, and is '.' now: its own folder.\n";
    if (!report.environment_section)
        text +=
            "  It has no environment section, so none was made: always set SRISP_REFERENCE (srisp_neutral: none).\n";
    return text;
}

} // namespace srisp::tool
