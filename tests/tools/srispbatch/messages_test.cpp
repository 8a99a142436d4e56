// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbatch/messages.h"

#include <doctest/doctest.h>

#include <array>
#include <string>

#include <sys/socket.h>
#include <unistd.h>

#include "../../../tools/srispbatch/task_message.h"

using namespace srisp::tool;

namespace {

struct Sockets {
    Sockets() { REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0); }
    ~Sockets()
    {
        close_writer();
        ::close(ends[0]);
    }
    void close_writer()
    {
        if (ends[1] >= 0)
            ::close(ends[1]);
        ends[1] = -1;
    }
    std::array<int, 2> ends{};
};

} // namespace

TEST_CASE("messages of any bytes arrive as they were sent")
{
    Sockets pipe;
    const Message sent{ "", std::string("\0\n\xff", 3), std::string(40'000, 'x') };
    REQUIRE(send_message(pipe.ends[1], sent));
    bool timed_out = true;
    const auto received = receive_message(pipe.ends[0], 5, timed_out);
    REQUIRE(received);
    CHECK(*received == sent);
    CHECK(!timed_out);
}

TEST_CASE("no message: time is up, the other end is closed, or what comes is none")
{
    bool timed_out = false;
    Sockets slow;
    CHECK(!receive_message(slow.ends[0], 0.05, timed_out));
    CHECK(timed_out);
    Sockets closed;
    closed.close_writer();
    CHECK(!receive_message(closed.ends[0], 5, timed_out));
    CHECK(!timed_out);
    Sockets confused;
    REQUIRE(::write(confused.ends[1], "printed by a library", 20) == 20);
    CHECK(!receive_message(confused.ends[0], 5, timed_out));
    CHECK(!timed_out);
}

TEST_CASE("to whom is gone nothing is said, and who says it goes on")
{
    std::array<int, 2> ends{};
    REQUIRE(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) == 0);
    ::close(ends[1]);
    CHECK(!send_message(ends[0], { "go on" }));
    ::close(ends[0]);
}

TEST_CASE("a worker is told all of a task")
{
    WorkerTask sent;
    sent.task.photo = { "/p/\xff.jpg", "\xff.jpg" };
    sent.task.copy = 3;
    sent.task.reference = "refs/a b.dng";
    sent.task.seed = UINT64_MAX;
    sent.task.output = "x/1_3.exr";
    sent.path = "out/x/1_3.exr";
    sent.reference = "/proc/1/fd/2";
    sent.settings = "xxh128:0";
    for (const bool shot : { false, true }) {
        sent.may_replace = shot;
        if (shot)
            sent.task.shot = ListedFile{ "/p/0.jpg", "0.jpg" };
        sent.task.shot_seed = shot ? 7 : 0;
        const auto got = task_of_message(task_message(sent));
        REQUIRE(got);
        CHECK(got->task.photo.path == sent.task.photo.path);
        CHECK(got->task.photo.name == sent.task.photo.name);
        CHECK(got->task.copy == 3);
        CHECK(got->task.reference == sent.task.reference);
        CHECK(got->task.seed == UINT64_MAX);
        CHECK(got->task.output == sent.task.output);
        CHECK(got->task.shot.has_value() == shot);
        CHECK(got->task.shot_seed == sent.task.shot_seed);
        CHECK(got->path == sent.path);
        CHECK(got->reference == sent.reference);
        CHECK(got->settings == sent.settings);
        CHECK(got->may_replace == shot);
    }
    CHECK(!task_of_message({ "too", "few" }));
}
