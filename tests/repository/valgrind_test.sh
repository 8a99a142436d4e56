#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A small suite under valgrind's memcheck: wrong memory accesses, values that were never set and memory that nothing points
# to any more fail it. Valgrind knows no AVX-512 and hides it, so that the kernels run as AVX2.
. "$(dirname "$0")/check.sh"
command -v valgrind >/dev/null || { echo "SKIPPED valgrind_test.sh: needs valgrind"; exit 0; }

clean() {
    valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite \
        --suppressions="$source/tests/repository/valgrind.supp" "$@"
}
check "files, caches, threads and JSON" clean "$build/bin/lib_tests" \
    --source-file="*/lib/base/*" --test-case-exclude="*memory*,*process*"
check "reading models and writing parameters" clean "$build/bin/lib_tests" --source-file="*/lib/parameters/*,*/lib/model/*"
finish
