# SPDX-License-Identifier: Apache-2.0
# Sourced by the ocio_ scripts: setup.sh, and beside what it makes: our config in OCIO, a bake of reference.dng for
# photo.jpg, raw.exr (the library's pixels, float) and back.tif (the same, processed). The third argument is the
# folder of shared test data.
. "${0%/*}/setup.sh"

shared=$3
tool=$build/bin/srisptool
bake=$build/bin/srispbake
OCIO=$build/share/srisp/ocio/srisp.ocio
export OCIO
unset SRISP_REFERENCE SRISP_SOURCE SRISP_MODEL SRISP_BAKE_PATH
unprocess="srisp unprocess" process="srisp process" camera="srisp camera RGB"

# library PHOTO REFERENCE RAW BACK: the pixels to compare with.
library() {
    "$tool" "$1" --srisp-unprocess "$2" -o:datatype=float "$3" --srisp-process -o:datatype=float "$4" \
        2>"$scratch/library.log" || cat "$scratch/library.log"
}
library photo.jpg reference.dng raw.exr back.tif
$bake --reference reference.dng --source photo.jpg --quiet

# near A B LIMIT: no channel of any pixel differs by more than LIMIT.
near() { idiff -fail "$3" -warn "$3" "$1" "$2"; }
# near_but_for_black A B: 1e-3, but for single pixels near black, where the matrix of the way forward cancels and its power
# magnifies what rounding and tables left: at most one of a thousand, by at most 2e-3.
near_but_for_black() { idiff -fail 1e-3 -failpercent 0.1 -hardfail 2e-3 -warn 2e-3 "$1" "$2"; }

# with REFERENCE COMMAND…: runs it with that context variable.
with() {
    variable=$1
    shift
    SRISP_REFERENCE=$variable "$@"
}

# skip REASON: leaves the script as skipped.
skip() {
    echo "SKIPPED ${0##*/}: $1"
    exit 0
}
