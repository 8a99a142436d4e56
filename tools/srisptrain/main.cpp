// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "../common/failure.h"
#include "train.h"
#include "train/tensors/torch_api.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

void list_settings(const train::TrainingRecipe& recipe)
{
    for (const train::SettingRow& row : recipe_rows(recipe))
        std::printf("%s = %s\n    %s (%s)\n", row.key.c_str(), row.value.c_str(), row.text.c_str(), row.range.c_str());
}

int run(const TrainOptions& options)
{
    if (options.list_recipes) {
        for (const std::string& name : train::recipe_names())
            std::printf("%s\n", name.c_str());
        return 0;
    }
    if (options.list_settings) {
        list_settings(recipe_of(options).recipe);
        return 0;
    }
    if (options.recipe.empty())
        fail_usage("no recipe is given (srisptrain --help shows how; --list-recipes lists the installed ones)");
    train::set_up_process(options.threads);
    Session session = open_session(options);
    if (options.dry_run)
        return rehearse(session, options);
    return session.learns() ? train_model(session, options) : test_only(session, options);
}

} // namespace

int main(int argc, char** argv)
{
    TrainOptions options;
    CLI::App app{ "srisptrain -- trains models that turn photos into RAW-like images", "srisptrain" };
    app.set_version_flag("--version", "srisptrain " SRISP_VERSION);
    describe_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : kExitUsage;
    }
    return run_tool("srisptrain", [&] { return run(options); });
}
