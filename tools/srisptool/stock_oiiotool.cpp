// SPDX-License-Identifier: Apache-2.0
#include "stock_oiiotool.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "base/progress.h"

#include "../common/failure.h"
#include "../common/own_location.h"
#include "../common/shell_quote.h"
#include "../common/temporary_folder.h"
#include "child_process.h"
#include "line_files.h"
#include "messages.h"
#include "output_guard.h"
#include "rewriter.h"

extern char** environ;

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kGuardLink[] = "guard.so";

/// What outputs record as the command that made them; as with oiiotool, --nosoftwareattrib asks for nothing, and
/// --sansattrib for less.
std::string recorded_command(const std::string& program, const std::vector<Step>& steps)
{
    if (contains(steps, "nosoftwareattrib"))
        return "";
    const bool without_attributes = contains(steps, "sansattrib");
    std::vector<std::string> words = { program };
    for (const Step& step : steps) {
        const bool attribute = step.is_named("attrib") || step.is_named("sattrib") || step.is_named("oiioattrib");
        if (!(without_attributes && (attribute || step.is_named("sansattrib"))))
            words.insert(words.end(), step.words.begin(), step.words.end());
    }
    return shell_line(words);
}

/// JSON is UTF-8, file names are any bytes.
std::string json_text(const nlohmann::json& content)
{
    try {
        return content.dump(2) + "\n";
    } catch (const nlohmann::json::exception&) {
        nlohmann::json without_command = content;
        if (without_command.erase("command") > 0)
            return json_text(without_command);
        fail("a file name is not valid UTF-8, job files cannot hold it: " +
             content.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
    }
}

void write_file(const fs::path& path, const std::string& text)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file)
        fail("cannot write '" + path.string() + "': " + std::strerror(errno) + " (TMPDIR may name another folder)");
}

/// A name that the user made by an expression of an image's name, such as {TOP.filename}, may lie in our folder, where
/// it would be lost without a word.
void refuse_lost_outputs(const fs::path& folder, const Rewritten& rewritten)
{
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        const bool ours = name == kGuardLink || name == kStartedOutputs || entry.path().extension() == ".srisp" ||
                          entry.path().extension() == ".json" || rewritten.notes.count(name) > 0;
        if (!ours)
            fail("output '" + entry.path().string() +
                 "' was lost: after one of our commands {TOP.filename} is a temporary "
                 "name; write the output's name out");
    }
}

/// Where oiiotool writes its messages.
int error_stream(const std::vector<Step>& steps)
{
    return contains(steps, "nostderr") ? STDOUT_FILENO : STDERR_FILENO;
}

void write_all(int stream, std::string_view text)
{
    while (!text.empty()) {
        const ssize_t written = write(stream, text.data(), text.size());
        if (written < 0 && errno != EINTR)
            return; // nobody is there to be told
        text.remove_prefix(std::size_t(std::max<ssize_t>(written, 0)));
    }
}

int run_with_own_messages(HeldSignals& signals, const Rewritten& rewritten, const fs::path& folder,
                          const std::vector<std::string>& environment, int stream)
{
    int lines = 1;
    for (const std::string& word : rewritten.words)
        lines += static_cast<int>(std::count(word.begin(), word.end(), '\n'));
    Messages messages(folder.string(), rewritten.subjects, lines);
    const Listener listener{ stream, [&](std::string_view bytes) { write_all(stream, messages.take(bytes)); } };
    const int exit_code = signals.run(rewritten.words, environment, listener);
    write_all(stream, messages.finish());
    return exit_code;
}

} // namespace

bool is_srisptool(const fs::path& program)
{
    std::error_code error;
    // The installed names are told apart too, or two installations on PATH would call each other for ever.
    const fs::path file = fs::canonical(program, error);
    return fs::equivalent(program, own_executable(), error) || file.filename() == "srisptool" ||
           (file.filename() == "oiiotool" && file.parent_path().filename() == "srisp");
}

fs::path find_stock_oiiotool()
{
    const char* const chosen = std::getenv("SRISP_OIIOTOOL");
    if (chosen && *chosen) {
        if (access(chosen, X_OK) != 0)
            fail("SRISP_OIIOTOOL: '" + std::string(chosen) + "' is not a program that can be run");
        if (is_srisptool(chosen))
            fail("SRISP_OIIOTOOL: '" + std::string(chosen) + "' is srisptool itself, not the stock oiiotool");
        return chosen;
    }
    const char* const variable = std::getenv("PATH");
    std::istringstream folders(variable ? variable : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');) {
        const fs::path program = fs::path(folder.empty() ? "." : folder) / "oiiotool";
        std::error_code error;
        if (fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0 && !is_srisptool(program))
            return program;
    }
    fail("no stock oiiotool on PATH (Debian: openimageio-tools); SRISP_OIIOTOOL may name one");
}

