// SPDX-License-Identifier: Apache-2.0
// Memory that runs out anywhere gives an error, never a crash, a hang, or another result: also where it runs out in a
// thread that works for the caller.
#include "allocations.h"

#include <functional>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/apply.h>
#include <srisp/model.h>
#include <srisp/photo.h>
#include <srisp/reference.h>
#include <srisp/select.h>
#include <srisp/srisp.h>
#include <srisp/thumbnail.h>

#include "random_model.h"

#if SRISP_COUNTS_ALLOCATIONS

using namespace srisp;

namespace {

const std::string kSample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
constexpr int kThreads = 4;
constexpr std::size_t kLargePieces = 16 << 10;

/// OpenImageIO's threads, whatever the machine has; as before afterwards.
struct Threads {
    int before = OIIO::get_int_attribute("threads");
    Threads() { OIIO::attribute("threads", kThreads); }
    ~Threads() { OIIO::attribute("threads", before); }
};

/// Takes no memory.
std::size_t hash_of(const std::vector<float>& values)
{
    return std::hash<std::string_view>()(
        { reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float) });
}

} // namespace

TEST_CASE("select and apply without memory for one piece")
{
    const Threads threads;
    const ScratchFolder folder;
    const auto model = Model::load(random_model(3, 1).write(folder.path("random.safetensors")));
    REQUIRE(model);
    constexpr int kWidth = 96, kHeight = 80;
    Random random(7);
    std::vector<float> photo(std::size_t(3) * kWidth * kHeight), raw(photo.size());
    for (float& value : photo)
        value = random.uniform(0.05f, 0.95f);
    const ImageView source{ photo.data(), kWidth, kHeight, 3, std::ptrdiff_t(3) * kWidth };
    const MutableImageView target{ raw.data(), kWidth, kHeight, 3, std::ptrdiff_t(3) * kWidth };
    const Thumbnail thumbnail = make_thumbnail(source), reference = make_thumbnail(source, 3);
    for (const Precision precision : { Precision::float32, Precision::fast })
        allocations::fail_each(1, [&]() -> Expected<std::size_t> {
            const auto parameters = select(**model, thumbnail, reference);
            if (!parameters)
                return parameters.error();
            const auto applier = Applier::create(**model, *parameters, Direction::reverse, precision);
            if (!applier)
                return applier.error();
            std::fill(raw.begin(), raw.end(), -1.0f);
            ApplyOptions options;
            options.threads = kThreads;
            if (const Status run = (*applier)->run(source, target, options); !run)
                return run.error();
            return hash_of(raw);
        });
}

TEST_CASE("apply by a table without memory for one piece")
{
    const Threads threads;
    const ScratchFolder folder;
    const auto model = Model::load(random_model(1, 1).write(folder.path("random.safetensors")));
    REQUIRE(model);
    Parameters parameters;
    parameters.model_hash = (*model)->hash();
    parameters.tone_weights.fill({ 0.1f, 0.3f, 0.2f, 0.25f, 0.15f });
    std::vector<float> photo(std::size_t(3) * 96 * 80, 0.5f), raw(photo.size());
    const ImagePart part{ { photo.data(), 96, 80, 3, 3 * 96 }, 0, 0, 1000, 1000 }; // of an image that is worth a table
    allocations::fail_each(1, [&]() -> Expected<std::size_t> {
        const auto applier = Applier::create(**model, parameters, Direction::reverse, Precision::fast);
        if (!applier)
            return applier.error();
        std::fill(raw.begin(), raw.end(), -1.0f);
        ApplyOptions options;
        options.threads = kThreads;
        if (const Status run = (*applier)->run(part, { 0, 96, 0, 80 }, { raw.data(), 96, 80, 3, 3 * 96 }, options);
            !run)
            return run.error();
        return hash_of(raw);
    });
}

TEST_CASE("a reference without memory for one large piece")
{
    const Threads threads;
    allocations::fail_each(kLargePieces, [&]() -> Expected<std::size_t> {
        const auto reference = load_reference(kSample + "reference.dng");
        if (!reference)
            return reference.error();
        return hash_of((*reference)->thumbnail.rgb);
    });
}

TEST_CASE("a photo without memory for one large piece")
{
    const Threads threads;
    allocations::fail_each(kLargePieces, [&]() -> Expected<std::size_t> {
        const auto thumbnail = load_photo_thumbnail(kSample + "photo.jpg");
        if (!thumbnail)
            return thumbnail.error();
        return hash_of(thumbnail->rgb);
    });
    allocations::fail_each(kLargePieces, [&]() -> Expected<std::size_t> {
        const auto image = unprocess(kSample + "photo.jpg", kSample + "reference.dng");
        if (!image)
            return image.error();
        return hash_of(image->pixels());
    });
}

#endif
