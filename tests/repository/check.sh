# SPDX-License-Identifier: Apache-2.0
# For test scripts: `check SENTENCE COMMAND…` runs one check; `finish` ends on the line that tests/run.sh counts.
# $build, $source: the folders of build and sources. $prefix: an installed tree. $scratch: a fresh folder.
build=$1 source=$2
prefix=${SRISP_TEST_PREFIX:-$build/tests/moved prefix}
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
passed=0 failed=0

check() {
    sentence=$1
    shift
    if "$@" >"$scratch/check.log" 2>&1; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        echo "FAILED: $sentence"
        sed 's/^/    /' "$scratch/check.log"
    fi
}

finish() {
    echo "$passed passed, $failed failed"
    [ "$failed" -eq 0 ]
}
