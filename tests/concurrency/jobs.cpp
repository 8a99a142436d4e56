// SPDX-License-Identifier: Apache-2.0
#include "concurrency/jobs.h"

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string_view>

#include <OpenImageIO/hash.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imagecache.h>
#include <srisp/srisp.h>

namespace fs = std::filesystem;
using namespace srisp;

namespace {

constexpr int kTile = 32;

void require(bool done, const std::string& what)
{
    if (!done)
        throw std::runtime_error(what + " " + OIIO::geterror());
}

template<class Value> Value given(Expected<Value> expected)
{
    if (!expected)
        throw std::runtime_error(expected.error().message);
    return std::move(*expected);
}

std::string digest(const void* data, std::size_t bytes)
{
    return std::to_string(OIIO::xxhash::xxhash(data, bytes)) + " ";
}
std::string digest(const std::vector<float>& values)
{
    return digest(values.data(), values.size() * sizeof(float));
}
/// Of the attributes' own bits: their text depends on the host's locale.
std::string digest(const OIIO::ImageSpec& spec)
{
    std::string all = std::to_string(spec.width) + " " + std::to_string(spec.height) + " " + spec.format.c_str();
    for (const OIIO::ParamValue& value : spec.extra_attribs) {
        const bool is_text = value.type().basetype == OIIO::TypeDesc::STRING;
        all += "\n" + value.name().string() + " ";
        all += is_text ? value.get_string() : std::string(static_cast<const char*>(value.data()), value.datasize());
        fprintf(stderr, "@ %s %s\n", value.name().c_str(), value.get_string().c_str());
    }
    return digest(all.data(), all.size());
}
std::string digest(const Expected<Image>& image)
{
    return image ? digest(image->pixels()) + digest(image->spec()) : image.error().message;
}

/// Writes a photo of 8 or 16 bits, half or float, in tiles or not.
std::string write_photo(const OIIO::ImageBuf& photo, const std::string& path, OIIO::TypeDesc type, int tile = 0)
{
    OIIO::ImageBuf copy = photo;
    copy.set_write_format(type);
    copy.set_write_tiles(tile, tile);
    require(copy.write(path), path);
    return path;
}

std::string cut(const std::string& path, const std::string& to)
{
    fs::copy_file(path, to);
    fs::resize_file(to, fs::file_size(path) / 2);
    return to;
}

// What is done with a name that the plugin answers for.

std::unique_ptr<OIIO::ImageInput> open(const std::string& name)
{
    return OIIO::ImageInput::open(name);
}

std::string read_whole(const std::string& name)
{
    const auto input = open(name);
    if (!input)
        return OIIO::geterror();
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> pixels(spec.image_pixels() * std::size_t(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
        return input->geterror();
    return digest(pixels) + digest(spec);
}

std::string read_rows(OIIO::ImageInput& input, int y0, int y1)
{
    const OIIO::ImageSpec spec = input.spec_dimensions(0, 0);
    std::vector<float> rows(std::size_t(y1 - y0) * std::size_t(spec.width) * std::size_t(spec.nchannels));
    const bool read =
        spec.tile_width
            ? input.read_tiles(0, 0, 0, spec.width, y0, y1, 0, 1, 0, spec.nchannels, OIIO::TypeFloat, rows.data())
            : input.read_scanlines(0, 0, y0, y1, 0, 0, spec.nchannels, OIIO::TypeFloat, rows.data());
    return read ? digest(rows) : input.geterror();
}

std::string read_bands(const std::string& name)
{
    const auto input = open(name);
    if (!input)
        return OIIO::geterror();
    std::string digests;
    for (int y = 0, height = input->spec().height; y < height; y += kTile)
        digests += read_rows(*input, y, std::min(y + kTile, height));
    return digests;
}

std::string read_tile(const std::string& name)
{
    const auto input = open(name);
    if (!input)
        return OIIO::geterror();
    const OIIO::ImageSpec spec = input->spec();
    std::vector<float> tile(std::size_t(spec.tile_width) * std::size_t(spec.tile_height * spec.nchannels));
    if (!input->read_tile(spec.tile_width, spec.tile_height, 0, OIIO::TypeFloat, tile.data()))
        return input->geterror();
    return digest(tile);
}

using Cache = std::shared_ptr<OIIO::ImageCache>;

Cache make_cache()
{
    return Cache(OIIO::ImageCache::create(false), [](OIIO::ImageCache* cache) { OIIO::ImageCache::destroy(cache); });
}

std::string read_region(OIIO::ImageCache& cache, const std::string& name)
{
    constexpr int kSide = 50;
    std::vector<float> pixels(kSide * kSide * 3);
    if (!cache.get_pixels(OIIO::ustring(name), 0, 0, 20, 20 + kSide, 10, 10 + kSide, 0, 1, 0, 3, OIIO::TypeFloat,
                          pixels.data()))
        return cache.geterror();
    return digest(pixels);
}

std::string read_buffer(const std::string& name)
{
    OIIO::ImageBuf image(name);
    if (!image.read(0, 0, true, OIIO::TypeFloat))
        return image.geterror();
    return digest(image.localpixels(), image.spec().image_bytes());
}

/// The DNG that the other plugin writes.
std::string write_dng(const std::string& name, const std::string& folder)
{
    static std::atomic<int> count{ 0 };
    const std::string path = folder + "/written" + std::to_string(++count) + ".dng";
    OIIO::ImageBuf image(name);
    const bool written = image.read(0, 0, true, OIIO::TypeFloat) && image.write(path);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    std::error_code none;
    fs::remove(path, none);
    return written ? digest(bytes.data(), bytes.size()) : image.geterror();
}

/// The files.
struct Files {
    std::string folder, jpeg, png, tiff, exr, texture, cut_jpeg, text, dng, camera_rgb, cut_dng, raw;
};

Files write_files(const std::string& folder)
{
    const std::string sample = std::string(SRISP_SOURCE_DIR) + "/configs/sample/";
    Files files;
    files.folder = folder;
    OIIO::ImageBuf whole(sample + "photo.jpg"), photo;
    require(OIIO::ImageBufAlgo::resize(photo, whole, "", 0, OIIO::ROI(0, 160, 0, 120, 0, 1, 0, 3)), "photo.jpg");
    files.jpeg = write_photo(photo, folder + "/photo.jpg", OIIO::TypeUInt8);
    files.png = write_photo(photo, folder + "/photo.png", OIIO::TypeUInt16);
    files.tiff = write_photo(photo, folder + "/tiles.tif", OIIO::TypeUInt16, kTile);
    files.exr = write_photo(photo, folder + "/tiles.exr", OIIO::TypeHalf, kTile);
    files.cut_jpeg = cut(files.jpeg, folder + "/cut.jpg");
    files.text = folder + "/text.jpg";
    std::ofstream(files.text) << "no picture";
    files.dng = folder + "/reference.dng";
    fs::copy_file(sample + "reference.dng", files.dng);
    files.cut_dng = cut(files.dng, folder + "/cut.dng");
    const Image raw = given(unprocess(files.exr, files.dng));
    files.raw = folder + "/raw.exr";
    require(bool(raw.save(files.raw, OIIO::TypeFloat)), files.raw);
    files.camera_rgb = folder + "/other.exr";
    require(bool(given(unprocess(sample + "photo.jpg", files.dng)).save(files.camera_rgb, OIIO::TypeFloat)), "other");
    return files;
}

void add_plugin_jobs(const Files& files, std::vector<Job>& jobs)
{
    const std::string by_dng = ".srisp?reference=" + files.dng, by_exr = ".srisp?reference=" + files.camera_rgb;
    const Cache shared = make_cache();
    std::vector<std::string> names;
    for (const std::string& photo : { files.jpeg, files.png, files.tiff, files.exr })
        for (const std::string& reference : { by_dng, by_exr })
            for (const char* options : { "", "&model=spatial", "&precision=fast", "&mosaic=RGGB&noise=upi",
                                         "&develop=ACEScg", "&resize=80x60&isolate=0", "&brightness=sample&seed=7" })
                names.push_back(photo + reference + options);
    for (const char* options : { "", "&model=spatial" })
        names.push_back(files.raw + ".srisp?direction=forward" + options);
    for (const std::string& name : { files.cut_jpeg + by_dng, files.text + by_dng, files.folder + "/none.jpg" + by_dng,
                                     files.jpeg + ".srisp?reference=" + files.cut_dng,
                                     files.jpeg + ".srisp?reference=" + files.folder + "/none.dng",
                                     files.jpeg + by_dng + "&modle=spatial", files.jpeg + by_dng + "&model=none" })
        names.push_back(name);
    for (const std::string& name : names) {
        jobs.push_back({ "read " + name, [=] { return read_whole(name); } });
        jobs.push_back({ "bands of " + name, [=] { return read_bands(name); } });
        jobs.push_back({ "a region of " + name, [=] { return read_region(*make_cache(), name); } });
    }
    for (const std::string& name : { files.jpeg + by_dng, files.exr + by_exr + "&model=spatial" })
        jobs.push_back({ "a region of the cached " + name, [=] { return read_region(*shared, name); } });
    jobs.push_back({ "a tile", [=] { return read_tile(files.tiff + by_dng); } });
    jobs.push_back({ "a buffer", [=] { return read_buffer(files.png + by_dng); } });
    jobs.push_back({ "a DNG", [=] { return write_dng(files.jpeg + by_dng, files.folder); } });
    jobs.push_back({ "a mosaic's DNG", [=] { return write_dng(files.jpeg + by_dng + "&mosaic=RGGB", files.folder); } });
    for (const std::string& name : { files.jpeg + by_dng, files.tiff + by_exr + "&model=spatial" }) {
        const std::shared_ptr<OIIO::ImageInput> input = open(name);
        require(bool(input), name);
        for (const int y : { 0, kTile, 2 * kTile })
            jobs.push_back({ "rows of the shared " + name, [=] { return read_rows(*input, y, y + kTile); } });
    }
}

void add_library_jobs(const Files& files, std::vector<Job>& jobs)
{
    for (const char* const name : { "default", "spatial" }) {
        const auto model = given(Model::load(name));
        const auto reference = given(load_reference(files.dng));
        const auto prepared = given(prepare_reference(*model, reference->thumbnail));
        const auto thumbnail = given(load_photo_thumbnail(files.png));
        const auto chosen = [=] { return select(*model, thumbnail, prepared); };
        const auto applier = given(Applier::create(*model, given(chosen()), Direction::reverse));
        const auto photo = std::make_shared<const Image>(given(read_photo(files.png)));
        const OIIO::ImageSpec layout(photo->spec().width, photo->spec().height, 3, OIIO::TypeFloat);
        Options options;
        options.model = name;
        jobs.push_back({ "select", [=] {
                            const auto parameters = chosen();
                            return parameters ? to_json(*parameters) : parameters.error().message;
                        } });
        jobs.push_back({ "apply", [=] {
                            std::vector<float> out(layout.image_pixels() * 3);
                            const Status done = applier->run(
                                photo->view(), { out.data(), layout.width, layout.height, 3, 3 * layout.width });
                            return done ? digest(out) : done.error().message;
                        } });
        jobs.push_back({ "unprocess a file", [=] { return digest(unprocess(files.jpeg, files.dng, options)); } });
        jobs.push_back({ "unprocess memory", [=] {
                            MemoryImage memory;
                            memory.spec = photo->spec();
                            memory.pixels = photo->pixels().data();
                            return digest(unprocess(memory, reference, options));
                        } });
    }
    jobs.push_back({ "process", [=] { return digest(process(files.raw)); } });
    jobs.push_back({ "develop", [=] { return digest(develop(files.raw)); } });
    jobs.push_back({ "develop a DNG", [=] { return digest(develop(files.dng)); } });
    jobs.push_back({ "unprocess what is cut", [=] { return digest(unprocess(files.cut_jpeg, files.dng)); } });
    jobs.push_back({ "unprocess without a reference", [=] { return digest(unprocess(files.jpeg, "none.dng")); } });
    jobs.push_back({ "encode", [=] {
                        const auto image = unprocess(files.jpeg, files.dng);
                        const auto bytes = image ? image->encode("raw.tif") : image.error();
                        return bytes ? digest(bytes->data(), bytes->size()) : bytes.error().message;
                    } });
    const auto thumbnail_of = [](const Expected<std::shared_ptr<const Reference>>& reference) {
        return reference ? digest((*reference)->thumbnail.rgb) : reference.error().message;
    };
    for (const bool isolate : { false, true })
        for (const std::string& path : { files.dng, files.cut_dng, files.camera_rgb })
            jobs.push_back({ "load " + path, [=] { return thumbnail_of(load_reference(path, isolate)); } });
    jobs.push_back({ "a reference that looks new", [=] {
                        std::error_code none;
                        fs::last_write_time(files.dng, fs::file_time_type::clock::now(), none);
                        return thumbnail_of(load_reference_cached(files.dng));
                    } });
}

} // namespace

std::vector<Job> make_jobs(const std::string& folder)
{
    OIIO::attribute("plugin_searchpath", std::string(SRISP_BUILD_DIR) + "/lib/srisp");
    const Files files = write_files(folder);
    std::vector<Job> jobs;
    add_plugin_jobs(files, jobs);
    add_library_jobs(files, jobs);
    return jobs;
}

std::vector<std::string> results_of(const std::vector<Job>& jobs)
{
    const int threads = OIIO::get_int_attribute("threads");
    OIIO::attribute("threads", 1);
    std::vector<std::string> results;
    for (const Job& job : jobs)
        results.push_back(job.run());
    OIIO::attribute("threads", threads);
    return results;
}

bool gives(const Job& job, const std::string& expected)
{
    const std::string result = job.run();
    if (result != expected)
        std::fprintf(stderr, "WRONG %s: %s; expected %s\n", job.name.c_str(), result.c_str(), expected.c_str());
    return result == expected;
}
