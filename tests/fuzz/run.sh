#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Fuzzes with libFuzzer, address and undefined-behaviour sanitizers. From anywhere:
#   sh tests/fuzz/run.sh --minutes N [TARGET...]   each target so long (all of them where none is named)
#   sh tests/fuzz/run.sh --seconds N [TARGET...]
#   sh tests/fuzz/run.sh --totals                  what all runs so far come to
#   sh tests/fuzz/run.sh --merge [TARGET...]       adds to the seeds the fewest inputs, up to 512 bytes, that cover what was found
# Prints a table; exit code 1 where there was a finding: a crash, a leak, more than 5 s or 2 GB for one input. The input is
# kept in the build folder, SRISP_FUZZ_BUILD_DIR (default build-fuzz), with the log and what each target has found worth
# keeping so far. SRISP_FUZZ_JOBS targets run at a time (default: as many as there are processors). SRISP_FUZZ_TIMEOUT: other than
# 5 s, for a machine that does other work.
set -eu

root=$(cd "$(dirname "$0")/../.." && pwd)
build=${SRISP_FUZZ_BUILD_DIR:-$root/build-fuzz}
seeds=$root/tests/fuzz/seeds
work=$build/fuzz
memory=/dev/shm # for files of the targets: nothing waits for a disk there
[ -w "$memory" ] || memory=${TMPDIR:-/tmp}

usage() {
    sed -n 's/^#   //p' "$0" >&2
    exit 2
}

# fuzz_one TARGET SECONDS: a line for the table in $work/TARGET.line.
fuzz_one() {
    target=$1
    mkdir -p "$work/corpus/$target" "$work/findings/$target" "$seeds/$target"
    ln -sf "$build/bin/fuzz_targets" "$work/$target"
    scratch=$(mktemp -d "$memory/srisp-fuzz.XXXXXX")
    leaks=1
    # LibRaw leaves its JPEG decoder behind where that fails, OpenImageIO a text where a PNG ends (docs/research/upstream.md).
    case $target in photo | raw_*) leaks=0 ;; esac
    code=0
    TMPDIR=$scratch ASAN_OPTIONS="${ASAN_OPTIONS:-}:detect_leaks=$leaks" "$work/$target" -max_total_time="$2" \
        -timeout="${SRISP_FUZZ_TIMEOUT:-5}" -rss_limit_mb=2048 -max_len=16384 -print_final_stats=1 \
        -artifact_prefix="$work/findings/$target/" "$work/corpus/$target" "$seeds/$target" \
        >"$work/$target.log" 2>&1 || code=$?
    rm -rf "$scratch"
    times >"$work/$target.times" # of this shell, then of what it has run: user and system
    found=-
    if [ "$code" -ne 0 ]; then
        found=$(sed -n 's/.*Test unit written to //p' "$work/$target.log" | tail -n 1)
        found="${found:-no input, see $work/$target.log}"
    fi
    runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$work/$target.log" | tail -n 1)
    last=$(grep -aoE '^#[0-9]+.* cov: [0-9]+ ft: [0-9]+ corp: [0-9]+' "$work/$target.log" | tail -n 1)
    cover=$(echo "$last" | sed -n 's/.* cov: \([0-9]*\).*/\1/p')
    corpus=$(echo "$last" | sed -n 's/.* corp: \([0-9]*\).*/\1/p')
    printf '%-18s %12s %8s %7s  %s\n' "$target" "${runs:-?}" "${cover:-?}" "${corpus:-?}" "$found" >"$work/$target.line"
    seconds=$(tail -n 1 "$work/$target.times" | tr 'ms' '  ' | awk '{ print $1 * 60 + $2 + $3 * 60 + $4 }')
    printf '%s %s %s %s\n' "$target" "$seconds" "${runs:-0}" "$([ "$found" = - ] || echo finding)" >>"$work/totals"
}

print_totals() {
    printf '%-18s %14s %14s %9s\n' target 'CPU seconds' executions findings
    awk '
        { seconds[$1] += $2; runs[$1] += $3; findings[$1] += NF > 3 }
        END {
            for (target in runs) {
                printf "%-18s %14.0f %14d %9d\n", target, seconds[target], runs[target], findings[target] | "sort"
                all_seconds += seconds[target]; all_runs += runs[target]; all_findings += findings[target]
            }
            close("sort")
            printf "%-18s %14.0f %14d %9d\n", "all", all_seconds, all_runs, all_findings
        }' "$work/totals"
}

merge_one() {
    target=$1
    mkdir -p "$seeds/$target" "$work/corpus/$target"
    ln -sf "$build/bin/fuzz_targets" "$work/$target"
    "$work/$target" -merge=1 -set_cover_merge=1 -use_counters=0 -max_len=512 "$seeds/$target" "$work/corpus/$target" \
        >"$work/$target.log" 2>&1
    printf '%-18s %6s seeds\n' "$target" "$(ls "$seeds/$target" | wc -l)"
}

case "${1:-}" in
    --one) fuzz_one "$2" "$3"; exit ;; # a job of the below
    --minutes) [ $# -ge 2 ] || usage; seconds=$(($2 * 60)); shift 2 ;;
    --seconds) [ $# -ge 2 ] || usage; seconds=$2; shift 2 ;;
    --totals) print_totals; exit ;;
    --merge) seconds=; shift ;;
    *) usage ;;
esac

for program in clang++ cmake ninja; do
    if ! command -v "$program" >/dev/null; then
        echo "run.sh: $program is missing: sh tools/install-deps.sh" >&2
        exit 2
    fi
done
if [ ! -e "$build/build.ninja" ]; then
    cmake -G Ninja -S "$root" -B "$build" -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_C_COMPILER=clang -DSRISP_FUZZ=ON \
        -DSRISP_BUILD_TRAINER=OFF -DSRISP_BUILD_PYTHON=OFF -DCMAKE_CXX_FLAGS_RELEASE="-O1 -g1" \
        $(command -v ccache >/dev/null && echo -DCMAKE_CXX_COMPILER_LAUNCHER=ccache) >"$build.log" 2>&1 ||
        { cat "$build.log" >&2; exit 2; }
    rm -f "$build.log"
fi
cmake --build "$build" --target fuzz_targets >&2 || exit 2

mkdir -p "$work"
all=$("$build/bin/fuzz_targets")
targets=${*:-$all}
for target in $targets; do
    echo "$all" | grep -qx "$target" || { echo "run.sh: no target '$target'; there are:" $all >&2; exit 2; }
done
if [ -z "$seconds" ]; then
    for target in $targets; do merge_one "$target"; done
    exit
fi

# "|| true": a leak in a library must not end the others' runs; what counts is in the lines.
export ASAN_OPTIONS="allocator_may_return_null=1:${ASAN_OPTIONS:-}" UBSAN_OPTIONS="print_stacktrace=1:${UBSAN_OPTIONS:-}"
for target in $targets; do rm -f "$work/$target.line"; done
printf '%s\n' $targets | xargs -P "${SRISP_FUZZ_JOBS:-$(nproc)}" -I{} sh "$0" --one {} "$seconds" || true

printf '%-18s %12s %8s %7s  %s\n' target executions coverage corpus finding
findings=0
for target in $targets; do
    [ -e "$work/$target.line" ] || { printf '%-18s did not run\n' "$target"; findings=1; continue; }
    cat "$work/$target.line"
    grep -q ' -$' "$work/$target.line" || findings=1
done
exit $findings
