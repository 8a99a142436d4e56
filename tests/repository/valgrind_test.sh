#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# A small suite under valgrind's memcheck: wrong accesses, values that were never set, and memory that nothing points to any
# more fail it. Nothing is suppressed. Valgrind hides AVX-512, which it does not know, so that kernels are those of AVX2.
. "$(dirname "$0")/check.sh"
command -v valgrind >/dev/null || { echo "SKIPPED valgrind_test.sh: needs valgrind"; exit 0; }
case "$(ldd "$build/bin/lib_tests")" in *libasan* | *libtsan*)
    echo "SKIPPED valgrind_test.sh: the build has sanitizers of its own"
    exit 0 ;;
esac

clean() {
    valgrind -q --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite --show-leak-kinds=definite "$@"
}
decodes() {
    version=$(sed -n 's/^project(srisp VERSION \([0-9.]*\).*/\1/p' "$source/CMakeLists.txt")
    clean "$build/libexec/srisp/srispdecode" "$version" reference "$source/configs/sample/reference.dng" >"$scratch/answer" &&
        [ "$(wc -c <"$scratch/answer")" -gt 500000 ]
}
check "the decoder of RAW files" decodes
check "caches, threads, kernels" clean "$build/bin/lib_tests" --test-case-exclude="power is within*" \
    --source-file="*/lib/base/recently*,*/lib/base/parallel*,*/lib/kernels/pointwise*"
finish
