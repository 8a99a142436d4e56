// SPDX-License-Identifier: Apache-2.0
#include "train/run/training_run.h"

#include <filesystem>
#include <fstream>

#include <doctest/doctest.h>

#include "lib/train/toy_training.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::train;
namespace fs = std::filesystem;

namespace {

/// Scores as told, and remembers what happened.
class ToyHost : public RunHost {
public:
    std::optional<Validation> validate(Unprocessor&, const StillThere&) override
    {
        if (scores.empty())
            return {};
        Validation result;
        result.score = result.psnr = scores[std::min(m_validations++, scores.size() - 1)];
        result.angle = 5;
        return result;
    }
    Status save_model(Unprocessor&, const std::string& path, const std::optional<Validation>&,
                      std::int64_t step) override
    {
        if (fails)
            return Error{ "'" + path + "': disk full" };
        saved += std::to_string(step) + " ";
        return {};
    }
    void progress(const RunProgress& progress) override { last = progress; }
    void note(const std::string& line) override { notes += line + "\n"; }

    std::vector<double> scores;
    bool fails = false;
    std::string saved, notes;
    RunProgress last;

private:
    std::size_t m_validations = 0;
};

RunSettings quick()
{
    RunSettings settings;
    settings.validate_every = 4;
    settings.log_every = 2;
    settings.checkpoint_minutes = 1000;
    return settings;
}

/// A whole run of the toy in a folder.
struct ToyRun {
    ToyRun(const std::string& output, const RunSettings& settings, int steps,
           std::shared_ptr<Samples> samples = std::make_shared<ToySamples>())
        : trainer(toy_trainer(toy_settings(steps), group, std::move(samples))), folder(output),
          run(trainer, group, settings, steps, { { "recipe", "{}" } }, output, host)
    {
        const Expected<TrainingState> state = load_checkpoint(checkpoint());
        if (state)
            REQUIRE(run.resume(*state));
    }
    std::string checkpoint() const { return folder + "/" + kCheckpointFile; }
    /// "finished", "stopped", "diverged", or the message.
    std::string go(std::int64_t stop_at = -1)
    {
        const Expected<RunEnd> end = run.go([&] { return trainer.steps_done() + 1 == stop_at; });
        if (!end)
            return end.error().message;
        return *end == RunEnd::finished ? "finished" : *end == RunEnd::stopped ? "stopped" : "diverged";
    }

    ProcessGroup group;
    ToyHost host;
    Trainer trainer;
    std::string folder;
    TrainingRun run;
};

std::vector<std::string> lines_of(const std::string& path)
{
    std::vector<std::string> lines;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);)
        lines.push_back(line);
    return lines;
}

} // namespace

TEST_CASE("a run that was stopped goes on to the bits of one that was not")
{
    const ScratchFolder whole, parts;
    CHECK(ToyRun(whole.path(), quick(), 6).go() == "finished");
    CHECK(ToyRun(parts.path(), quick(), 6).go(3) == "stopped");
    CHECK(load_checkpoint(parts.path(kCheckpointFile))->numbers.at("step") == 3);
    CHECK(ToyRun(parts.path(), quick(), 6).go() == "finished");
    const Expected<TrainingState> expected = load_checkpoint(whole.path(kCheckpointFile));
    const Expected<TrainingState> resumed = load_checkpoint(parts.path(kCheckpointFile));
    REQUIRE(expected);
    REQUIRE(resumed);
    CHECK(expected->tensors.size() == 5);
    for (const auto& [name, tensor] : expected->tensors) {
        CAPTURE(name);
        CHECK(torch::equal(tensor, resumed->tensors.at(name)));
    }
    for (const char* name : { "step", "best_score", "best_step", "smoothed_loss", "lowest_loss" }) {
        CAPTURE(name);
        CHECK(expected->numbers.at(name) == resumed->numbers.at(name));
    }
}

TEST_CASE("a run that was killed repeats the steps after its checkpoint, in its log, too")
{
    const ScratchFolder scratch;
    CHECK(ToyRun(scratch.path(), quick(), 12).go(5) == "stopped");
    const std::string checkpoint = scratch.path(kCheckpointFile), kept = scratch.path("kept");
    fs::copy_file(checkpoint, kept);
    CHECK(ToyRun(scratch.path(), quick(), 12).go(9) == "stopped");
    fs::rename(kept, checkpoint);
    std::ofstream(scratch.path("log.csv"), std::ios::app) << "10,0."; // cut off by the kill
    CHECK(ToyRun(scratch.path(), quick(), 12).go() == "finished");
    std::string steps;
    for (const std::string& line : lines_of(scratch.path("log.csv")))
        steps += line.substr(0, line.find(',')) + " ";
    CHECK(steps == "step 2 4 6 8 10 12 ");
    for (const std::string& line : lines_of(scratch.path("log.jsonl"))) {
        CAPTURE(line);
        CHECK(nlohmann::json::parse(line).contains("step"));
    }
}

TEST_CASE("the model that scores best is kept")
{
    const ScratchFolder scratch;
    ToyRun run(scratch.path(), quick(), 16);
    run.host.scores = { 30, 32, 31, 31.5 };
    CHECK(run.go() == "finished");
    CHECK(run.host.saved == "4 8 ");
    CHECK(run.host.last.last_validation->psnr == 31.5);
    CHECK(load_checkpoint(run.checkpoint())->numbers.at("best_step") == 8);
    CHECK(lines_of(scratch.path("log.csv"))[2].find(",30.0,30.0,5.0") != std::string::npos);
}

