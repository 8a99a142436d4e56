#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Every tool has a man page that says what the tool says.
. "$(dirname "$0")/check.sh"

page_of() {
    page=$prefix/share/man/man1/$1.1
    man --warnings -E UTF-8 -l -Tutf8 "$page" >"$scratch/page" 2>"$scratch/warnings" || return 1
    cat "$scratch/warnings"
    # The parser of apropos reads the title.
    [ ! -s "$scratch/warnings" ] && lexgrog "$page" && grep -qF -e '--srisp-unprocess' "$scratch/page"
}

for tool in "$prefix"/bin/*; do
    check "$(basename "$tool") has a man page without warnings" page_of "$(basename "$tool")"
done
finish
