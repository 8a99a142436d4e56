// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/stock_oiiotool.h"

#include <sys/stat.h>

#include <algorithm>
#include <cstdlib>

#include <doctest/doctest.h>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp;
using namespace srisp::tool;
namespace fs = std::filesystem;

namespace {

/// An environment variable for one test.
class Variable {
public:
    Variable(const char* name, const std::string& value) : m_name(name)
    {
        const char* const old = std::getenv(name);
        m_was_set = old;
        m_old = old ? old : "";
        setenv(name, value.c_str(), 1);
    }
    ~Variable() { m_was_set ? setenv(m_name, m_old.c_str(), 1) : unsetenv(m_name); }

private:
    const char* m_name;
    bool m_was_set;
    std::string m_old;
};

std::string program(const ScratchFolder& scratch, const std::string& name)
{
    fs::create_directories(fs::path(scratch.path(name)).parent_path());
    const std::string path = scratch.file(name, "#!/bin/sh\n");
    chmod(path.c_str(), 0755);
    return path;
}

} // namespace

TEST_CASE("the stock oiiotool is the first on PATH that is not srisptool under any of its names")
{
    const ScratchFolder scratch;
    program(scratch, "a/srisptool");
    fs::create_symlink("srisptool", scratch.path("a/oiiotool"));
    program(scratch, "b/libexec/srisp/oiiotool");
    fs::create_directories(scratch.path("c/oiiotool"));
    fs::create_directories(scratch.path("d"));
    scratch.file("d/oiiotool"); // cannot be run
    const std::string stock = program(scratch, "e/oiiotool");
    program(scratch, "f/oiiotool");
    const Variable own("SRISP_OIIOTOOL", "");
    std::string path;
    for (const char* folder : { "a", "b/libexec/srisp", "c", "d", "no", "e", "f" })
        path += scratch.path(folder) + ":";
    const Variable variable("PATH", path);
    CHECK(find_stock_oiiotool() == stock);
}

TEST_CASE("the program that runs is not the stock oiiotool, whatever it is called")
{
    const ScratchFolder scratch;
    fs::create_symlink(fs::read_symlink("/proc/self/exe"), scratch.path("oiiotool"));
    const Variable own("SRISP_OIIOTOOL", "");
    const Variable variable("PATH", scratch.path());
    CHECK(failure_of(find_stock_oiiotool) ==
          "1: no stock oiiotool on PATH (Debian: openimageio-tools); SRISP_OIIOTOOL may name one");
}

TEST_CASE("SRISP_OIIOTOOL is used as it is, or refused")
{
    const ScratchFolder scratch;
    const std::string mine = program(scratch, "mine"), ours = program(scratch, "srisptool");
    {
        const Variable variable("SRISP_OIIOTOOL", mine);
        CHECK(find_stock_oiiotool() == mine);
    }
    {
        const Variable variable("SRISP_OIIOTOOL", ours);
        CHECK(failure_of(find_stock_oiiotool) ==
              "1: SRISP_OIIOTOOL: '" + ours + "' is srisptool itself, not the stock oiiotool");
    }
    const Variable variable("SRISP_OIIOTOOL", "/no/such");
    CHECK(failure_of(find_stock_oiiotool) == "1: SRISP_OIIOTOOL: '/no/such' is not a program that can be run");
}

TEST_CASE("the plugin's folder goes in front of what the user's search path holds")
{
    const Variable variable("OIIO_LIBRARY_PATH", "/mine:/yours");
    unsetenv("OPENIMAGEIO_PLUGIN_PATH");
    const std::vector<std::string> environment = environment_with_plugin("/p");
    const auto count = [&](const char* entry) { return std::count(environment.begin(), environment.end(), entry); };
    CHECK(count("OIIO_LIBRARY_PATH=/p:/mine:/yours") == 1);
    CHECK(count("OPENIMAGEIO_PLUGIN_PATH=/p") == 1);
}
