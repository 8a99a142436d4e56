// SPDX-License-Identifier: Apache-2.0
#include "base/regular_file.h"

#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <sys/stat.h>

#include "base/file_bytes.h"
#include "base/file_part.h"
#include "base/input_file.h"
#include "scratch_folder.h"

using namespace srisp;

TEST_CASE("URLs are told from paths")
{
    for (const char* url : { "http://host/a.mp4", "HTTPS://host", "file:///etc/passwd", "s3+x-y.z://bucket" })
        CHECK(is_url(url));
    for (const char* path :
         { "", "a.jpg", "/a/b.jpg", "./http://host/a.mp4", "a/http://b", "://x", "1a://x", "c:/x", "a b://c" })
        CHECK(!is_url(path));
}

TEST_CASE("FIFOs, devices, folders and URLs are refused at once on every way into a file")
{
    const ScratchFolder folder;
    const std::string fifo = folder.path("fifo");
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    const auto reasons = [](const std::string& path) {
        const auto of = [](const auto& result) { return result ? std::string("it was read") : result.error().message; };
        return std::vector<std::string>{ of(RegularFile::open(path)),   of(read_file(path, 100, "table")),
                                         of(read_text_file(path, 100)), of(open_for_parts(path)),
                                         of(read_head(path, 100)),      of(read_whole_file(path)) };
    };
    const std::string url = "http://127.0.0.1:9/a.json";
    for (const auto& [path, reason] :
         std::vector<std::pair<std::string, std::string>>{ { fifo, "is not a regular file" },
                                                           { "/dev/zero", "is not a regular file" },
                                                           { folder.path(), "is a folder" },
                                                           { url, "is a URL" } })
        for (const std::string& told : reasons(path))
            CHECK_MESSAGE(told.find(reason) != std::string::npos, told);
    CHECK(reasons(fifo)[1] == "table: '" + fifo + "' is not a regular file");
    CHECK(reasons(fifo)[2] == "'" + fifo + "': is not a regular file");
    CHECK(reasons(fifo)[3] == "'" + fifo + "' is not a regular file");
}
