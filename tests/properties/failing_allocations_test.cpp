// SPDX-License-Identifier: Apache-2.0
// Memory that runs out anywhere gives an error, never a crash, a hang, or another result: also where it runs out in a
// thread that works for the caller.
#include "allocations.h"

#include <filesystem>
#include <functional>
#include <string_view>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/apply.h>
#include <srisp/develop.h>
#include <srisp/dng.h>
#include <srisp/metrics.h>
#include <srisp/model.h>
#include <srisp/mosaic.h>
#include <srisp/neutral_rendition.h>
#include <srisp/noise.h>
#include <srisp/options.h>
#include <srisp/parameters.h>
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
constexpr std::size_t kAny = 1, kLargePieces = 16 << 10;
/// nlohmann::json needs memory to free an array or object, 16 bytes for each value, and ends the process without: so
/// what reads small JSON is not tried.
constexpr std::size_t kBesideJson = 1 << 10;

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

std::size_t hash_of(std::string_view text)
{
    return std::hash<std::string_view>()(text);
}

/// A step that gives a hash of what a call gives; `hash` takes no memory.
template<class Call, class Hash> auto hashed(const Call& call, const Hash& hash)
{
    return [&call, &hash]() -> Expected<std::size_t> {
        const auto result = call();
        if (!result)
            return result.error();
        return hash(*result);
    };
}

std::size_t hash_of_image(const Image& image)
{
    return hash_of(image.pixels());
}

