#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Installs what is missing, builds, runs every test; the last line is the count. Arguments go to ctest (`-R name`).
#   SRISP_BUILD_DIR    the build folder; default build/ (made, as a Release build, where it is not there)
#   SRISP_TEST_PREFIX  an installed tree to test, instead of one that the tests install for themselves
set -eu

source=$(cd "$(dirname "$0")/.." && pwd)
build=${SRISP_BUILD_DIR:-$source/build}
jobs=$(nproc)

sh "$source/tools/install-deps.sh"
# A folder that is there is configured again, too: it may have been without the tests, or without LibTorch.
if [ -f "$build/CMakeCache.txt" ]; then
    cmake -S "$source" -B "$build" -DSRISP_BUILD_TESTS=ON
else
    cmake -G Ninja -S "$source" -B "$build" -DCMAKE_BUILD_TYPE=Release
fi
cmake --build "$build" --parallel "$jobs"
build=$(cd "$build" && pwd)

# No display, no terminal, no user's settings; English messages.
export LC_ALL=C.UTF-8
# LibTorch's threads sleep while they wait: tests run side by side.
export OMP_WAIT_POLICY=passive
status=0
log=$build/Testing/Temporary/LastTest.log
rm -f "$log"
ctest --test-dir "$build" --parallel "$jobs" --timeout 900 --output-on-failure "$@" </dev/null || status=$?

# Counts test cases, not programs: doctest's own summary, or a script's last line "N passed, N failed"; a program that
# says neither is one test. A case that skips itself prints a line "SKIPPED what: why" and is not counted as passed.
[ -f "$log" ] || log=/dev/null
awk -v status="$status" -v no_trainer="$(sed -n 's/^SRISP_NO_TRAINER:INTERNAL=//p' "$build/CMakeCache.txt")" '
    /^(Unable to find executable|Failed test dependencies)/ { failed++; not_run = 1 }
    / Testing: / { counted = 0; failed_here = 0; self_skipped = 0 }
    /^SKIPPED /  { lines[++skipped] = $0; self_skipped++ }
    /^\[doctest\] test cases: / {
        for (i = 1; i < NF; i++) {
            if ($(i + 1) == "passed") passed += $i - self_skipped
            if ($(i + 1) == "failed") failed_here += $i
        }
        counted = 1
    }
    /^[0-9]+ passed, [0-9]+ failed$/ { passed += $1; failed_here += $3; counted = 1 }
    /^Test Passed\.$/ { if (!counted && !self_skipped && !not_run) passed++; not_run = 0 }
    /^Test Failed\.$/ { failed += failed_here ? failed_here : 1 }
    END {
        for (i = 1; i <= skipped; i++) print lines[i]
        if (no_trainer) print "NOT BUILT, NOT TESTED srisptrain, srispeval --pack: " no_trainer
        if (status && !failed) failed = 1
        printf "%d passed, %d failed, %d skipped\n", passed, failed, skipped
    }' "$log"
exit "$status"
