// SPDX-License-Identifier: Apache-2.0
// Damages DNGs and other files at random (same seed, same damage) and decodes them: whatever they hold, the outcome is
// a reference with values in [0,1] or an error, in bounded time and memory. Most useful with SRISP_SANITIZE. Usage:
// reference_fuzz [rounds] [seed] [file…]; files are damaged as well as the DNGs made here.
#include "base/file_bytes.h"
#include "damage.h"
#include "lib/reference/synthetic_dng.h"
#include "noise/estimate_noise.h"
#include "reference/decoders.h"
#include "reference/raw_pixels.h"

using namespace srisp;

namespace {

using T = SyntheticDng;

std::vector<std::string> seeds_of_kind()
{
    const auto noise = [](int x, int y, int s) { return (x * 7919 + y * 104729 + s * 31) % 65536; };
    SyntheticDng plain, levels, linear, floats, big;
    big.big_endian = true;
    levels.set(50829, T::kLong, { 1, 2, 29, 39 })
        .set(50713, T::kShort, { 2, 2 })
        .set(50714, T::kRational, { 1, 2, 3, 4 });
    levels.set(50712, T::kShort, { 0, 100, 1000 }).set(274, T::kShort, { 6 }).set(51041, T::kDouble, { 1e-4, 1e-7 });
    linear.linear();
    floats.linear().fill_float([](int x, int y, int s) { return float(x + y + s) / 80; }, 3);
    return { plain.fill(noise).bytes(), levels.fill(noise).bytes(), linear.fill(noise, 3).bytes(), floats.bytes(),
             big.fill(noise).bytes() };
}

/// Decodes as load_reference and reference_noise do; false if values are not in [0,1].
bool decode(const std::string& bytes, int& decoded)
{
    // An allocation of the exact size, so that a sanitizer sees every read beyond it.
    std::shared_ptr<unsigned char[]> copy(new unsigned char[bytes.size()]);
    std::copy(bytes.begin(), bytes.end(), copy.get());
    const FileBytes file{ copy, bytes.size() };
    const auto image = decode_raw(file);
    if (!image)
        return !image.error().message.empty();
    ++decoded;
    for (const float value : raw_thumbnail(image->pixels).rgb)
        if (!(value >= 0 && value <= 1))
            return false;
    const auto noise = estimate_noise(image->pixels);
    return noise || !noise.error().message.empty();
}

} // namespace

int main(int argc, char** argv)
{
    constexpr std::size_t tags = 400;
    const std::string values("\0\1\2\x7f\x80\xff", 6);
    return FuzzRun{ seeds_of_kind(), values, tags, "decoded", "a value is not in [0,1], or an error has no message",
                    decode }
        .main(argc, argv);
}
