// SPDX-License-Identifier: Apache-2.0
#include "output_folder.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "../common/failure.h"
#include "anchor_start.h"
#include "base/input_file.h"
#include "base/input_files.h"
#include "model/model_files.h"

namespace srisp::tool {

using namespace train;
namespace fs = std::filesystem;

OutputFolder::OutputFolder(const std::string& path) : m_path(path)
{
    std::error_code error;
    fs::create_directories(path, error);
    m_lock = open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (m_lock < 0)
        fail("cannot make the folder '" + path + "': " + (error ? error.message() : std::strerror(errno)));
    // Some network file systems cannot lock; there nobody is kept out.
    if (flock(m_lock, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK)
        fail("another training is writing to '" + path + "'; give this one its own --output");
}

OutputFolder::~OutputFolder()
{
    close(m_lock);
}

void OutputFolder::clear()
{
    for (const char* name : { kCheckpointFile, kBestFile, kRecipeFile, kCsvLog, kJsonLog })
        remove(name);
}

void OutputFolder::remove(const std::string& name)
{
    std::error_code error;
    fs::remove(file(name), error);
    if (error)
        fail("cannot remove '" + file(name) + "': " + error.message());
}

static bool holds(const std::string& path, const std::string& text)
{
    const auto there = read_text_file(path, text.size());
    return there && *there == text;
}

void refuse_inputs_as_outputs(const LoadedRecipe& loaded)
{
    const TrainingRecipe& recipe = loaded.recipe;
    InputFiles inputs;
    for (const std::string& file : loaded.files)
        inputs.add("recipe", file);
    for (const std::string& model : { recipe.init, recipe.anchor_fit.from })
        if (const auto file = find_model_file(model))
            inputs.add("model", *file);
    std::error_code error;
    for (fs::directory_iterator entry(recipe.pack, error), end; !error && entry != end; entry.increment(error))
        inputs.add("file of the pack", entry->path().string());
    for (const char* name : { kCheckpointFile, kBestFile, kRecipeFile, kCsvLog, kJsonLog, kAnchorPairsFile }) {
        const std::string output = recipe.output + "/" + name;
        if (name != kRecipeFile || !holds(output, recipe_text(recipe)))
            require(inputs.check_output(output));
    }
}

std::map<std::string, std::string> origin_of(const TrainingRecipe& recipe, const std::string& pack_hash)
{
    return { { "recipe", recipe_text(recipe) }, { "pack", pack_hash } };
}

std::optional<TrainingState> find_checkpoint(const std::string& path, const TrainingRecipe& recipe,
                                             const std::string& pack_hash)
{
    std::error_code error;
    if (!fs::exists(path, error))
        return {};
    Expected<TrainingState> state = load_checkpoint(path);
    const std::string advice = "; --restart starts again, --output NAME keeps both";
    if (!state)
        fail(state.error().message + advice);
    std::string difference = recipe_difference(state->texts["recipe"], recipe);
    if (state->texts["pack"] != pack_hash)
        difference += (difference.empty() ? "" : "; ") +
                      ("the pack is " + state->texts["pack"] + " there, " + pack_hash + " here");
    if (!difference.empty())
        fail("'" + path + "' is of another training: " + difference + advice);
    return std::move(*state);
}

} // namespace srisp::tool
