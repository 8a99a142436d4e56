#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Without our commands srisptool is oiiotool; help and version; where it finds what it needs.
. "$(dirname "$0")/setup.sh"

as_stock() {
    "$stock" "$@" >stock.out 2>stock.err
    expected=$?
    "$tool" "$@" >our.out 2>our.err
    actual=$?
    # The program's own name in "Full command line was".
    cmp stock.out our.out && cmp stock.err our.err && [ "$expected" -eq "$actual" ]
}
check "the output of a command line" as_stock "$photo" --printstats --echo "{1+1} {TOP.width}" -o x.exr
check "a warning" as_stock "$photo"
check "an error" as_stock no.jpg -o x.exr
wrong_usage() {   # stdout lists the formats, with ours among them
    "$stock" --no-such >stock.out 2>stock.err
    exits $? "$tool" --no-such 2>our.err >our.out && cmp stock.err our.err
}
check "wrong usage" wrong_usage
check "a failing diff" as_stock "$photo" "$reference" --diff
check "an echo of our words" as_stock --echo --srisp-unprocess
ours_as_oiiotool() { [ "$("$build/libexec/srisp/oiiotool" --version)" = "$("$stock" --version)" ]; }
check "libexec/srisp/oiiotool has oiiotool's version" ours_as_oiiotool
check "srisptool --version says both" sh -c "'$tool' --version | grep -q '^srisptool 0' && '$tool' --version | grep -qx \"\$('$stock' --version)\""
check "--srisp-help is ours alone, on stdout" sh -c "'$tool' --srisp-help 2>&1 >help.txt | cmp - /dev/null && grep -q srisp-unprocess help.txt && ! grep -q colorconvert help.txt"
check "--help has both" sh -c "'$tool' --help >help.txt && grep -q srisp-unprocess help.txt && grep -q colorconvert help.txt"
check "no arguments: help, exit code 0" sh -c "'$tool' >help.txt && grep -q srisp-unprocess help.txt && grep -q colorconvert help.txt"
check "our help fits a terminal" sh -c "! '$tool' --srisp-help | grep -E '.{85}'"
check "--quiet is taken" exits 0 "$tool" --quiet "$photo" -o x.exr
check "the plugin is there for stock commands too" exits 0 "$tool" "photo.jpg.srisp?reference=reference.dng" -o x.exr

mkdir "prefix with space" && cp -a "$build/bin" "$build/lib" "$build/libexec" "$build/share" "prefix with space/" 2>/dev/null
check "a tree that was moved" exits 0 "prefix with space/bin/srisptool" "$photo" --flip --srisp-unprocess "$reference" -o moved.exr
check "as oiiotool in the moved tree" exits 0 "prefix with space/libexec/srisp/oiiotool" "$photo" --flip --srisp-unprocess "$reference" -o moved.exr
rm "prefix with space/libexec/srisp/oiiotool" && cp "$build/bin/srisptool" "prefix with space/libexec/srisp/oiiotool"
check "a copy instead of a link" exits 0 "prefix with space/libexec/srisp/oiiotool" "$photo" --srisp-unprocess "$reference" -o moved.exr
both() {
    PATH="$scratch/prefix with space/libexec/srisp:$build/libexec/srisp:$PATH" \
        timeout 60 oiiotool "$photo" --srisp-unprocess "$reference" -o moved.exr
}
check "two installations on PATH do not call each other" both
by_path() { PATH="$build/bin:$PATH" srisptool "$photo" --srisp-unprocess "$reference" -o x.exr; }
check "called by PATH" by_path
printf '#!/bin/sh\nexec 1>&2; env\n' >showing && chmod +x showing
tunables() { says 0 "GLIBC_TUNABLES=$1" env GLIBC_TUNABLES="$2" SRISP_OIIOTOOL="$scratch/showing" "$tool" "$photo" --srisp-process; }
check "huge pages are asked for" tunables glibc.malloc.hugetlb=1 ""
check "beside what the user asks for" tunables glibc.malloc.hugetlb=1:glibc.malloc.check=0 glibc.malloc.check=0
check "no stock oiiotool" says 1 "no stock oiiotool on PATH" \
    env PATH="$build/libexec/srisp" "$tool" "$photo" -o x.exr
rm "prefix with space/lib/srisp/srisp.imageio.so"
check "no plugin" says 1 "srisp.imageio.so is missing" "prefix with space/bin/srisptool" "$photo" --srisp-process
check "nothing is left" nothing_left
finish
