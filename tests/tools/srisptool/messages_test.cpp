// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisptool/messages.h"

#include <filesystem>

#include <doctest/doctest.h>

using namespace srisp::tool;

namespace {

const Subjects kSubjects = {
    { "1", { "a.jpg", "/home/a.jpg", "--srisp-unprocess", false } },
    { "2", { "b.png", "/home/b.png", "", false } },
    { "3", { "b.png", "", "--srisp-process", false } },
    { "4", { "s.1-9#.tif", "/home/#/s.%04d.tif", "--srisp-unprocess", true } },
    { "5", { "", "", "--srisp-params", false } },
};

/// All that is shown of a text, which comes in one piece.
std::string shown(const std::string& text, int lines = 1)
{
    Messages messages("/T", kSubjects, lines);
    const std::string whole_lines = messages.take(text);
    return whole_lines + messages.finish();
}

} // namespace

TEST_CASE("an error of ours is one line with the name that the user typed")
{
    CHECK(shown("oiiotool ERROR: read : \"/T/1.srisp\": photo '/home/a.jpg': \"/home/a.jpg\" is not a JPEG file\n"
                "Full command line was:\n> oiiotool -i:now=1 /T/1.srisp\n") ==
          "srisptool: ERROR: photo 'a.jpg': is not a JPEG file\n");
    CHECK(shown("oiiotool ERROR: read : Invalid image file \"/T/1.srisp\": /home/a.jpg: is a CMYK image\n") ==
          "srisptool: ERROR: photo 'a.jpg': is a CMYK image\n");
    CHECK(shown("oiiotool ERROR: read : \"/T/3.0.srisp\": b.png: is no RAW-like image\n") ==
          "srisptool: ERROR: image 'b.png': is no RAW-like image\n");
    CHECK(shown("oiiotool ERROR: read : \"/T/2.srisp\": photo '/home/b.png': does not exist\n") ==
          "srisptool: ERROR: image 'b.png': does not exist\n");
    CHECK(shown("oiiotool ERROR: read : \"/T/2.srisp\": out of memory\n") ==
          "srisptool: ERROR: image 'b.png': out of memory\n");
    CHECK(shown("oiiotool ERROR: -o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0 : b.png: records nothing\n") ==
          "srisptool: ERROR: image 'b.png': records nothing\n");
}

TEST_CASE("a reason that names the file that is at fault stands for itself")
{
    CHECK(shown("oiiotool ERROR: read : \"/T/1.srisp\": reference '/r.dng': truncated\n") ==
          "srisptool: ERROR: reference '/r.dng': truncated\n");
    CHECK(shown("oiiotool ERROR: -o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0 : reference '/r.dng': bad\n") ==
          "srisptool: ERROR: reference '/r.dng': bad\n");
}

TEST_CASE("a hand-over file that cannot be written is not taken for the photo")
{
    const std::string writer = "oiiotool ERROR: -o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0 : ";
    CHECK(shown(writer + "'/T/1.0.21a53e03.temp.srisp' cannot be created: No space left on device\n") ==
          "srisptool: ERROR: a temporary file cannot be written: No space left on device (TMPDIR may name another "
          "folder)\n");
    CHECK(
        shown(writer + "oiiotool ERROR: could not move temp file /T/1.0.21a53e03.temp.srisp to /T/1.0.srisp: "
                       "Input/output error\n") ==
        "srisptool: ERROR: a temporary file cannot be written: Input/output error (TMPDIR may name another folder)\n");
}

TEST_CASE("of a sequence the frame is named")
{
    CHECK(shown("oiiotool ERROR: read : \"/T/4.0012.srisp\": photo '/home/#/s.0012.tif': is damaged\n") ==
          "srisptool: ERROR: photo 's.0012.tif': is damaged\n");
    CHECK(shown("oiiotool ERROR: read : File does not exist: \"/T/4.0007.srisp\"\n") ==
          "srisptool: ERROR: photo 's.0007.tif' does not exist\n");
    CHECK(shown("oiiotool ERROR : Not all matched: /T/4.1-9#.srisp (9 frames) vs. x.#.exr (8 frames)\n") ==
          "oiiotool ERROR : Not all matched: s.1-9#.tif (9 frames) vs. x.#.exr (8 frames)\n");
}

