# SPDX-License-Identifier: Apache-2.0
# Sourced by the scripts here, with the folders of build and sources as arguments: $tool, $stock, $photo (small), $reference;
# TMPDIR is a fresh folder. Beside check and finish of tests/repository/check.sh: same, exits, says, skip.
. "$2/tests/repository/check.sh"

tool=$build/bin/srisptool
stock=$(command -v oiiotool)
plugins=$(dirname "$(find "$build/lib" -name srisp.imageio.so | head -n 1)")
reference=$scratch/reference.dng
photo=$scratch/photo.jpg
cp "$source/configs/sample/reference.dng" "$reference"
oiiotool "$source/configs/sample/photo.jpg" --resize 160x0 -o "$photo"
TMPDIR=$scratch/tmp
export TMPDIR
mkdir "$TMPDIR"
cd "$scratch" || exit 1

# same A B: the pixels are equal to the bit.
same() {
    idiff -fail 0 -warn 0 "$1" "$2"
}

# exits CODE COMMAND…
exits() {
    expected=$1
    shift
    "$@"
    actual=$?
    [ "$actual" -eq "$expected" ] && return 0
    echo "exit code $actual, expected $expected"
    return 1
}

# says CODE TEXT COMMAND…: exits with CODE and has TEXT on stderr.
says() {
    expected=$1 text=$2
    shift 2
    exits "$expected" "$@" 2>"$scratch/stderr" || { cat "$scratch/stderr"; return 1; }
    grep -qF -- "$text" "$scratch/stderr" && return 0
    echo "stderr lacks: $text"
    cat "$scratch/stderr"
    return 1
}

nothing_left() {
    [ -z "$(ls -A "$TMPDIR")" ] && return 0
    ls -lR "$TMPDIR"
    return 1
}

# skip REASON: leaves the script as skipped.
skip() {
    echo "SKIPPED ${0##*/}: $1"
    exit 0
}
