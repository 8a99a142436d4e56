// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>

#include "base/write_all.h"

namespace srisp::tool {

namespace {

using Clock = std::chrono::steady_clock;

/// Whether there is something to be read before the end.
bool wait_for_bytes(int file, Clock::time_point end, bool& timed_out)
{
    constexpr long kLongest = 1'000'000; // ms
    for (;;) {
        const long left = long(std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count());
        pollfd wanted{ file, POLLIN, 0 };
        const int ready = ::poll(&wanted, 1, int(std::clamp(left, 0L, kLongest)));
        if (ready > 0)
            return true;
        if (ready == 0 && left <= kLongest) {
            timed_out = true;
            return false;
        }
        if (ready < 0 && errno != EINTR)
            return false;
    }
}

bool read_bytes(int file, void* data, std::size_t size, Clock::time_point end, bool& timed_out)
{
    char* at = static_cast<char*>(data);
    while (size > 0) {
        if (!wait_for_bytes(file, end, timed_out))
            return false;
        const ssize_t count = ::read(file, at, size);
        if (count == 0 || (count < 0 && errno != EINTR))
            return false;
        at += std::max<ssize_t>(count, 0);
        size -= std::size_t(std::max<ssize_t>(count, 0));
    }
    return true;
}

} // namespace

bool send_message(int file, const Message& message)
{
    std::string bytes;
    const auto add = [&](std::uint32_t number) { bytes.append(reinterpret_cast<const char*>(&number), sizeof number); };
    add(std::uint32_t(message.size()));
    for (const std::string& text : message) {
        add(std::uint32_t(text.size()));
        bytes += text;
    }
    return write_all(bytes,
                     [file](const char* data, std::size_t size) { return ::send(file, data, size, MSG_NOSIGNAL); });
}

std::optional<Message> receive_message(int file, double seconds, bool& timed_out)
{
    constexpr std::uint32_t kMostTexts = 64, kMostBytes = 1 << 24; // a confused process's message ends the talk
    const auto end = Clock::now() + std::chrono::milliseconds(std::int64_t(seconds * 1000));
    timed_out = false;
    std::uint32_t count = 0, size = 0;
    if (!read_bytes(file, &count, sizeof count, end, timed_out) || count > kMostTexts)
        return {};
    Message message(count);
    for (std::string& text : message) {
        if (!read_bytes(file, &size, sizeof size, end, timed_out) || size > kMostBytes)
            return {};
        text.resize(size);
        if (!read_bytes(file, text.data(), size, end, timed_out))
            return {};
    }
    return message;
}

} // namespace srisp::tool
