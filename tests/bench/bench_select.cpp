// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include <OpenImageIO/imagebuf.h>

#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "fma_peak.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

// Seven encoders and, on 256², the tone map [method 2].
constexpr double kSelectMultiplyAdds = 2 * 212.3e6 + 63.7e6 + 4 * 120.3e6 + kMultiplyAddsPerPixel * 256 * 256;
constexpr int kPhotos = 24;

/// Seconds for reading and for select and apply, of small photos one after the other on one thread.
std::pair<double, double> photo_seconds(const BenchFixture& fixture, const std::string& path)
{
    double read = 0, work = 0;
    for (int i = 0; i < kPhotos; ++i) {
        Picture photo(1, 1);
        read += seconds([&] { photo = load_photo(path); });
        work += seconds([&] {
            const Parameters parameters =
                require(select(*fixture.model, make_thumbnail(photo.view()), fixture.reference));
            apply_seconds(*require(Applier::create(*fixture.model, parameters, Direction::reverse)), photo, 1);
        });
    }
    return { read, work };
}

} // namespace

BenchLines bench_select(const BenchSettings& settings)
{
    const BenchFixture fixture(settings);
    std::vector<double> times, ideal;
    for (int i = 0; i < 10; ++i) {
        times.push_back(seconds([&] { require(select(*fixture.model, fixture.source, fixture.reference)); }));
        ideal.push_back(kSelectMultiplyAdds / measure_fma_peak(1));
    }
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "small.jpg").string();
    const Picture small = bench_picture(settings, 640, 480);
    OIIO::ImageBuf image(OIIO::ImageSpec(640, 480, 3), const_cast<float*>(small.rgb.data()));
    if (!image.write(path, OIIO::TypeUInt8))
        throw std::runtime_error("'" + path + "': " + image.geterror());
    const auto [read, work] = photo_seconds(fixture, path);
    return {
        { "select", median(times) * 1e3, "ms", "<= 20",
          "one core, thumbnails given; its multiply-adds alone take " + digits(median(ideal) * 1e3, 0) +
              " ms at the peak" },
        { "small_photos", 100 * work / (read + work), "%", ">= 80",
          "of the time for JPEGs of 640 × 480 is select and apply, one thread; " +
              digits((read + work) / kPhotos * 1e3, 0) + " ms per photo" },
    };
}