TEST_CASE("an image that a command of ours lacks is told once")
{
    const std::string warning =
        "oiiotool WARNING: -o:bits=0 : /T/3.0.srisp did not have any current image to output.\n";
    CHECK(shown(warning + "oiiotool ERROR: read : File does not exist: \"/T/3.0.srisp\"\n") ==
          "srisptool: ERROR: --srisp-process: no image before it\n");
    CHECK(shown(warning + "something else\n") ==
          "srisptool: WARNING: --srisp-process: no image before it\nsomething else\n");
    CHECK(shown(warning) == "srisptool: WARNING: --srisp-process: no image before it\n");
}

TEST_CASE("errors of oiiotool's own stay recognisable, without the command line and unfinished names")
{
    CHECK(shown("oiiotool ERROR: resize : bad size\nFull command line was:\n> oiiotool --x /T/1.srisp\nmore\n") ==
          "oiiotool ERROR: resize : bad size\nmore\n");
    CHECK(shown("oiiotool ERROR: -o : Could not open \"/no/x.0123abCD.temp.exr\"\n") ==
          "oiiotool ERROR: -o : Could not open \"/no/x.exr\"\n");
    CHECK(shown("oiiotool ERROR: read : File does not exist: \"no.jpg\"\n") ==
          "srisptool: ERROR: image 'no.jpg' does not exist\n");
    CHECK(shown("libx: /T/2.srisp, /T/5.json, /T/guard.so\n") == "libx: b.png, image, (temporary folder)/guard.so\n");
}

TEST_CASE("notes name the image as the user did")
{
    CHECK(shown("srisp: note: /home/a.jpg: has no profile\n") == "srisp: note: a.jpg: has no profile\n");
    CHECK(shown("srisp: note: photo '/home/a.jpg': has no profile\n") ==
          "srisp: note: photo 'a.jpg': has no profile\n");
    CHECK(shown("srisp: note: /home/#/s.0001.tif: is dark\n") == "srisp: note: s.0001.tif: is dark\n");
    CHECK(shown("srisp: note: /elsewhere/a.jpg: is dark\n") == "srisp: note: /elsewhere/a.jpg: is dark\n");
}

TEST_CASE("a command line of several lines is left out as a whole, one that is not known is one line")
{
    CHECK(shown("Full command line was:\n> oiiotool --echo \"a\nb\"\nnext\n", 2) == "next\n");
    CHECK(shown("Full command line was:\n> \nnext\n", 2) == "next\n");
}

TEST_CASE("lines are shown as soon as they are whole, the rest at the end")
{
    Messages messages("/T", {}, 1);
    CHECK(messages.take("srisp: no") == "");
    CHECK(messages.take("te\nx\ny") == "srisp: note\nx\n");
    CHECK(messages.finish() == "y\n");
    CHECK(messages.finish() == "");
}

TEST_CASE("a write that failed is told once, with name and reason, in place of what oiiotool and libjpeg say")
{
    const std::string failed = "srisp output guard: File too large: /out/a.0123abcd.temp.jpg\n";
    const std::string told = "srisptool: ERROR: output '/out/a.jpg' cannot be written: File too large\n";
    CHECK(shown(failed + "Output file write error --- out of disk space?\n") == told);
    CHECK(shown(failed + "oiiotool ERROR: -o : Failed OpenEXR write\noiiotool ERROR: -otex : again\n") == told);
    CHECK(shown("note\n" + failed + "other\n") == "note\nother\n" + told);
    CHECK(shown("oiiotool ERROR: -o : Failed OpenEXR write\n") == "oiiotool ERROR: -o : Failed OpenEXR write\n");
    CHECK(
        shown("srisp output guard: No space: " + (std::filesystem::current_path() / "b: c.0123abcd.temp.png").string() +
              "\n") == "srisptool: ERROR: output 'b: c.png' cannot be written: No space\n");
}

TEST_CASE("a reason of any length is shown")
{
    const std::string endless(1000000, 'x');
    CHECK(shown("oiiotool ERROR: read : \"/T/1.srisp\": photo '/home/a.jpg': " + endless + "\n") ==
          "srisptool: ERROR: photo 'a.jpg': " + endless + "\n");
    CHECK(shown("oiiotool ERROR: read : \"/T/1.srisp\": " + endless + " '" + endless + "\n") ==
          "srisptool: ERROR: " + endless + " '" + endless + "\n");
    CHECK(shown("/T/" + std::string(100000, '1') + "." + endless + "\n").size() > endless.size());
}
