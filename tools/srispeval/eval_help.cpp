// SPDX-License-Identifier: Apache-2.0
#include "eval_options.h"

namespace srisp::tool {

const char kHelp[] = R"(srispeval -- holds models against images whose truth is known

Usage: srispeval half-split RAWS... [options]
       srispeval pairs PAIRS.csv [options]
       srispeval unpaired PHOTOS... --reference RAWS... [options]
       srispeval compare A.json B.json [--method NAME] [--json FILE]
       srispeval --pack PACK [MODELS...] [options]

half-split  Each RAW file by itself, as in the paper: its left half is the
            reference; of its right half photos are made, which are unprocessed
            and held against the RAW.
pairs       Photos with RAW files that show the same: a table with the columns
            photo,raw,reference and, if you like, rendering. Paths are relative
            to it.
unpaired    Photos with references that have nothing to do with them: results
            are held against the references.
compare     Two files that --json wrote, image by image: which differences are
            more than noise.
--pack      Images of a training pack, as srisptrain tests them;
            srispeval --pack PACK --help tells more.

RAWS and PHOTOS are files, folders (with all folders in them), globs or @LIST (a
file with a name on each line); of half-split also training packs. Files that cannot be tested are listed and left
out.

What is tested:
  --model NAME|FILE   A model; may be repeated; default (without this)
  --baseline LIST     gain_match,upi (without this), one of them, or none. The
                      first method is what all others are held against
  --rendering LIST    half-split: how photos are made, of fixed,random,camera
                      (without this), embedded (the camera's own JPEG), libraw,
                      dcraw, rawtherapee, darktable, or all that are installed
  --references N      unpaired: how many references each photo gets; 8
  --size N            Longer side on which is measured, pixels; 512; 0: full
  --edits N           Renderings after which result and truth are compared; 5
  --seed N            Of all that is random; 1

What is written:
  --report FILE.html  A page with tables, charts and pictures that needs nothing
                      else and opens anywhere
  --pictures N        Images that it shows, at most; 100
  --report-size MB    How large it may be, which says how large pictures are; 18
  --json FILE         Everything as JSON; -: on stdout, instead of the table
  --csv FILE          A line for each image and method
  --by-camera         The table on stdout has each camera, too

  --threads N         Files at a time; 0 (without this): one for each processor
  --memory GB         What they may take; a quarter of the machine's
  --max-megapixels N  Refuse images of more than N million pixels; 2000
  -q, --quiet         No progress
  -h, --help          This text
  --version           The version

Numbers are means with bootstrap 95 % intervals over files. Ctrl-C writes what is
done, and the same command goes on from there (FILE.unfinished keeps it).

Examples:
  srispeval half-split raws/ --report report.html
  srispeval half-split raws/ --model default --model mine.safetensors \
      --rendering all --json mine.json
  srispeval pairs pairs.csv --report report.html
  srispeval unpaired photos/ --reference raws/
  srispeval compare old.json new.json

Exit codes: 0; 1 where something failed, or a file was left out; 2 for wrong
usage.
)";

} // namespace srisp::tool