void set_variable(std::vector<std::string>& environment, const std::string& name, const std::string& value, bool joined)
{
    for (std::string& entry : environment) {
        if (entry.rfind(name + "=", 0) != 0)
            continue;
        const std::string old = entry.substr(name.size() + 1);
        entry = name + "=" + value + (joined && !old.empty() ? ":" + old : "");
        return;
    }
    environment.push_back(name + "=" + value);
}

std::vector<std::string> environment_with_plugin(const fs::path& plugin_folder)
{
    std::vector<std::string> environment;
    for (char** entry = environ; *entry; ++entry)
        environment.push_back(*entry);
    set_variable(environment, "OIIO_LIBRARY_PATH", plugin_folder.string(), true);
    set_variable(environment, "OPENIMAGEIO_PLUGIN_PATH", plugin_folder.string(), true); // its name since 2.5
    return environment;
}

void run_unchanged(const std::vector<Step>& steps)
{
    std::vector<std::string> words = { find_stock_oiiotool().string() };
    for (const Step& step : steps) {
        if (!step.srisp)
            words.insert(words.end(), step.words.begin(), step.words.end());
        else if (step.is_named("quiet"))
            words.push_back("-q");
    }
    restore_file_limit_signal(); // without the guard oiiotool would take a file that is cut off for complete
    become(words, environment_with_plugin(plugin_folder()));
}

int run_rewritten(const std::string& program, const std::vector<Step>& steps)
{
    const fs::path stock = find_stock_oiiotool();
    const fs::path plugins = plugin_folder();
    HeldSignals signals;
    const TemporaryFolder folder;

    RewriteOptions options;
    options.folder = folder.path().string();
    options.typed_command = recorded_command(program, steps);
    options.allow_partial = contains(steps, "allow-partial");
    options.notes = !contains(steps, "quiet") && !contains(steps, "q");
    options.progress = options.notes && isatty(STDERR_FILENO) && !contains(steps, "no-progress");
    Rewritten rewritten = rewrite(steps, options);
    refuse_inputs_as_outputs(steps);
    for (const std::string& warning : rewritten.warnings)
        std::fprintf(stderr, "srisptool: WARNING: %s\n", warning.c_str());
    for (const JobFile& file : rewritten.files)
        write_file(folder.path() / file.name, json_text(file.content));

    std::vector<std::string> environment = environment_with_plugin(plugins);
    // Debian's OpenImageIO tells of every tag of a RAW file that it does not know.
    if (!std::getenv("OPENIMAGEIO_DEBUG"))
        set_variable(environment, "OPENIMAGEIO_DEBUG", "0");
    // Large images in small pages cost more to get from the system than what oiiotool does to them.
    set_variable(environment, "GLIBC_TUNABLES", "glibc.malloc.hugetlb=1", true);
    // Through a link, since LD_PRELOAD cannot name a path with spaces or colons.
    fs::create_symlink(plugins / "output_guard.so", folder.path() / kGuardLink);
    set_variable(environment, "LD_PRELOAD", (folder.path() / kGuardLink).string(), true);
    set_variable(environment, kGuardListVariable, (folder.path() / kStartedOutputs).string());
    set_variable(environment, kGuardStreamVariable, std::to_string(error_stream(steps)));
    // Where the plugin shows its progress: its stderr is a pipe.
    if (options.progress)
        set_variable(environment, kTerminalVariable, std::to_string(dup(STDERR_FILENO)));
    rewritten.words.insert(rewritten.words.begin(), stock.string());
    const int exit_code = run_with_own_messages(signals, rewritten, folder.path(), environment, error_stream(steps));
    for (const auto& [mark, note] : rewritten.notes)
        if (fs::exists(folder.path() / mark))
            std::fprintf(stderr, "srisptool: note: %s\n", note.c_str());
    if (exit_code == 0)
        refuse_lost_outputs(folder.path(), rewritten);
    return exit_code;
}

} // namespace srisp::tool
