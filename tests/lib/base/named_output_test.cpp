// SPDX-License-Identifier: Apache-2.0
#include "base/named_output.h"

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "scratch_folder.h"

using namespace srisp;

namespace {

unsigned mode_of(const std::string& path)
{
    struct stat info {};
    return ::lstat(path.c_str(), &info) == 0 ? unsigned(info.st_mode) & 07777 : 0;
}

} // namespace

TEST_CASE("what waits for a device in the folder for temporary files is for its owner's eyes only")
{
    const ScratchFolder folder;
    ::setenv("TMPDIR", folder.path().c_str(), 1);
    const mode_t mask = ::umask(0);
    const NamedOutput device("/dev/null"), file(folder.path("out.exr"));
    ::umask(mask);
    ::unsetenv("TMPDIR");
    REQUIRE(device.created());
    REQUIRE(file.created());
    CHECK(device.name().rfind(folder.path(), 0) == 0);
    CHECK(mode_of(device.name()) == 0600);
    CHECK(mode_of(file.name()) == 0666); // as the user's umask says: it takes the place of a file of the user's
}
