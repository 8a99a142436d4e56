// SPDX-License-Identifier: Apache-2.0
#include "train/learning/trainer.h"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include <doctest/doctest.h>

#include "lib/train/toy_training.h"
#include "skip_unless.h"

using namespace srisp;
using namespace srisp::train;

namespace {

std::vector<StepReport> do_steps(Trainer& trainer, int steps)
{
    std::vector<StepReport> reports;
    for (int i = 0; i < steps; ++i)
        reports.push_back(*trainer.step());
    return reports;
}

/// A port that nobody else gets while this lives: it is bound, and only those who meet at it listen.
class ReservedPort {
public:
    ReservedPort() : m_socket(socket(AF_INET, SOCK_STREAM, 0))
    {
        const int on = 1;
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        socklen_t size = sizeof address;
        // With the same option the store may bind it, too.
        REQUIRE(setsockopt(m_socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on) == 0);
        REQUIRE(bind(m_socket, reinterpret_cast<sockaddr*>(&address), size) == 0);
        REQUIRE(getsockname(m_socket, reinterpret_cast<sockaddr*>(&address), &size) == 0);
        m_port = ntohs(address.sin_port);
    }
    ~ReservedPort() { close(m_socket); }
    ReservedPort(const ReservedPort&) = delete;
    ReservedPort& operator=(const ReservedPort&) = delete;

    std::string address() const { return "127.0.0.1:" + std::to_string(m_port); }

private:
    int m_socket, m_port = 0;
};

/// One of two processes.
std::unique_ptr<ProcessGroup> joined(const ReservedPort& port, int rank, int timeout_s = 60)
{
    Expected<std::unique_ptr<ProcessGroup>> group = ProcessGroup::join({ 2, rank, port.address(), timeout_s });
    REQUIRE_MESSAGE(group, group.error().message);
    return std::move(*group);
}

} // namespace

TEST_CASE("a model learns, and the average follows it")
{
    ProcessGroup alone;
    TrainerSettings settings = toy_settings(200);
    Trainer trainer = toy_trainer(settings, alone);
    const std::vector<StepReport> reports = do_steps(trainer, 200);
    CHECK(reports.back().loss < reports.front().loss / 3);
    CHECK(trainer.finished());
    CHECK(trainer.sound());
    const TrainingState state = trainer.state();
    CHECK((state.tensors.at("weights") - state.tensors.at("average")).abs().max().item<double>() < 0.05);
    CHECK((state.tensors.at("weights") - state.tensors.at("average")).abs().max().item<double>() > 0);
}

TEST_CASE("the first steps average evenly, and the teacher is the average of all weights")
{
    torch::Tensor average = torch::full({ 1 }, 7.0);
    for (int step = 0; step < 4; ++step)
        average_into(average, torch::full({ 1 }, step + 1.0), step, 0.999);
    CHECK(average.item<double>() == doctest::Approx(2.5));
    average_into(average, torch::full({ 1 }, 100.0), 4, 0.5);
    CHECK(average.item<double>() == doctest::Approx(51.25));
}

TEST_CASE("the teacher's pairs come after their share of the steps, and are seen in the loss")
{
    ProcessGroup alone;
    Trainer trainer = toy_trainer(toy_settings(12), alone);
    const std::vector<StepReport> reports = do_steps(trainer, 4);
    CHECK(reports[2].terms.size() == 2); // reverse, forward
    REQUIRE(reports[3].terms.size() == 3);
    CHECK(reports[3].terms[2].first == "teacher");
    const double pairs = reports[3].terms[0].second + reports[3].terms[1].second;
    CHECK(reports[3].loss == doctest::Approx(pairs + 0.3 * reports[3].terms[2].second));
}

TEST_CASE("what the student sees as the reference of a teacher's pair is a setting")
{
    ProcessGroup alone;
    TrainerSettings settings = toy_settings(4);
    settings.mean_teacher.start = 0;
    Trainer with_estimate = toy_trainer(settings, alone);
    settings.mean_teacher.reference = "raw";
    Trainer with_raw = toy_trainer(settings, alone);
    settings.mean_teacher.weight = 0;
    Trainer without = toy_trainer(settings, alone);
    const StepReport estimate = *with_estimate.step(), raw = *with_raw.step(), none = *without.step();
    CHECK(estimate.terms[0].second == raw.terms[0].second);
    // At the start teacher and student are equal: with the RAW itself they give the same image, with the estimate not.
    CHECK(raw.terms[2].second < estimate.terms[2].second);
    CHECK(none.terms.size() == 2);
}

TEST_CASE("a state saved and restored goes on to the same bits")
{
    ProcessGroup alone;
    Trainer whole = toy_trainer(toy_settings(12), alone);
    do_steps(whole, 12);
    Trainer first = toy_trainer(toy_settings(12), alone);
    do_steps(first, 5);
    Trainer second = toy_trainer(toy_settings(12), alone);
    REQUIRE(second.restore(first.state()));
    CHECK(second.steps_done() == 5);
    do_steps(second, 7);
    for (const auto& [name, vector] : whole.state().tensors) {
        CAPTURE(name);
        CHECK(torch::equal(vector, second.state().tensors.at(name)));
    }
}

