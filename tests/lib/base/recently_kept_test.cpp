// SPDX-License-Identifier: Apache-2.0
#include "base/recently_kept.h"

#include <atomic>
#include <memory>
#include <stdexcept>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

using Text = std::shared_ptr<const std::string>;

Text text(const std::string& value)
{
    return std::make_shared<const std::string>(value);
}

} // namespace

TEST_CASE("what was used longest ago goes first, and the first one kept stays")
{
    RecentlyKept<Text> kept(2);
    const Text a = kept.keep("a", text("A"));
    CHECK(kept.keep("a", text("another")) == a);
    kept.keep("b", text("B"));
    CHECK(kept.find("a") == a);
    kept.keep("c", text("C"));
    CHECK(kept.find("a") == a);
    CHECK(!kept.find("b"));
    CHECK(*kept.find("c") == "C");
}

TEST_CASE("requests for one that is being made wait for it, and it is made once")
{
    RecentlyKept<Text> kept(2);
    std::atomic<int> made{ 0 }, waiting{ 0 };
    std::vector<Text> got(4);
    std::vector<std::thread> threads;
    for (Text& result : got)
        threads.emplace_back([&] {
            ++waiting;
            result = *kept.get("a", [&]() -> Expected<Text> {
                while (waiting < 4)
                    std::this_thread::yield();
                CHECK(!kept.find("a"));
                ++made;
                return text("A");
            });
        });
    for (std::thread& thread : threads)
        thread.join();
    CHECK(made == 1);
    for (const Text& result : got)
        CHECK(result == kept.find("a"));
}

TEST_CASE("failures and exceptions are not kept")
{
    RecentlyKept<Text> kept(2);
    CHECK(!kept.get("a", [] { return Expected<Text>(Error{ "no memory" }); }));
    CHECK_THROWS(kept.get("a", []() -> Expected<Text> { throw std::runtime_error("no memory"); }));
    CHECK(**kept.get("a", [] { return Expected<Text>(text("A")); }) == "A");
}

TEST_CASE("what one thread keeps while another fails to make it stays")
{
    RecentlyKept<Text> kept(4);
    CHECK(!kept.get("a", [&]() -> Expected<Text> {
        kept.keep("a", text("A"));
        return Error{ "no memory" };
    }));
    CHECK(*kept.find("a") == "A");
    CHECK(**kept.get("a", [] { return Expected<Text>(Error{ "made again" }); }) == "A");
}

TEST_CASE("the state of a file changes with its content, and is its path where there is none")
{
    const ScratchFolder folder;
    CHECK(file_state(folder.path("none")) == folder.path("none"));
    const std::string before = file_state(folder.file("a.txt", "A"));
    CHECK(file_state(folder.path("a.txt")) == before);
    CHECK(file_state(folder.file("a.txt", "longer")) != before);
}
