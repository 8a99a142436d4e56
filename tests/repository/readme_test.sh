#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# Runs every command that README and docs/ show (but contributing.md: .ci/run does what it says): each fenced block of sh
# or python in a shell of its own, one after the other in one scratch folder with files of the names that the text uses.
. "$(dirname "$0")/check.sh"
sample=$source/configs/sample
work=$scratch/work
mkdir -p "$work/tools" "$work/tests" "$scratch/home"
cp "$sample/photo.jpg" "$work/photo.jpg"
cp "$sample/photo.jpg" "$work/my.jpg"
cp "$sample/reference.dng" "$work/ref.dng"
cp "$sample/reference.dng" "$work/my.dng"
for frame in 0001 0002 0003; do cp "$sample/photo.jpg" "$work/shot.$frame.jpg"; done
# The build and the sources, as seen from the root of a clone. The demo is the real one, with this build.
ln -s "$build" "$work/build"
ln -s "$source/docs" "$source/configs" "$work/"
ln -s "$source/tests/repository" "$work/tests/"
printf 'SRISP_BUILD_DIR="%s" exec sh "%s/tools/demo.sh" "$@"\n' "$build" "$source" >"$work/tools/demo.sh"
# It is what runs this test: here only that it is there and is a script.
printf 'exec sh -n "%s/tests/run.sh"\n' "$source" >"$work/tests/run.sh"

# Writes the blocks as $scratch/block.<number>.<language>, and fails where one has no known language.
blocks_of() {
    awk -v stem="$scratch/block." -v list="$scratch/blocks" -v document="$1" '
        /^```/ && inside { inside = 0; close(file); next }
        /^```/ {
            inside = 1
            language = substr($0, 4)
            file = sprintf("%s%03d.%s", stem, NR, language)
            if (language == "sh" || language == "python") printf "%d %s %s\n", NR, language, file >list
            else if (language !~ /^(text|json|cpp|cmake)$/) { print document ":" NR ": block of unknown language"; exit 1 }
            next
        }
        inside { print >file }' "$source/$1"
}

run_block() (
    cd "$work" || exit 1
    export HOME="$scratch/home"
    export PATH="$HOME/srisp/bin:$PATH"
    case $1 in
        sh) sh -ex "$2" </dev/null ;;
        python) OIIO_LIBRARY_PATH="$HOME/srisp/lib/srisp" /usr/bin/python3 "$2" </dev/null ;;
    esac
)

check "README has at most 180 lines" test "$(wc -l <"$source/README.md")" -le 180
for document in README.md docs/artists.md docs/ocio.md docs/researchers.md docs/developers.md; do
    rm -f "$scratch"/block.*
    : >"$scratch/blocks"
    check "$document: every block says its language" blocks_of "$document"
    while read -r line language file; do
        check "$document:$line runs" run_block "$language" "$file"
    done <"$scratch/blocks"
done
check "the results are there" test -s "$work/raw.exr" -a -s "$work/raw.0003.exr" -a -s "$work/srisp-demo/sheet.png"
finish
