// SPDX-License-Identifier: Apache-2.0
// RAW files inside TIFF that nothing here decodes must be called that, not photos.
#include "reference/tiff_raw.h"

#include <algorithm>

#include <srisp/reference.h>

#include "lib/reference/synthetic_dng.h"
#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;

namespace {

using T = SyntheticDng;

std::string refusal(const std::string& name, const std::string& bytes)
{
    const ScratchFolder folder;
    const auto reference = load_reference(folder.file(name, bytes));
    if (reference)
        return "(it loaded)";
    const std::string& message = reference.error().message;
    return message.substr(message.find("': ") + 3);
}

/// A mosaic in a TIFF that is no DNG.
SyntheticDng camera_tiff(int compression)
{
    SyntheticDng tiff;
    tiff.erase(50706).set(259, T::kShort, { double(compression) });
    tiff.set(271, T::kAscii, { 'A', 'c', 'm', 'e', 0 }).set(272, T::kAscii, { 'Z', ' ', '1', 0 });
    return tiff.fill([](int x, int y, int) { return (x * 7919 + y * 104729) % 65536; });
}

bool starts_with(const std::string& text, const std::string& start)
{
    return text.compare(0, start.size(), start) == 0;
}

} // namespace

TEST_CASE("A GPR is a GoPro RAW file compressed by VC-5, whatever its name and whether it says that it is a DNG or not")
{
    SyntheticDng dng;
    dng.set(259, T::kShort, { 9 }).fill([](int, int, int) { return 1000; });
    for (const std::string name : { "a.gpr", "A.GPR", "a.dng", "a.tif", "a" })
        for (const std::string& bytes : { dng.bytes(), camera_tiff(9).bytes() }) {
            CAPTURE(name);
            const std::string message = refusal(name, bytes);
            CHECK(starts_with(message, "is a GoPro RAW file (GPR), compressed by VC-5, which LibRaw "));
            CHECK(message.find("convert it to DNG") != std::string::npos);
        }
}

TEST_CASE("A camera's TIFF that LibRaw does not decode is called a RAW file with its compression, not a photo")
{
    for (const std::string name : { "a.nef", "a.tif", "a.xyz" })
        for (const int compression : { 12345, 32768 }) {
            CAPTURE(name);
            const std::string message = refusal(name, camera_tiff(compression).bytes());
            CHECK(starts_with(message, "is a RAW file of 'Z 1' (TIFF with a mosaic, compression " +
                                           std::to_string(compression) + ") that LibRaw "));
            CHECK(message.find("display-encoded") == std::string::npos);
        }
}

TEST_CASE("A camera's name in a message is shortened, and text that can be shown")
{
    SyntheticDng tiff = camera_tiff(12345);
    std::vector<double> name{ 'Z', 27, 0xff };
    name.resize(5000, 'a');
    tiff.set(272, T::kAscii, name);
    const std::string bytes = tiff.bytes();
    const std::shared_ptr<unsigned char[]> copy(new unsigned char[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    const std::string shown = tiff_raw_name({ copy, bytes.size() });
    CHECK(starts_with(shown, "a RAW file of 'Z\\x1b\\xffaaa"));
    CHECK(shown.size() < 300);
}

TEST_CASE("Nikon's high-efficiency compression is refused before LibRaw takes it for another one")
{
    SyntheticDng tiff = camera_tiff(34713);
    tiff.pixels.replace(16, 15, "CONTACT_INTOPIX");
    CHECK(starts_with(refusal("a.nef", tiff.bytes()),
                      "is a Nikon RAW file of high-efficiency compression, which LibRaw "));
}

TEST_CASE("A DNG that is refused says why under any name")
{
    SyntheticDng dng;
    dng.fill([](int, int, int) { return 1000; }).set(50711, T::kShort, { 2 });
    CHECK(refusal("a.tif", dng.bytes()) == "DNG with a staggered mosaic (CFALayout 2): not supported");
}

TEST_CASE("A photo's TIFF is still a photo")
{
    SyntheticDng tiff;
    tiff.erase(50706).erase(33421).erase(33422).set(262, T::kShort, { 2 }).set(277, T::kShort, { 3 });
    tiff.set(258, T::kShort, { 8, 8, 8 });
    tiff.pixels.assign(std::size_t(tiff.width * tiff.height * 3), 'x');
    CHECK(starts_with(refusal("a.tif", tiff.bytes()), "TIFF without srisp's metadata may be display-encoded"));
}
