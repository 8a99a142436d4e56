#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Temporary folders are private and unpredictable, whatever the umask, and TMPDIR may be anything.
. "$(dirname "$0")/../cli/setup.sh"
umask 000

# An oiiotool that tells, while it runs, what lies in TMPDIR and who may look at it.
cat >spy <<END
#!/bin/sh
find "$TMPDIR" -mindepth 1 -printf '%M %P\n' >>"$scratch/seen"
exec "$stock" "\$@"
END
chmod 755 spy
spied() { SRISP_OIIOTOOL=$scratch/spy "$tool" -q "$photo" --flip --srisp-unprocess "$reference" -o x.exr && [ -s x.exr ]; }
folders() { sed -n 's/^\(d[^ ]*\) \(\.srisptool\.partial-[0-9a-f]\{16\}\)$/\1 \2/p' seen; }
private() {
    spied && spied && folders && [ "$(folders | wc -l)" -eq 2 ] && ! folders | grep -v '^drwx------ ' \
        && [ "$(folders | sort -u | wc -l)" -eq 2 ] && [ "$(grep -vc '^d' seen)" -gt 2 ]
}
check "srisptool's folder is for its owner only, and has another name each time" private
check "nothing of it is left" nothing_left
all_within() { ! cut -d' ' -f2- seen | grep -v '^\.srisptool\.partial-'; }
check "and all that it makes lies in there" all_within

# What others put there: links to what they cannot write, under names of ours.
hostile() {
    mkdir victim && echo kept >victim/file
    for name in .srisptool.partial-0123456789abcdef .x.partial-0123456789abcdef.exr srisptool srisp; do
        ln -s "$scratch/victim" "$TMPDIR/$name" || return 1
    done
    spied && [ "$(cat victim/file)" = kept ] && [ "$(ls victim)" = file ] || return 1
    rm "$TMPDIR"/.srisptool* "$TMPDIR"/.x* "$TMPDIR"/srisp*
}
check "links in TMPDIR are neither followed nor touched" hostile
link_in_place() {
    rm -f x.exr && ln -s "$scratch/victim/file" x.exr
    "$tool" -q "$photo" --srisp-unprocess "$reference" -o x.exr && [ "$(cat victim/file)" = kept ] && [ ! -L x.exr ] && [ -s x.exr ]
}
check "a link in an output's place is replaced, not followed" link_in_place

: >plain
mkdir "t \$(touch ran);|*?'" readable && ln -s readable link && chmod 555 readable
odd() {
    for folder in "" . link plain "$scratch/none" "relative/none" "t \$(touch ran);|*?'" "|touch ran" "a:b" "~" '$HOME' /dev/null; do
        rm -f x.exr
        env TMPDIR="$folder" "$tool" -q "$photo" --flip --srisp-unprocess "$reference" -o x.exr && [ -s x.exr ] \
            || { echo "TMPDIR='$folder'"; return 1; }
    done
    [ ! -e ran ] && [ ! -e "~" ] && [ -z "$(find . -name '*partial-*')" ]
}
check "with any TMPDIR srisptool works, with another folder where that cannot be used" odd
modes() {
    (umask 027 && "$tool" -q "$photo" --srisp-unprocess "$reference" -o u.exr && "$build/bin/srispbatch" "$photo" --reference "$reference" \
        -o set --quiet) || return 1
    [ "$(stat -c %a u.exr)" = 640 ] && ! find set -perm /027 ! -type d | grep . && [ "$(find set -type f | wc -l)" -ge 4 ]
}
check "outputs have the rights that the umask says" modes
finish
