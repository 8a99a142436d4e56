// SPDX-License-Identifier: Apache-2.0
#include "bench_fixture.h"
#include "fma_peak.h"
#include "measuring.h"
#include "require.h"

using namespace srisp;

namespace {

// Seven encoders and, on 256², the tone map [method 2].
constexpr double kSelectMultiplyAdds = 2 * 212.3e6 + 63.7e6 + 4 * 120.3e6 + kMultiplyAddsPerPixel * 256 * 256;

} // namespace

BenchLines bench_select(const BenchSettings& settings)
{
    const BenchFixture fixture(settings);
    std::vector<double> times, ideal;
    for (int i = 0; i < 10; ++i) {
        times.push_back(seconds([&] { require(select(*fixture.model, fixture.source, fixture.reference)); }));
        ideal.push_back(kSelectMultiplyAdds / measure_fma_peak(1));
    }
    return {
        { "select", median(times) * 1e3, "ms", "<= 20",
          "one core, thumbnails given; its multiply-adds alone take " + digits(median(ideal) * 1e3, 0) +
              " ms at the peak" },
    };
}