TEST_CASE("a run that starts from a finished model keeps that if no step makes it better, after a stop, too")
{
    const ScratchFolder scratch;
    RunSettings settings = quick();
    settings.validate_first = true;
    ToyRun run(scratch.path(), settings, 8);
    run.host.scores = { 32, 31 };
    CHECK(run.go(5) == "stopped");
    CHECK(run.host.saved == "0 ");
    ToyRun again(scratch.path(), settings, 8);
    again.host.scores = { 31.5 };
    CHECK(again.go() == "finished");
    CHECK(again.host.saved == "");
    CHECK(load_checkpoint(again.checkpoint())->numbers.at("best_step") == 0);
}

TEST_CASE("without a validation the last model is kept")
{
    const ScratchFolder scratch;
    ToyRun run(scratch.path(), quick(), 9);
    CHECK(run.go() == "finished");
    CHECK(run.host.saved == "9 ");
}

TEST_CASE("a loss that is not a number ends the run with the last good state in the checkpoint")
{
    const ScratchFolder scratch;
    ToyRun run(scratch.path(), quick(), 12, std::make_shared<ToySamples>(6));
    run.host.scores = { 30 };
    CHECK(run.go() == "diverged");
    CHECK(run.host.notes.find("the loss or its gradient at step 6 is not a number; training has stopped\n") == 0);
    CHECK(run.host.notes.find("holds the state before it, " + run.folder + "/" + kBestFile +
                              " the best model, of step 4.") != std::string::npos);
    const Expected<TrainingState> state = load_checkpoint(run.checkpoint());
    REQUIRE(state);
    CHECK(state->numbers.at("step") == 6);
    CHECK(state->tensors.at("weights").isfinite().all().item<bool>());
}

TEST_CASE("a loss that explodes ends the run and leaves the checkpoint before")
{
    const ScratchFolder scratch;
    CHECK(ToyRun(scratch.path(), quick(), 12).go(4) == "stopped");
    ToyRun run(scratch.path(), quick(), 12, std::make_shared<ToySamples>(6, 1e12f));
    CHECK(run.go() == "diverged");
    CHECK(run.host.notes.find("the loss explodes: smoothed ") == 0);
    CHECK(run.host.notes.find("is from before") != std::string::npos);
    CHECK(load_checkpoint(run.checkpoint())->numbers.at("step") == 4);
}

TEST_CASE("a checkpoint that cannot be written leaves the one before, and the run goes on")
{
    const ScratchFolder scratch;
    RunSettings settings = quick();
    settings.checkpoint_minutes = 0;
    ToyRun run(scratch.path(), settings, 8);
    // Nothing can be renamed onto a folder that holds something.
    fs::create_directories(run.checkpoint() + "/x");
    const std::string end = run.go();
    CHECK(end.find("the last checkpoint could not be written: '" + run.checkpoint() + "'") == 0);
    CHECK(run.trainer.steps_done() == 8);
    CHECK(run.host.notes.find("warning: no checkpoint: ") == 0);
    CHECK(run.host.notes.find('\n') == run.host.notes.size() - 1); // once
}

TEST_CASE("checkpoints that can be written again are said to be")
{
    const ScratchFolder scratch;
    RunSettings settings = quick();
    settings.checkpoint_minutes = 0;
    ToyRun run(scratch.path(), settings, 8);
    fs::create_directories(run.checkpoint() + "/x");
    const Expected<RunEnd> end = run.run.go([&] {
        if (run.trainer.steps_done() == 4)
            fs::remove_all(run.checkpoint());
        return false;
    });
    REQUIRE(end);
    CHECK(run.host.notes.find("checkpoints can be written again\n") != std::string::npos);
    CHECK(load_checkpoint(run.checkpoint())->numbers.at("step") == 8);
}

TEST_CASE("a best model that cannot be saved is a warning, and an error at the end")
{
    const ScratchFolder scratch;
    ToyRun run(scratch.path(), quick(), 8);
    run.host.scores = { 30 };
    run.host.fails = true;
    CHECK(run.go() == "the best model could not be written: '" + run.folder + "/" + kBestFile + "': disk full");
    CHECK(run.host.notes.find("warning: the best model so far could not be saved: ") == 0);
}

TEST_CASE("broken checkpoints are refused, each with its own message")
{
    const ScratchFolder scratch;
    CHECK(ToyRun(scratch.path(), quick(), 4).go() == "finished");
    const std::string path = scratch.path(kCheckpointFile), where = "checkpoint '" + path + "'";
    const std::uintmax_t size = fs::file_size(path);
    const auto message = [&] { return load_checkpoint(path).error().message; };
    fs::resize_file(path, size - 1);
    CHECK(message().find(where + ": tensor '") == 0);
    fs::resize_file(path, 100);
    CHECK(message().find(where + ": header of ") == 0);
    fs::resize_file(path, 0);
    CHECK(message() == where + ": not a safetensors file, it has 0 bytes, at least 8 needed");
    fs::remove(path);
    CHECK(message() == where + ": cannot open '" + path + "': No such file or directory");
}
