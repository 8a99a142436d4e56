// SPDX-License-Identifier: Apache-2.0
#include "session.h"

#include <cstdlib>

#include <torch/cuda.h>

#include "../common/failure.h"
#include "base/json_text.h"
#include "model/model_files.h"
#include "output_folder.h"
#include "train/run/model_file.h"
#include "train/samples/sample_maker.h"
#include "train/tensors/torch_api.h"

namespace srisp::tool {

using namespace train;

namespace {

torch::Device device_of(const std::string& name)
{
    const bool available = torch::cuda::is_available();
    if (name == "cuda" && !available)
        fail("--device cuda: LibTorch finds no GPU here");
    return name == "cpu" || !available ? torch::kCPU : torch::kCUDA;
}

Membership membership_of(const TrainOptions& options)
{
    const Expected<Membership> membership =
        find_membership({ options.nodes, options.rank, options.address, options.timeout_s }, std::getenv);
    if (!membership)
        fail_usage(membership.error().message);
    return *membership;
}

/// "'model.kernel_size' is 1 there, 3 here"; "" where models of both kinds have the same parameters.
std::string kind_difference(const ModelSettings& there, const ModelSettings& here)
{
    const auto values = [](ModelSettings settings) {
        settings = settings.resolved();
        SettingsWriter writer;
        settings.describe(writer);
        return writer.object();
    };
    const auto old_values = values(there), new_values = values(here);
    std::string text;
    for (const auto& [key, value] : new_values.items())
        if (old_values[key] != value && (key != "unet_channels" || here.method == "unet"))
            text += (text.empty() ? "'model." : ", 'model.") + key + "' is " + shown_json(old_values[key]) +
                    " there, " + shown_json(value) + " here";
    return text;
}

void start_from(Unprocessor& model, const ModelSettings& settings, const std::string& name)
{
    const LoadedModel loaded = require(load_model(require(find_model_file(name))));
    if (const std::string difference = kind_difference(loaded.settings, settings); !difference.empty())
        fail("--init " + name + " is another kind of model than the recipe's: " + difference);
    const torch::NoGradGuard no_gradient;
    const auto values = loaded.model->named_parameters();
    for (const auto& item : model.named_parameters())
        item.value().copy_(values[item.key()]);
}

} // namespace

std::shared_ptr<Unprocessor> Session::another() const
{
    auto other = make_unprocessor(settings().model, static_cast<std::uint64_t>(settings().seed));
    other->to(device);
    return other;
}

LoadedRecipe recipe_of(const TrainOptions& options)
{
    LoadedRecipe loaded;
    if (!options.recipe.empty()) {
        Expected<LoadedRecipe> found = load_recipe(options.recipe, options.assignments);
        if (!found && found.error().message.rfind("--set", 0) == 0)
            fail_usage(found.error().message);
        loaded = require(std::move(found));
    }
    TrainingRecipe& recipe = loaded.recipe;
    if (!options.pack.empty())
        recipe.pack = options.pack;
    if (!options.init.empty())
        recipe.init = options.init;
    if (options.steps > 0)
        recipe.trainer.steps = options.steps;
    if (!options.output.empty() || recipe.output.empty())
        recipe.output = options.output.empty() ? loaded.name : options.output;
    return loaded;
}

Session open_session(const TrainOptions& options)
{
    Session session;
    session.recipe = recipe_of(options);
    const TrainingRecipe& recipe = session.settings();
    const Membership membership = membership_of(options);
    refuse_inputs_as_outputs(session.recipe);
    for (const auto& [count, name] :
         { std::pair(recipe.trainer.pairs, "pairs"), std::pair(recipe.trainer.unpaired, "unpaired") })
        if (count > 0 && count < membership.size)
            fail(std::string("'") + name + "' is " + std::to_string(count) + ", less than one for each of the " +
                 std::to_string(membership.size) + " processes");
    session.device = device_of(options.device);
    session.pack = require(TrainingPack::open(recipe.pack));
    session.samples =
        require(make_samples(recipe.data, session.pack, static_cast<std::uint64_t>(recipe.seed), session.device));
    if (recipe.trainer.first_taught_step() < recipe.trainer.steps && !session.samples->has_unpaired())
        fail("unpaired samples need photos, and the pack has none for training");
    session.model = session.another();
    if (!recipe.init.empty())
        start_from(*session.model, recipe.model, recipe.init);
    if (membership.rank == 0) {
        Expected<std::shared_ptr<const EvaluationSet>> tests =
            EvaluationSet::make(recipe.validation.set, *session.pack);
        if (tests)
            session.tests = *tests;
        else
            session.tests_missing = tests.error().message;
    }
    session.group = require(ProcessGroup::join(membership));
    require(session.group->check_same(recipe_text(recipe) + session.pack->hash(), "recipe and pack"));
    return session;
}

} // namespace srisp::tool
