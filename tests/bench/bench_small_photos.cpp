// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <filesystem>
#include <map>

#include <OpenImageIO/imagebuf.h>
#include <srisp/srisp.h>

#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// CPU milliseconds of all threads.
template<class Work> double cpu_ms(const Work& work)
{
    const auto now = [] {
        std::timespec time{};
        clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
        return double(time.tv_sec) * 1e3 + double(time.tv_nsec) * 1e-6;
    };
    const double before = now();
    work();
    return now() - before;
}

void decode(const std::string& path)
{
    const auto input = OIIO::ImageInput::open(path);
    if (!input)
        throw std::runtime_error(path + ": " + OIIO::geterror());
    const OIIO::ImageSpec& spec = input->spec();
    std::vector<float> pixels(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
    if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeFloat, pixels.data()))
        throw std::runtime_error(path + ": " + input->geterror());
}

/// CPU milliseconds of what is done for each photo.
struct Stages {
    std::vector<double> whole, applying;
};

} // namespace

BenchLines bench_small_photos(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    namespace fs = std::filesystem;
    constexpr int kPhotos = 24, kWidth = 640, kHeight = 480;
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "small.jpg").string();
    const BenchFixture fixture(settings);
    const PreparedReference reference = require(prepare_reference(*fixture.model, fixture.reference));
    Picture small = bench_picture(settings, kWidth, kHeight);
    OIIO::ImageBuf image(OIIO::ImageSpec(kWidth, kHeight, 3), small.rgb.data());
    if (!image.write(path, OIIO::TypeUInt8))
        throw std::runtime_error("'" + path + "': " + image.geterror());
    Options options;
    options.model = settings.model;
    require(unprocess(path, settings.reference, options)); // model and reference are kept from here on

    std::vector<double> decoding, selecting;
    std::map<Precision, Stages> stages;
    for (int i = 0; i < kPhotos; ++i) {
        const std::string copy = (folder.path() / (std::to_string(i) + ".jpg")).string();
        decoding.push_back(cpu_ms([&] { decode(path); }));
        selecting.push_back(cpu_ms([&] { require(select(*fixture.model, fixture.source, reference)); }));
        for (const Precision precision : { Precision::float32, Precision::fast }) {
            fs::remove(copy); // what is known of a file is kept: each time it is another
            fs::copy_file(path, copy);
            options.precision = precision;
            stages[precision].whole.push_back(cpu_ms([&] { require(unprocess(copy, settings.reference, options)); }));
            stages[precision].applying.push_back(
                cpu_ms([&] { apply_seconds(*fixture.applier(precision), small, settings.threads); }));
        }
    }
    const double decoded = median(decoding), selected = median(selecting);
    const auto line = [&](const std::string& name, Precision precision) {
        return BenchLine{ name, median(stages[precision].whole) / decoded, "x", "<= 2",
                          "CPU time of unprocess(), JPEGs of 640 x 480, model and reference kept; base: OpenImageIO's "
                          "decoding alone, " +
                              digits(decoded, 1) + " ms; select " + digits(selected, 1) + " ms, apply " +
                              digits(median(stages[precision].applying), 1) + " ms" };
    };
    const Stages& plain = stages[Precision::float32];
    return {
        line("small_photos", Precision::float32),
        line("small_fast", Precision::fast),
        { "small_around", (median(plain.whole) - selected - median(plain.applying)) / decoded, "x", "<= 1.2",
          "of small_photos, all but select and apply: decoding included" },
    };
}
