// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "bench_fixture.h"
#include "fma_peak.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

namespace {

/// Seven encoders and the tone map, at the model's own size [method 2].
double select_multiply_adds(const Model& model)
{
    const auto size = model.metadata().find("selection_size");
    const double pixels = std::pow(size == model.metadata().end() ? 256 : std::stod(size->second), 2);
    const double encoders_of_256 = 2 * 212.3e6 + 63.7e6 + 4 * 120.3e6;
    return pixels * (encoders_of_256 / (256 * 256) + kMultiplyAddsPerPixel * std::pow(model.kernel_size() / 3.0, 2));
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
    return {
        { "select", median(times) * 1e3, "ms", "<= 5",
          "one core, thumbnails given; its multiply-adds alone take " + digits(median(ideal) * 1e3, 1) +
              " ms at the peak" },
        { "select_kept", median(times_kept) * 1e3, "ms", "<= 3", "the same with the reference's part kept" },
    };
}
