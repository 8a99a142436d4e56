// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/orientation_words.h"

#include <doctest/doctest.h>

#include "rewritten.h"

using namespace srisp;
using namespace srisp::tool;

TEST_CASE("a PNG file gets the orientation as a text, which is gone before anything else is made of the image")
{
    const Files files;
    const Words marked = { "--orientcw", "--orientccw", "--sattrib", "srisp:Orientation", "{TOP.Orientation}......." };
    CHECK(rewritten({ files.photo, "--srisp-process", "-o", "x.png" }).words ==
          joined({ { kReadNow, "/T/1.srisp" }, marked, { "-o", "x.png" } }));
    CHECK(rewritten({ files.photo, "--srisp-process", "-o", "x.png", "--echo", "hi", "-o", "x.exr" }).words ==
          joined({ { kReadNow, "/T/1.srisp" },
                   marked,
                   { "-o", "x.png", "--echo", "hi", "--eraseattrib", "srisp:Orientation", "-o", "x.exr" } }));
    CHECK(rewritten({ "--evaloff", files.photo, "--srisp-process", "-o:fileformatname=PNG", "x" }).words ==
          joined({ { "--evaloff", kReadNow, "/T/1.srisp", "--orientcw", "--orientccw", "--evalon" },
                   { marked.begin() + 2, marked.end() },
                   { "--evaloff", "-o:fileformatname=PNG", "x" } }));
}

TEST_CASE("what cannot hold an orientation gets a note, in case it is lost")
{
    const Files files;
    const Rewritten result = rewritten({ files.photo, "--srisp-process", "-o", "x.ppm" }, { "/T", "", false, true });
    CHECK(result.words ==
          joined({ { kReadNow, "/T/1.srisp", "--orientcw", "--orientccw", "--if", "{TOP.Orientation!=1}", "--create",
                     "1x1", "1", "-o", "/T/2.turned.pgm", "--pop", "--endif", "-o", "x.ppm" } }));
    CHECK(result.notes.at("2.turned.pgm") ==
          "'x.ppm' cannot hold an orientation, so the picture lies there as the camera stored it; --autoorient before "
          "the photo or --reorient before -o turns it");
    CHECK(rewritten({ files.photo, "--srisp-process", "-o", "x.ppm" }).notes.empty());
    CHECK(rewritten({ files.photo, "--srisp-process", "-o", "x.jpg" }, { "/T", "", false, true }).notes.empty());
}

TEST_CASE("orientations 5 and 7 are turned by commands that turn them rightly")
{
    const Files files;
    const Words orienting = rewritten({ files.photo, "--srisp-process", "--reorient" }).words;
    const Words turn(orienting.begin() + 3, orienting.end());
    CHECK(turn.front() == "--orientcw");
    CHECK(turn.back() == "--reorient");
    CHECK(rewritten({ "--autoorient", files.photo, "--srisp-process", files.other, "--over" }).words ==
          joined({ { kReadNow, "/T/1.srisp" }, turn, hand_over("2"), { files.other }, turn, { "--over" } }));
    // A command may wait for the image.
    CHECK(rewritten({ "--autoorient", "--over", files.photo, "--srisp-process" }).words ==
          joined({ { "--over", "--autoorient", kReadNow, "/T/1.srisp" }, hand_over("2") }));
    CHECK(rewritten({ "--reorient", files.photo, "--srisp-process" }).words ==
          joined({ { "--reorient", kReadNow, "/T/1.srisp" }, hand_over("2") }));
}
