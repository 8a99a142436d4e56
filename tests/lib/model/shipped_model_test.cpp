// SPDX-License-Identifier: Apache-2.0
#include "model/shipped_model.h"

#include <cstdlib>

#include <doctest/doctest.h>
#include <srisp/model.h>

#include "base/input_file.h"
#include "random_model.h"
#include "scratch_folder.h"

using namespace srisp;

TEST_CASE("another file under a shipped name is the user's own in a folder of SRISP_MODEL_PATH, and by its path")
{
    const ScratchFolder folder;
    const std::string path = random_model(1, 4).write(folder.path("default.safetensors"));
    CHECK(Model::load(path));
    ::setenv("SRISP_MODEL_PATH", folder.path("").c_str(), 1);
    const auto own = Model::load("default");
    ::unsetenv("SRISP_MODEL_PATH");
    REQUIRE_MESSAGE(own, (own ? "" : own.error().message));
    CHECK((*own)->path().rfind(folder.path(""), 0) == 0);
}

TEST_CASE("what ships is known by its hash, and other bytes in the installed place are told apart")
{
    const std::string installed = (*Model::load("default"))->path();
    const std::string good = *read_file(installed, 64 << 20, "model");
    CHECK(check_shipped_model("default", installed, good));
    CHECK(check_shipped_model(installed, installed, "other")); // named by its path
    CHECK(check_shipped_model("mine", installed, "other"));    // ships under no such name
    CHECK(check_shipped_model("default", "own/default.safetensors", "other"));
    std::string changed = good;
    changed[changed.size() / 2] ^= 1;
    for (const std::string& bytes : { changed, good.substr(0, good.size() - 1) })
        CHECK_FALSE(check_shipped_model("default", installed, bytes));
    const Status refused = check_shipped_model("default", installed, "");
    REQUIRE_FALSE(refused);
    CHECK(refused.error().message.find("is not the file that ships under this name: its SHA-256 is "
                                       "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855, expected ") !=
          std::string::npos);
}