TEST_CASE("a state of another model is refused")
{
    ProcessGroup alone;
    Trainer trainer = toy_trainer(toy_settings(12), alone);
    TrainingState state = trainer.state();
    state.layout = "gain[2]";
    CHECK(trainer.restore(state).error().message ==
          "is of a model with other tensors: has gain[2], needs gain[1] matrix[3, 3] bias[3]");
    state = trainer.state();
    state.tensors.erase("teacher");
    CHECK(trainer.restore(state).error().message == "has no 'teacher' of 13 numbers");
}

TEST_CASE("a step whose loss is not a number changes nothing")
{
    ProcessGroup alone;
    Trainer trainer = toy_trainer(toy_settings(12), alone, std::make_shared<ToySamples>(3));
    do_steps(trainer, 3);
    const torch::Tensor before = trainer.state().tensors.at("weights").clone();
    CHECK(!trainer.step()->finite);
    CHECK(trainer.steps_done() == 3);
    CHECK(torch::equal(before, trainer.state().tensors.at("weights")));
    CHECK(trainer.sound());
}

TEST_CASE("the others wait for what rank 0 does alone, longer than their timeout")
{
    SKIP_UNLESS(ProcessGroup::several_possible(), "Gloo's headers");
    using Clock = std::chrono::steady_clock;
    const ReservedPort port;
    bool done = false, done_when_released = false;
    std::thread other([&] {
        const auto group = joined(port, 1, 2);
        CHECK(group->rank_0_alone([](const auto&) { FAIL("rank 1 works"); }));
        done_when_released = done;
    });
    const auto group = joined(port, 0, 2);
    const Status status = group->rank_0_alone([&](const StillThere& still_there) {
        const Clock::time_point end = Clock::now() + std::chrono::milliseconds(2200);
        while (Clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            CHECK(still_there());
        }
        done = true;
    });
    CHECK(status);
    other.join();
    CHECK(done_when_released);
}

TEST_CASE("two processes learn what one learns from the same batches")
{
    SKIP_UNLESS(ProcessGroup::several_possible(), "Gloo's headers");
    ProcessGroup alone;
    Trainer single = toy_trainer(toy_settings(12), alone);
    const std::vector<StepReport> expected = do_steps(single, 12);

    const ReservedPort port;
    std::vector<StepReport> reports[2];
    torch::Tensor weights[2];
    const auto run = [&](int rank) {
        const auto group = joined(port, rank);
        Trainer trainer = toy_trainer(toy_settings(12), *group);
        CHECK(trainer.share_state());
        reports[rank] = do_steps(trainer, 12);
        weights[rank] = trainer.state().tensors.at("weights").clone();
    };
    std::thread other(run, 1);
    run(0);
    other.join();
    for (int step = 0; step < 12; ++step)
        for (int rank = 0; rank < 2; ++rank) {
            CHECK(reports[rank][step].loss == doctest::Approx(expected[step].loss).epsilon(1e-5));
            CHECK(reports[rank][step].gradient_norm == doctest::Approx(expected[step].gradient_norm).epsilon(1e-4));
        }
    CHECK(torch::equal(weights[0], weights[1]));
    CHECK(torch::allclose(weights[0], single.state().tensors.at("weights"), 1e-4, 1e-6));
}

TEST_CASE("processes notice that they do not train the same, take over rank 0's state, and stop together")
{
    SKIP_UNLESS(ProcessGroup::several_possible(), "Gloo's headers");
    const ReservedPort port;
    std::string messages[2];
    bool stopped[2];
    torch::Tensor weights[2];
    const auto run = [&](int rank) {
        const auto group = joined(port, rank);
        CHECK(group->check_same("the same", "recipe"));
        messages[rank] = group->check_same(rank == 0 ? "one" : "another", "recipe").error().message;
        Trainer trainer = toy_trainer(toy_settings(12), *group);
        trainer.state().tensors.at("weights").add_(rank * 0.1);
        CHECK(trainer.share_state());
        weights[rank] = trainer.state().tensors.at("weights").clone();
        stopped[rank] = trainer.step(rank == 1)->stop;
    };
    std::thread other(run, 1);
    run(0);
    other.join();
    for (int rank = 0; rank < 2; ++rank) {
        CHECK(messages[rank] == "the processes do not have the same recipe");
        CHECK(stopped[rank]);
    }
    CHECK(torch::equal(weights[0], weights[1]));
}

TEST_CASE("a process that is gone ends the others with a message")
{
    SKIP_UNLESS(ProcessGroup::several_possible(), "Gloo's headers");
    const ReservedPort port;
    std::thread other([&] {
        const auto group = joined(port, 1);
        CHECK(toy_trainer(toy_settings(12), *group).step());
    });
    const auto group = joined(port, 0);
    Trainer trainer = toy_trainer(toy_settings(12), *group);
    CHECK(trainer.step());
    other.join();
    const Expected<StepReport> step = trainer.step();
    REQUIRE(!step);
    CHECK(step.error().message.find("rank 0 has lost another process (it ended, or did not answer within 60 s): ") ==
          0);
}

TEST_CASE("a process that waits for others in vain gives up")
{
    SKIP_UNLESS(ProcessGroup::several_possible(), "Gloo's headers");
    const ReservedPort port;
    const std::string message = ProcessGroup::join({ 2, 0, port.address(), 1 }).error().message;
    CHECK(message.find("rank 0 of 2 could not meet the others at 127.0.0.1:") == 0);
    CHECK(message.find("within 1 s") != std::string::npos);
}
