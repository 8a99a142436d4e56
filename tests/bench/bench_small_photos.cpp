// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <filesystem>

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

} // namespace

BenchLines bench_small_photos(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    namespace fs = std::filesystem;
    constexpr int kPhotos = 24;
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "small.jpg").string();
    const BenchFixture fixture(settings);
    Picture small = bench_picture(settings, 640, 480);
    OIIO::ImageBuf image(OIIO::ImageSpec(640, 480, 3), small.rgb.data());
    if (!image.write(path, OIIO::TypeUInt8))
        throw std::runtime_error("'" + path + "': " + image.geterror());
    Options options;
    options.model = settings.model;
    require(unprocess(path, settings.reference, options)); // model and reference are kept from here on

    std::vector<double> whole, decoding, selecting, applying;
    for (int i = 0; i < kPhotos; ++i) {
        const std::string copy = (folder.path() / (std::to_string(i) + ".jpg")).string(); // parameters are kept, too
        fs::copy_file(path, copy);
        decoding.push_back(cpu_ms([&] { decode(copy); }));
        whole.push_back(cpu_ms([&] { require(unprocess(copy, settings.reference, options)); }));
        selecting.push_back(cpu_ms([&] { require(select(*fixture.model, fixture.source, fixture.reference)); }));
        applying.push_back(cpu_ms([&] { apply_seconds(*fixture.applier(), small, settings.threads); }));
    }
    const double decoded = median(decoding), rest = median(whole) - median(selecting) - median(applying);
    return {
        { "small_photos", median(whole) / decoded, "x", "<= 2",
          "CPU time of unprocess(), JPEGs of 640 x 480, model and reference kept; base: OpenImageIO's decoding "
          "alone, " +
              digits(decoded, 1) + " ms; select " + digits(median(selecting), 1) + " ms, apply " +
              digits(median(applying), 1) + " ms" },
        { "small_around", rest / decoded, "x", "<= 1.2", "of these, all but select and apply: decoding included" },
    };
}
