// SPDX-License-Identifier: Apache-2.0
// What two processes of srispbatch say to each other.
#include "tools/srispbatch/messages.h"

#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

#include "fuzz_target.h"
#include "tools/srispbatch/task_message.h"

using namespace srisp;

namespace {

/// A message through a new pair of sockets, as `send` puts it there.
template<class Send> std::optional<tool::Message> sent(const Send& send)
{
    int ends[2];
    fuzz::must_hold(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "sockets can be made");
    send(ends[0]);
    ::close(ends[0]);
    bool timed_out = false;
    auto message = tool::receive_message(ends[1], 1, timed_out);
    ::close(ends[1]);
    fuzz::must_hold(!timed_out, "an end that is closed is noticed");
    return message;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    if (size > 65536) // beyond a socket's room
        return 0;
    const auto message = sent(
        [&](int end) { fuzz::must_hold(::send(end, data, size, MSG_NOSIGNAL) == ssize_t(size) || size == 0, "sent"); });
    if (!message)
        return 0;
    const auto again = sent([&](int end) { tool::send_message(end, *message); });
    fuzz::must_hold(again && *again == *message, "a message arrives as it was");
    if (const auto task = tool::task_of_message(*message)) {
        const auto back = tool::task_of_message(tool::task_message(*task));
        fuzz::must_hold(back && tool::task_message(*back) == tool::task_message(*task), "a task arrives as it was");
    }
    return 0;
}
