// SPDX-License-Identifier: Apache-2.0
#include "raw_file/tiff_tags.h"

#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "lib/reference/synthetic_dng.h"
#include "reference/decoders.h"

using namespace srisp;
using T = SyntheticDng;

namespace {

FileBytes exact_bytes(const std::string& bytes)
{
    const std::shared_ptr<unsigned char[]> copy(new unsigned char[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    return { copy, bytes.size() };
}

} // namespace

TEST_CASE("a tag's value is a whole number whatever double it is")
{
    CHECK(whole_number(7.9) == 7);
    CHECK(whole_number(-4935.87) == 0);
    CHECK(whole_number(std::nan("")) == 0);
    CHECK(whole_number(1e300) == std::uint64_t(1) << 53);
    CHECK(whole_number(std::numeric_limits<double>::infinity()) == std::uint64_t(1) << 53);
}

TEST_CASE("image data and folders before the file, beyond it or nowhere are not looked for")
{
    for (const double offset : { -1000.0, std::nan(""), 1e300, double(1ull << 32) }) {
        SyntheticDng dng;
        dng.fill([](int x, int y, int) { return x + y; });
        dng.set(273, T::kDouble, { offset }).set(34665, T::kDouble, { offset });
        const FileBytes file = exact_bytes(dng.bytes());
        const TiffTags tags(file.data.get(), file.size);
        CHECK(tags.exif().tags.empty());
        const auto description = describe_dng(file);
        CHECK(!description);
    }
    SyntheticDng negative;
    negative.fill([](int x, int y, int) { return x + y; }).set(279, T::kDouble, { -5 });
    CHECK(!describe_dng(exact_bytes(negative.bytes())));
}
