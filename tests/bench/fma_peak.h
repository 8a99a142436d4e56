// SPDX-License-Identifier: Apache-2.0
#pragma once

/// float32 multiply-adds per second that `threads` cores reach together in a loop that does nothing else, on the widest
/// instruction set of this machine: the limit that the other figures are compared with. Runs for about 0.3 s.
double measure_fma_peak(int threads);

/// Name of that instruction set, among those that this program was built for.
const char* instruction_set();

bool has_avx512();

/// While it lives, all kernels and the peak do without AVX-512.
struct WithoutAvx512 {
    WithoutAvx512();
    ~WithoutAvx512();
};
