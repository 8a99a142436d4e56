// SPDX-License-Identifier: Apache-2.0
// What a user of the library writes: a grey picture and a reference RAW → parameters, and the picture's first pixel.
#include <cstdio>

#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/reference.h>
#include <srisp/select.h>

int main(int, char** argv)
{
    srisp::Thumbnail photo;
    photo.rgb.assign(photo.rgb.size(), 0.5f);
    const auto model = srisp::Model::load("default");
    const auto reference = srisp::load_reference(argv[1]);
    if (!model || !reference)
        return std::fprintf(stderr, "%s\n", (model ? reference.error() : model.error()).message.c_str()), 1;
    const auto parameters = srisp::select(**model, photo, (*reference)->thumbnail);
    const auto applier = srisp::Applier::create(**model, *parameters, srisp::Direction::reverse);
    srisp::MutableImageView pixels{ photo.rgb.data(), srisp::kThumbnailSize, srisp::kThumbnailSize, 3,
                                    3 * srisp::kThumbnailSize };
    if (!(*applier)->run(pixels, pixels))
        return 1;
    std::printf("%s %s %.4f %.4f %.4f\n", (*model)->path().c_str(), (*reference)->facts.cfa_pattern.c_str(),
                photo.rgb[0], photo.rgb[1], photo.rgb[2]);
}
