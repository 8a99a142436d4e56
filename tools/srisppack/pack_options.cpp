// SPDX-License-Identifier: Apache-2.0
#include "pack_options.h"

#include <srisp/image.h>

#include "pack/training_pack.h"

namespace srisp::tool {

void describe_options(CLI::App& app, PackOptions& options)
{
    describe_common_options(app, options);
    app.add_option("inputs", options.inputs);
    app.add_option("--photos", options.photos)->allow_extra_args(false);
    app.add_option("--raws", options.raws)->allow_extra_args(false);
    app.add_option("--cameras", options.cameras)->allow_extra_args(false);
    app.add_option("-o,--output", options.output);
    app.add_option("--size", options.size)->check(CLI::Range(kSmallestPackImage, kLargestPackImage));
    // RAW images are cut from the thumbnail that is made for references.
    app.add_option("--raw-size", options.raw_size)->check(CLI::Range(kSmallestPackImage, kThumbnailSize));
    app.add_option("--crops", options.crops)->check(CLI::Range(0, 100));
    app.add_option("--seed", options.seed);
    app.add_flag("--open-only", options.open_only);
    app.add_flag("--strict", options.strict);
    app.add_flag("--replace", options.replace);
}

const char kHelp[] = R"(srisppack -- makes a training pack of photos, RAW files and measured cameras

Usage: srisppack [options] INPUT... -o PACK

Reads images once, squashes each (and some parts of it) to the size that models
are trained at, and writes them to the folder PACK, which srisptrain reads. An
INPUT is a file or a folder, with those in it, and is recognised by what it
holds:

  photos    images that OpenImageIO reads: JPEG, PNG, TIFF, ...
  raws      RAW files of cameras, and sets of linear images (.safetensors)
  cameras   a folder with sensitivities/, illuminants.csv, cmf_1931.json and
            training_spectral.json, from which cameras are simulated

A manifest.csv in a folder says which of its files are used, and what is known
of them: columns file, use (training, validation), open (yes, no), source,
licence. Without one all are used, every tenth for validation. Images that
cannot be read are listed and left out.

Options:
  -o, --output PACK  The folder to make
  --photos INPUT     Take INPUT as photos, whatever it holds; may be repeated
  --raws INPUT       Take INPUT as RAW images (linear EXR and TIFF, too)
  --cameras FOLDER   Take FOLDER as cameras
  --size N           Width and height of photos in the pack, 32 to 1024; 128
  --raw-size N       The same of RAW images, 32 to 256; by default that of
                     photos, and of sets where there are only sets
  --crops N          Parts of each image beside the whole: 50 to 100 % of each
                     side, none smaller than the size; 3
  --seed N           Of the choice of these parts; 0
  --open-only        Only images that the manifest calls open
  --strict           An image that cannot be read is an error
  --replace          Make PACK anew where there is one, and nothing else in its
                     folder; the old one stays until the new one is complete
  --max-megapixels N Refuse images of more than N million pixels; 2000
  --threads N        0: one for each processor; 0
  --json             The summary on stdout as JSON
  -q, --quiet        No progress
  -h, --help         Print this
  --version          Print the version

Examples:
  srisppack photos/ raws/ cameras/ -o pack
  srisppack ~/raws/*.NEF -o my_camera
  srisppack photos/ cameras/ --open-only --crops 5 -o open_pack

Exit codes: 0 where the pack is complete, 1 where it could not be made, 2 for
wrong usage; 128 and the signal's number where a signal ended it. Nothing of an
incomplete pack is left.
)";

} // namespace srisp::tool
