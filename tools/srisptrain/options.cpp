// SPDX-License-Identifier: Apache-2.0
#include "options.h"

namespace srisp::tool {

static const char kFooter[] = R"(
A recipe is a JSON file with the settings that differ from the defaults, or from
those of another recipe that it names as its "base". The folder of the output
gets best.safetensors (the model that did best in validation), recipe.json (all
settings), log.csv and log.jsonl, and checkpoint.safetensors. The same command
goes on from a checkpoint, to the bits of a run that never stopped; Ctrl-C and
SIGTERM write one first. A GPU is used where LibTorch has one.

Examples:
  srisptrain default --pack pack --output trained
  srisptrain default --pack pack --dry-run
  srisptrain default --set optimizer.rate=5e-4 --set data.image_size=128
  srisptrain finetune --pack mycamera --init default --output mymodel
  srisptrain default --nodes 2 --rank 0 --address node1:23456

Environment:
  WORLD_SIZE RANK MASTER_ADDR MASTER_PORT   several processes, as torchrun sets
                    them; within a step of Slurm's srun they are not needed
  SRISP_MODEL_PATH  folders with models for --init, separated by colons

Exit codes: 0; 1 where something failed or training diverged, 2 for wrong usage;
128 + N where signal N stopped it.
)";

void describe_options(CLI::App& app, TrainOptions& options)
{
    app.footer(kFooter);
    app.add_option("recipe", options.recipe, "name of an installed recipe, or path of a JSON file");
    app.add_option("--pack", options.pack, "training pack, made by srisppack; default: the recipe's");
    app.add_option("-o,--output", options.output, "folder; default: the recipe's, or named after it");
    app.add_option("--init", options.init, "start from this model: a name or a path");
    app.add_option("--steps", options.steps, "the same as --set steps=N")->check(CLI::Range(1, 100'000'000));
    app.add_option("--set", options.assignments, "key=value, changes a setting; may be repeated")
        ->allow_extra_args(false);
    app.add_flag("--restart", options.restart, "start again, though there is a checkpoint");
    app.add_flag("--dry-run", options.dry_run, "say what would be done, and estimate time and memory from a few steps");
    app.add_flag("--list-settings", options.list_settings, "print the recipe's settings, or the defaults, and end");
    app.add_flag("--list-recipes", options.list_recipes, "print the installed recipes, and end");
    app.add_option("--device", options.device, "default: auto, a GPU if there is one")
        ->check(CLI::IsMember({ "auto", "cpu", "cuda" }));
    app.add_option("--threads", options.threads, "0: as many as there are processors")->check(CLI::Range(0, 1024));
    app.add_option("--nodes", options.nodes, "processes that train one model together")->check(CLI::Range(1, 100'000));
    app.add_option("--rank", options.rank, "which of them this is, from 0; 0 writes the files")
        ->check(CLI::Range(0, 99'999));
    app.add_option("--address", options.address, "host:port of rank 0, where they meet");
    app.add_option("--timeout", options.timeout_s, "seconds that a process waits for another one")
        ->check(CLI::Range(1, 100'000));
    app.add_flag("-q,--quiet", options.quiet, "no progress");
}

} // namespace srisp::tool
