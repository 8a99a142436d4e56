// SPDX-License-Identifier: Apache-2.0
#include "help.h"

namespace srisp::tool {

const char kHelp[] = R"(srisptool -- oiiotool, and the way from a photo to a RAW-like image and back

Usage: srisptool [filename|command]...

Every command of oiiotool works as always; srisptool --help lists them. These
are added:

  --srisp-unprocess REF     Turn the photo on top of the stack into the linear
                            image that the camera of REF would have recorded
                            (options: model=, params=, input=, precision=,
                            hold=, seed=)
  --srisp-process           Turn a RAW-like image into a photo again, by the
                            parameters recorded in it (options: params=, model=,
                            precision=)
  --srisp-params REF        Print the parameters that --srisp-unprocess would
                            choose, as JSON on stdout, one line per image; the
                            image stays as it is (options: model=, input=, seed=)
  --srisp-save-params FILE  Write the parameters recorded in the image to FILE;
                            # or %04d in its name is the frame number
  --srisp-help              Print this
  --quiet                   No notes and no progress; the same as -q
  --no-progress             No progress on the terminal

REF is a RAW file, a linear image that srisptool made, or any linear EXR in
camera RGB. A folder, a quoted pattern ("shots/*.dng") or a list ("a.dng;b.dng")
stands for one of its files, chosen by seed= and the photo's name. With params=
it may be "-". Names of references, parameters and models are taken literally:
# and {} are no wildcards and expressions there.

Options of these commands follow the command, as in oiiotool:

  model=NAME     default, pointwise, or the path of a .safetensors file
  params=FILE    the parameters in FILE instead of chosen ones: what --srisp-params
                 or --srisp-save-params wrote, edited or not
  input=KIND     what the photo's values are: srgb, linear, or auto (float is
                 linear, integers are sRGB)
  precision=KIND float32, or fast: one and a half to nearly two times as fast,
                 with an error well below one code value of 10 bits
  hold=1         keep the first frame's parameters over a sequence, so that
                 nothing flickers
  seed=N         for the choice among several references

A value that holds a colon is quoted: '--srisp-unprocess:params="at 12:30.json"'

RAW-like images need more than 8 bits. Where no -d is given and the format
cannot hold float (PNG), 16 bits are written.

Examples:
  srisptool photo.jpg --srisp-unprocess ref.dng -o raw.exr
  srisptool raw.exr --srisp-process -o photo_again.png
  srisptool photo.jpg --srisp-params ref.dng > look.json
  srisptool photo.jpg --srisp-unprocess:params=look.json - -o raw.exr
  srisptool --frames 1-240 shot.#.jpg --srisp-unprocess:hold=1 ref.dng -o raw.#.exr

Environment:
  SRISP_OIIOTOOL    the oiiotool to run; default: the first on PATH that is not
                    srisptool
  SRISP_MODEL_PATH  folders with models, separated by colons
  TMPDIR            where small hand-over files lie while it runs

Exit codes: oiiotool's own; 1 where srisptool itself failed, 2 for wrong usage
of its commands.
)";

} // namespace srisp::tool
