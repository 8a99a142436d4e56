// SPDX-License-Identifier: Apache-2.0
// What a user of the library writes: a photo and a reference RAW → a RAW-like image.
#include <cstdio>

#include <srisp/srisp.h>

int main(int argc, char** argv)
{
    if (argc != 4)
        return std::fprintf(stderr, "usage: unprocess photo.jpg reference.dng result.exr\n"), 2;
    const auto raw = srisp::unprocess(argv[1], argv[2]);
    if (!raw)
        return std::fprintf(stderr, "%s\n", raw.error().message.c_str()), 1;
    const auto saved = raw->save(argv[3]);
    return saved ? 0 : (std::fprintf(stderr, "%s\n", saved.error().message.c_str()), 1);
}
