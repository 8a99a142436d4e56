// SPDX-License-Identifier: Apache-2.0
#include <libraw/libraw.h>
#include <srisp/reference.h>

#include "bench_fixture.h"
#include "measuring.h"
#include "require.h"

/// Only with a reference in the settings: there is no RAW file of many pixels to be had otherwise.
BenchLines bench_reference(const BenchSettings& settings)
{
    if (settings.reference.empty())
        return {};
    std::vector<double> apart, ours, theirs;
    for (int i = 0; i < 7; ++i) {
        apart.push_back(seconds([&] { require(srisp::load_reference(settings.reference)); }));
        ours.push_back(seconds([&] { require(srisp::load_reference(settings.reference, false)); }));
        theirs.push_back(seconds([&] {
            LibRaw raw;
            if (raw.open_file(settings.reference.c_str()) != 0 || raw.unpack() != 0)
                throw std::runtime_error("'" + settings.reference + "': LibRaw cannot unpack it");
        }));
    }
    return { { "reference", median(ours) / median(theirs), "x", "<= 1.1",
               settings.reference + " to its thumbnail, " + digits(median(ours) * 1e3, 0) +
                   " ms with isolate=0; base: LibRaw's open and unpack" },
             { "isolate", (median(apart) - median(ours)) * 1e3, "ms", "<= 50",
               "more with a process of its own, " + digits(median(apart) * 1e3, 0) + " ms in all" } };
}
