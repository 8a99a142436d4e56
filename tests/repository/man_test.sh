#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Every tool has a man page that says what the tool says.
. "$(dirname "$0")/check.sh"

page_of() {
    page=$prefix/share/man/man1/$1.1
    man --warnings -E UTF-8 -l -Tutf8 "$page" >"$scratch/page" 2>"$scratch/warnings" || return 1
    cat "$scratch/warnings"
    # The parser of apropos reads the title.
    [ ! -s "$scratch/warnings" ] && lexgrog "$page" || return 1
    option=--help
    [ "$1" != srisptool ] || option=--srisp-help # --help is oiiotool's
    "$prefix/bin/$1" $option | grep -o -e '--[a-z][a-z-]*' | sort -u >"$scratch/options"
    [ -s "$scratch/options" ] && while read -r name; do
        grep -qF -e "$name" "$scratch/page" || { echo "the page lacks $name"; return 1; }
    done <"$scratch/options"
}

for tool in "$prefix"/bin/*; do
    check "$(basename "$tool") has a man page without warnings" page_of "$(basename "$tool")"
done
finish
