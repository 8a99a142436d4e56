// SPDX-License-Identifier: Apache-2.0
#include "batch_options.h"

namespace srisp::tool {

const char kHelp[] = R"(srispbatch -- makes RAW-like images of a whole set of photos, and goes on where it
was stopped

Usage: srispbatch PHOTOS... --reference REF -o FOLDER [options]
       srispbatch --verify FOLDER
       srispbatch --merge FOLDER
       srispbatch --redo FOLDER/RESULT [-o FILE]

PHOTOS are files, folders (with all folders in them), globs, @LIST (a file with
a name on each line) or - (such a list on stdin). A result has the name of its
photo, in the same folders: street/0001.jpg becomes FOLDER/street/0001.exr.

The same command goes on: what is done is not made again, what failed is tried
again. FOLDER/manifest/ has a line of JSON for each result, and failed.jsonl.

Photos and references:
  --reference REF     RAW file, folder, glob or list of these; or a CSV file
                      with the columns reference,weight or photo,reference
  --pairing HOW       random (without this), round-robin, all, or csv
  --per-image N       Results for each photo, with references of their own; 1
  --seed N            Decides references, noise, random crops and sampled
                      brightness; 0
  --match GLOB        Files of that name instead of images by their endings
  --copy GLOBS        Other files of the photos' folders, such as '*.json,*.txt',
                      are copied into the same folders

What is made:
  --format KIND       exr (without this), dng, tif, png or npy
  --depth KIND        half, float or uint16, as the format holds it
  --compression KIND  As the format's writer calls it: none, zip, dwaa:45, …
  --resize SIZE       The photo before all else: N (its shorter side), WxH, Wx0,
                      0xH or P%
  --crop SIZE         Of that the middle: N or WxH; random:SIZE anywhere
  --hold              A folder is a shot: its first photo's parameters are those
                      of all, so that nothing flickers
  --mosaic            As a sensor's filters let through, of the reference's phase
  --phase PHASE       The same of this phase: RGGB, GRBG, GBRG, BGGR
  --noise SOURCE      reference, iso=N, shot=A,read=B or upi
  --precision KIND    fast (without this, but for --depth float) or float32
  --model NAME, --params FILE, --input KIND, --gainmap USE, --brightness EV,
  --levels KIND, --profile FILE, --develop SPACE, --whitebalance WHITE,
  --exposure EV, --highlights HOW
                      As srisptool's commands have them (srisptool --srisp-help)
  --allow-partial     Take photos that break off as far as they go
  --overwrite         Make again what is there, whatever made it

The run:
  --threads N         Photos at a time; 0: one for each processor; 0
  --memory GB         Images in memory at a time; a quarter of the machine's
  --max-megapixels N  Refuse images of more than N million pixels; 2000
  --shard I/N         One part of N of the photos, I from 0; in a job array of
                      Slurm its task
  --no-isolate        Photos are decoded by this process, not by others, which
                      may crash
  --time-limit S      Seconds for a photo, isolated; 300
  --retry N           Try N times more what fails; 0
  --fail-fast         Stop at the first photo that fails
  --dry-run           Say what would be done, how long and how much it will be,
                      from a sample
  --photos-per-shard N
                      With --dry-run: how many shards that makes
  --check             Compare what is done, its photo and its reference with
                      their hashes, and make it again where one differs

A set that is made:
  --verify FOLDER     Compare all results with their hashes
  --merge FOLDER      Make one manifest of all shards'
  --redo RESULT       Make one result again as it is recorded; RESULT may be
                      FOLDER/manifest/FILE.jsonl:LINE, too. -o FILE: there

  --json              Events on stdout, a line of JSON for each
  -q, --quiet         No progress and no summary
  -h, --help          Print this
  --version           Print the version

Examples:
  srispbatch photos/ --reference refs/ -o raw/
  srispbatch @coco.txt --reference refs.csv --per-image 3 --seed 7 --mosaic \
             --noise reference --format dng -o coco_raw
  srispbatch photos/ --reference refs/ --resize 512 --crop 512 --format npy -o raw/

Exit codes: 0; 1 where some failed; 2 for wrong usage; 128 and the signal's
number where a signal ended it. No incomplete file is left.
)";

} // namespace srisp::tool
