// SPDX-License-Identifier: Apache-2.0
#include "help.h"

namespace srisp {

const char kHelp[] = R"(srisptool -- oiiotool, and the way from a photo to a RAW-like image and back

Usage: srisptool [filename|command]...

Every command of oiiotool works as always (srisptool --help lists them). These are added:

    --srisp-unprocess REF         Turn the photo on top of the stack into the linear image that the camera of REF would
                                  have recorded (options: model=, params=, input=auto|srgb|linear, hold=0|1, seed=)
    --srisp-process               Turn a RAW-like image into a photo again, by the parameters recorded in it
                                  (options: params=, model=)
    --srisp-params REF            Print the parameters that --srisp-unprocess would choose: JSON on stdout, one line per
                                  image; the image stays as it is (options: model=, input=, seed=)
    --srisp-save-params FILE      Write the parameters recorded in the image to FILE; # in it is the frame number
    --srisp-help                  Print this
    --no-progress                 Do not show progress on the terminal
    --quiet                       The same as -q, and no progress

REF is a RAW file, a linear image that srisptool made, or any linear EXR in camera RGB. A folder, a quoted pattern
("shots/*.dng") or a list ("a.dng;b.dng") stands for one of its files, chosen by seed= and the photo's name. With params=
it may be -.

    model=NAME     default, pointwise, or the path of a .safetensors file
    params=FILE    take the parameters from FILE (written by --srisp-params or --srisp-save-params, edited or not)
    input=KIND     how the photo's values are meant: auto takes float as linear and integers as sRGB
    hold=1         keep the first frame's parameters over a sequence, so that nothing flickers
    seed=N         for the choice among several references

Names are taken literally: # and {} in them are no wildcards and expressions. A value that holds a colon is quoted as in
oiiotool: '--srisp-unprocess:params="C:1.json"'.

Examples:
    srisptool photo.jpg --srisp-unprocess ref.dng -o raw.exr
    srisptool raw.exr --srisp-process -o photo_again.png
    srisptool photo.jpg --srisp-params ref.dng > look.json
    srisptool photo.jpg --srisp-unprocess:params=look.json - -o raw.exr
    srisptool --frames 1-240 shot.#.jpg --srisp-unprocess:hold=1 ref.dng -o raw.#.exr

RAW-like images need more than 8 bits. Where no -d is given and the format cannot hold float (PNG), 16 bits are written.

Environment:
    SRISP_OIIOTOOL     the oiiotool to run (default: the first on PATH that is not srisptool)
    SRISP_MODEL_PATH   folders with models, separated by colons
    TMPDIR             where the hand-over files lie while it runs

Exit codes: oiiotool's own; 1 where srisptool itself failed, 2 for wrong usage of its commands.
)";

} // namespace srisp
