// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include <OpenImageIO/imagebuf.h>

#include "../../tools/common/temporary_folder.h"
#include "bench_fixture.h"
#include "fma_peak.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Seven encoders and the tone map, at the model's own size [method 2].
double select_multiply_adds(const Model& model)
{
    const auto size = model.metadata().find("selection_size");
    const double pixels = std::pow(size == model.metadata().end() ? 256 : std::stod(size->second), 2);
    const double encoders_of_256 = 2 * 212.3e6 + 63.7e6 + 4 * 120.3e6;
    return pixels * (encoders_of_256 / (256 * 256) + kMultiplyAddsPerPixel * std::pow(model.kernel_size() / 3.0, 2));
}

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
    const PreparedReference kept = require(prepare_reference(*fixture.model, fixture.reference));
    std::vector<double> times, times_kept, ideal;
    for (int i = 0; i < 30; ++i) {
        times.push_back(seconds([&] { require(select(*fixture.model, fixture.source, fixture.reference)); }));
        times_kept.push_back(seconds([&] { require(select(*fixture.model, fixture.source, kept)); }));
        ideal.push_back(select_multiply_adds(*fixture.model) / measure_fma_peak(1));
    }
    const TemporaryFolder folder;
    const std::string path = (folder.path() / "small.jpg").string();
    const Picture small = bench_picture(settings, 640, 480);
    OIIO::ImageBuf image(OIIO::ImageSpec(640, 480, 3), const_cast<float*>(small.rgb.data()));
    if (!image.write(path, OIIO::TypeUInt8))
        throw std::runtime_error("'" + path + "': " + image.geterror());
    const auto [read, work] = photo_seconds(fixture, path);
    return {
        { "select", median(times) * 1e3, "ms", "<= 5",
          "one core, thumbnails given; its multiply-adds alone take " + digits(median(ideal) * 1e3, 1) +
              " ms at the peak" },
        { "select_kept", median(times_kept) * 1e3, "ms", "<= 3", "the same with the reference's part kept" },
        { "small_photos", 100 * work / (read + work), "%", ">= 80",
          "of the time for JPEGs of 640 × 480 is select and apply, one thread; " +
              digits((read + work) / kPhotos * 1e3, 0) + " ms per photo" },
    };
}