/// An image that is smooth, with some noise.
struct Picture {
    static constexpr int width = 96, height = 80;
    std::vector<float> rgb;
    explicit Picture(std::uint64_t seed)
    {
        Random random(seed);
        for (int i = 0; i < width * height * 3; ++i)
            rgb.push_back(0.1f + 0.7f * float(i) / float(width * height * 3) + random.uniform(0, 0.1f));
    }
    ImageView view() const { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
    MutableImageView target() { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
};

const std::array<float, 9> kMatrix{ 0.6f, 0.3f, 0.1f, 0.2f, 0.7f, 0.1f, 0.1f, 0.2f, 0.9f };

CameraFacts some_camera()
{
    CameraFacts facts;
    facts.make = "Anna";
    facts.model = "One";
    facts.cfa_pattern = "RGGB";
    facts.color_matrices.push_back({ kMatrix, 21, {} });
    facts.as_shot_neutral = { 0.5f, 1, 0.7f };
    facts.noise_profile = { 1e-4, 1e-6 };
    return facts;
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
        allocations::fail_each(kAny, [&]() -> Expected<std::size_t> {
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
    allocations::fail_each(kAny, [&]() -> Expected<std::size_t> {
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

TEST_CASE("a model without memory for one piece")
{
    const ScratchFolder folder;
    for (const ModelFile& file : { random_model(1, 1), random_model(3, 2), random_srisp_7_model(1, 3) }) {
        const std::string path = file.write(folder.path("random.safetensors"));
        const auto load = [&] { return Model::load(path); };
        allocations::fail_each(kLargePieces, hashed(load, [](const auto& model) { return hash_of(model->hash()); }));
    }
}

TEST_CASE("parameters as JSON and a prepared reference without memory for one piece")
{
    const ScratchFolder folder;
    const auto model = Model::load(random_model(1, 1).write(folder.path("random.safetensors")));
    REQUIRE(model);
    const Thumbnail thumbnail = make_thumbnail(Picture(1).view());
    const auto parameters = select(**model, thumbnail, make_thumbnail(Picture(2).view()));
    REQUIRE(parameters);
    const auto to_text = [&] { return allocations::value_or_error([&] { return to_json(*parameters); }); };
    allocations::fail_each(kBesideJson, hashed(to_text, [](const std::string& text) { return hash_of(text); }));
    const auto prepare = [&] { return prepare_reference(**model, thumbnail); };
    allocations::fail_each(kAny, hashed(prepare, [](const auto&) { return std::size_t(0); }));
}

TEST_CASE("a development without memory for one piece")
{
    const Threads threads;
    DevelopSource source;
    source.camera = some_camera();
    Options options;
    REQUIRE(set_option(options, "develop", "ACEScg"));
    const auto choose = [&] {
        std::vector<std::string> notes;
        return choose_development(source, options, notes);
    };
    allocations::fail_each(kAny,
                           hashed(choose, [](const Development& made) { return std::size_t(made.white * 1e6f); }));
    const auto development = choose();
    REQUIRE(development);
    const Picture picture(3);
    Picture result(4);
    allocations::fail_each(kAny, [&]() -> Expected<std::size_t> {
        std::fill(result.rgb.begin(), result.rgb.end(), -1.0f);
        if (const Status made = develop(*development, picture.view(), result.target(), nullptr, kThreads); !made)
            return made.error();
        if (const Status undone = undo_development(*development, result.view(), result.target(), kThreads); !undone)
            return undone.error();
        return hash_of(result.rgb);
    });
}

TEST_CASE("mosaic and noise without memory for one piece")
{
    const Threads threads;
    const Picture picture(5);
    std::vector<float> plane(std::size_t(Picture::width) * Picture::height);
    const MutablePlaneView target{ plane.data(), Picture::width, Picture::height, 1, Picture::width };
    const CameraFacts facts = some_camera();
    allocations::fail_each(kAny, [&]() -> Expected<std::size_t> {
        const auto noise = profile_noise(facts);
        if (!noise)
            return noise.error();
        if (const Status made = make_mosaic(picture.view(), {}, target, kThreads); !made)
            return made.error();
        if (const Status added = add_noise(target, {}, *noise, 7, kThreads); !added)
            return added.error();
        return hash_of(plane);
    });
}

TEST_CASE("measures, thumbnails and renditions without memory for one piece throw std::bad_alloc")
{
    const Threads threads;
    const Picture one(6), other(7);
    const auto measure = [&] {
        return allocations::value_or_error([&] {
            LabHistogram histogram, same;
            histogram.add(one.view(), kMatrix);
            same.add(other.view(), kMatrix);
            const std::vector<double> a{ 1, 2, 3 }, b{ 3, 1, 2 };
            return psnr(one.view(), other.view()) + ssim(one.view(), other.view()) +
                   angular_error(one.view(), other.view()).mean() + highlight_errors(one.view(), other.view()).sum +
                   mean_delta_e2000(one.view(), other.view(), kMatrix) + histogram.intersection(same) +
                   rank_correlation(a, b) + log_brightness(one.view());
        });
    };
    allocations::fail_each(kAny, hashed(measure, [](double sum) { return std::size_t(sum * 1e9); }));
    Reference reference;
    reference.thumbnail = make_thumbnail(one.view());
    reference.facts = some_camera();
    const auto render = [&] { return allocations::value_or_error([&] { return neutral_rendition(reference); }); };
    allocations::fail_each(kAny, hashed(render, [](const Thumbnail& made) { return hash_of(made.rgb); }));
    const auto shrink = [&] { return allocations::value_or_error([&] { return make_thumbnail(one.view(), 6); }); };
    allocations::fail_each(kAny, hashed(shrink, [](const Thumbnail& made) { return hash_of(made.rgb); }));
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
}

TEST_CASE("the front door without memory for one large piece")
{
    const Threads threads;
    const ScratchFolder folder;
    const std::string photo = kSample + "photo.jpg", reference = kSample + "reference.dng";
    const auto raw = unprocess(photo, reference);
    REQUIRE(raw);
    Options sensor, development, exact;
    REQUIRE(set_option(sensor, "mosaic", "RGGB"));
    REQUIRE(set_option(sensor, "noise", "shot=1e-4,read=1e-6"));
    REQUIRE(set_option(development, "develop", "ACEScg"));
    REQUIRE(set_option(exact, "precision", "float32"));
    const ImageInput image(
        MemoryImage{ raw->spec(), raw->pixels().data(), OIIO::AutoStride, OIIO::AutoStride, OIIO::AutoStride, "raw" });
    const auto whole = [](const auto& call) { allocations::fail_each(kLargePieces, hashed(call, hash_of_image)); };
    whole([&] { return unprocess(photo, reference); });
    whole([&] { return unprocess(photo, reference, exact); });
    whole([&] { return process(image); });
    whole([&] { return develop(image, development); });
    whole([&] { return sense(image, sensor); });
    whole([&] { return read_photo(photo); });
}

TEST_CASE("a file is written without memory for one large piece: it is whole, or as it was, and nothing is beside it")
{
    const Threads threads;
    const auto raw = unprocess(kSample + "photo.jpg", kSample + "reference.dng");
    REQUIRE(raw);
    // Without memory OpenImageIO's writers of JPEG and JPEG 2000 end the process, and do not say why.
    for (const char* const kind : { "exr", "tif", "png" }) {
        CAPTURE(kind);
        const ScratchFolder folder;
        const std::string path = folder.file(std::string("raw.") + kind, "old");
        const auto save = [&]() -> Expected<std::size_t> {
            write_file(path, "old");
            const Status saved = raw->save(path);
            const std::size_t there = std::filesystem::file_size(path);
            const std::filesystem::directory_iterator files(std::filesystem::path(path).parent_path());
            CHECK(std::distance(begin(files), end(files)) == 1);
            if (!saved) {
                CHECK(there == 3);
                return saved.error();
            }
            return there;
        };
        allocations::fail_each(kLargePieces, save);
    }
    const ScratchFolder folder;
    const std::string path = folder.path("raw.dng");
    DngImage image;
    image.width = raw->spec().width;
    image.height = raw->spec().height;
    image.planes = 3;
    image.floats = raw->pixels().data();
    image.row_stride = std::ptrdiff_t(3) * image.width;
    image.facts = some_camera();
    DngOptions options;
    options.compression = DngCompression::deflate;
    options.bits = 16;
    options.threads = kThreads;
    const auto write = [&] { return write_dng(path, image, options); };
    allocations::fail_each(kLargePieces, hashed(write, [](const auto& notes) { return notes.size(); }));
}

#endif
