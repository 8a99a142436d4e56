// SPDX-License-Identifier: Apache-2.0
// Damages a training pack at random (same seed, same damage) and opens it: pack.json as it is, or a safetensors file
// with its size and hash put right, so that its header is what is judged. The outcome is a pack whose every pixel can
// be read, or an error that names the pack. Most useful with SRISP_SANITIZE. Usage: pack_fuzz [rounds] [seed]
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <random>

#include "pack/training_pack.h"
#include "scratch_folder.h"
#include "tiny_pack.h"

using namespace srisp;

namespace {

/// A few bytes of the first `range`, replaced by what tends to break parsers; or the end cut off; or a piece doubled.
void damage(std::string& bytes, std::size_t range, std::mt19937& random)
{
    static const std::string kPieces[] = { "-1",    "0",      "1e999", "18446744073709551616",
                                           "null",  "[]",     "{}",    "\"\"",
                                           "false", "nan",    ",",     "[[[[[[[[[[[[[[[[[[[[",
                                           "\xff",  "\\u0000" };
    const std::size_t count = 1 + random() % 3;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = random() % std::min(range, bytes.size());
        switch (random() % 4) {
        case 0:
            bytes[at] = char(random());
            break;
        case 1:
            bytes.replace(at, 1 + random() % 4, kPieces[random() % std::size(kPieces)]);
            break;
        case 2:
            bytes.insert(at, bytes.substr(at, random() % 40));
            break;
        case 3:
            bytes[at] = "0123456789{}[]\",:"[random() % 17];
            break;
        }
    }
    if (random() % 16 == 0)
        bytes.resize(random() % bytes.size());
}

std::uint64_t sum_of(const PackedImages& images)
{
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < images.entries.size(); ++i)
        if (const auto values = images.image(i))
            sum = std::accumulate(values->begin(), values->end(), sum);
    return sum;
}

/// Whether the outcome is one of those that are allowed; counts the packs that open.
bool judge(const std::string& folder, int& opened, std::uint64_t& sum)
{
    const auto pack = TrainingPack::open(folder);
    if (!pack)
        return pack.error().message.compare(0, 6, "pack '") == 0;
    ++opened;
    sum += sum_of((*pack)->photos()) + sum_of((*pack)->raws());
    const PackedCameras& cameras = (*pack)->cameras();
    return cameras.sensitivities.size() == cameras.names.size() * 3 * kPackWavelengths;
}

} // namespace

int main(int argc, char** argv)
{
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 3000;
    std::mt19937 random(argc > 2 ? unsigned(std::atoi(argv[2])) : 1);
    const ScratchFolder scratch;
    const std::string folder = scratch.path("pack");
    write_tiny_pack(folder);
    const std::vector<std::string> parts = { "photos", "raws", "cameras" };
    const std::string index = bytes_of(folder + "/pack.json");
    int opened = 0;
    std::uint64_t sum = 0;
    for (int round = 0; round < rounds; ++round) {
        const std::string part = parts[std::size_t(round) % 3], path = folder + "/" + part + ".safetensors";
        const std::string whole = bytes_of(path);
        if (round % 2 == 0) {
            std::string text = index;
            damage(text, text.size(), random);
            write_bytes(folder + "/pack.json", text);
        } else {
            edit_part(folder, part, [&](std::string& bytes) { damage(bytes, 400, random); });
        }
        if (!judge(folder, opened, sum)) {
            std::fprintf(stderr, "round %d: opens although it is damaged, or an error does not name the pack\n", round);
            return 1;
        }
        write_bytes(path, whole);
        write_bytes(folder + "/pack.json", index);
    }
    std::printf("%d damaged packs: %d opened, %d refused (sum of pixels %llu)\n", rounds, opened, rounds - opened,
                static_cast<unsigned long long>(sum));
    return opened > 0 && opened < rounds ? 0 : 1;
}
