// SPDX-License-Identifier: Apache-2.0
#include "commands.h"

#include <cctype>
#include <unordered_map>

#include "base/near_names.h"

#include "../common/failure.h"

namespace srisp::tool {

const std::vector<OiiotoolCommand>& oiiotool_commands()
{
    // clang-format off
    static const std::vector<OiiotoolCommand> commands = {
        // Options
        { "help", 0, Role::plain }, { "version", 0, Role::plain }, { "v", 0, Role::plain }, { "q", 0, Role::plain },
        { "n", 0, Role::plain }, { "no-error-exit", 0, Role::plain }, { "a", 0, Role::plain },
        { "debug", 0, Role::plain }, { "runstats", 0, Role::plain }, { "info", 0, Role::sticky },
        { "list-formats", 0, Role::plain }, { "metamatch", 1, Role::plain }, { "no-metamatch", 1, Role::plain },
        { "stats", 0, Role::sticky }, { "dumpdata", 0, Role::sticky }, { "hash", 0, Role::sticky },
        { "u", 0, Role::plain }, { "no-clobber", 0, Role::plain }, { "threads", 1, Role::plain },
        { "no-autopremult", 0, Role::sticky }, { "autopremult", 0, Role::sticky }, { "autoorient", 0, Role::sticky },
        { "autocc", 0, Role::sticky }, { "noautocc", 0, Role::plain }, { "native", 0, Role::sticky },
        { "cache", 1, Role::plain }, { "autotile", 1, Role::plain }, { "metamerge", 0, Role::plain },
        { "oiioattrib", 2, Role::sticky },
        // Control flow and scripting
        { "set", 2, Role::plain }, { "if", 1, Role::acts }, { "else", 0, Role::acts }, { "endif", 0, Role::acts },
        { "while", 1, Role::acts }, { "endwhile", 0, Role::acts }, { "for", 2, Role::acts },
        { "endfor", 0, Role::acts }, { "frames", 1, Role::plain }, { "framepadding", 1, Role::plain },
        { "views", 1, Role::plain }, { "skip-bad-frames", 0, Role::plain }, { "wildcardoff", 0, Role::plain },
        { "wildcardon", 0, Role::plain }, { "evaloff", 0, Role::plain }, { "evalon", 0, Role::plain },
        // Commands that read images
        { "i", 1, Role::reads }, { "iconfig", 2, Role::sticky }, { "missingfile", 1, Role::sticky },
        // Commands that write images
        { "o", 1, Role::writes }, { "otex", 1, Role::writes }, { "oenv", 1, Role::writes },
        { "obump", 1, Role::writes },
        // Options that affect subsequent image output
        { "d", 1, Role::plain }, { "scanline", 0, Role::plain }, { "tile", 2, Role::plain },
        { "compression", 1, Role::plain }, { "dither", 0, Role::plain }, { "planarconfig", 1, Role::plain },
        { "adjust-time", 0, Role::plain }, { "noautocrop", 0, Role::plain }, { "autotrim", 0, Role::plain },
        // Options that print data
        { "echo", 1, Role::plain }, { "printinfo", 0, Role::acts }, { "printstats", 0, Role::acts },
        { "colorcount", 1, Role::acts }, { "rangecheck", 2, Role::acts },
        // Options that change current image metadata
        { "attrib", 2, Role::acts }, { "sattrib", 2, Role::acts }, { "eraseattrib", 1, Role::acts },
        { "caption", 1, Role::acts }, { "keyword", 1, Role::acts }, { "clear-keywords", 0, Role::acts },
        { "nosoftwareattrib", 0, Role::plain }, { "sansattrib", 0, Role::plain }, { "orientation", 1, Role::acts },
        { "orientcw", 0, Role::acts }, { "orientccw", 0, Role::acts }, { "orient180", 0, Role::acts },
        { "origin", 1, Role::acts }, { "originoffset", 1, Role::acts }, { "fullsize", 1, Role::acts },
        { "fullpixels", 0, Role::acts }, { "chnames", 1, Role::acts },
        // Options that affect subsequent actions
        { "fail", 1, Role::plain }, { "failpercent", 1, Role::plain }, { "hardfail", 1, Role::plain },
        { "warn", 1, Role::plain }, { "warnpercent", 1, Role::plain }, { "hardwarn", 1, Role::plain },
        // Actions
        { "create", 2, Role::creates }, { "pattern", 3, Role::creates }, { "kernel", 2, Role::creates },
        { "capture", 0, Role::creates }, { "diff", 0, Role::acts }, { "pdiff", 0, Role::acts },
        { "add", 0, Role::acts }, { "addc", 1, Role::acts }, { "sub", 0, Role::acts }, { "subc", 1, Role::acts },
        { "mul", 0, Role::acts }, { "mulc", 1, Role::acts }, { "div", 0, Role::acts }, { "divc", 1, Role::acts },
        { "mad", 0, Role::acts }, { "invert", 0, Role::acts }, { "abs", 0, Role::acts }, { "absdiff", 0, Role::acts },
        { "absdiffc", 1, Role::acts }, { "powc", 1, Role::acts }, { "noise", 0, Role::acts },
        { "chsum", 0, Role::acts }, { "colormap", 1, Role::acts }, { "crop", 1, Role::acts },
        { "croptofull", 0, Role::acts }, { "trim", 0, Role::acts }, { "cut", 1, Role::acts },
        { "paste", 1, Role::acts }, { "pastemeta", 0, Role::acts }, { "mosaic", 1, Role::acts },
        { "over", 0, Role::acts }, { "zover", 0, Role::acts }, { "deepmerge", 0, Role::acts },
        { "deepholdout", 0, Role::acts }, { "rotate90", 0, Role::acts }, { "rotate180", 0, Role::acts },
        { "rotate270", 0, Role::acts }, { "flip", 0, Role::acts }, { "flop", 0, Role::acts },
        { "reorient", 0, Role::acts }, { "transpose", 0, Role::acts }, { "cshift", 1, Role::acts },
        { "resample", 1, Role::acts }, { "resize", 1, Role::acts }, { "fit", 1, Role::acts },
        { "pixelaspect", 1, Role::acts }, { "rotate", 1, Role::acts }, { "warp", 1, Role::acts },
        { "st_warp", 0, Role::acts }, { "convolve", 0, Role::acts }, { "blur", 1, Role::acts },
        { "median", 1, Role::acts }, { "dilate", 1, Role::acts }, { "erode", 1, Role::acts },
        { "unsharp", 0, Role::acts }, { "laplacian", 0, Role::acts }, { "fft", 0, Role::acts },
        { "ifft", 0, Role::acts }, { "polar", 0, Role::acts }, { "unpolar", 0, Role::acts },
        { "fixnan", 1, Role::acts }, { "fillholes", 0, Role::acts }, { "max", 0, Role::acts },
        { "maxc", 1, Role::acts }, { "maxchan", 0, Role::acts }, { "min", 0, Role::acts }, { "minc", 1, Role::acts },
        { "minchan", 0, Role::acts }, { "clamp", 0, Role::acts }, { "contrast", 0, Role::acts },
        { "saturate", 1, Role::acts }, { "rangecompress", 0, Role::acts }, { "rangeexpand", 0, Role::acts },
        { "line", 1, Role::acts }, { "point", 1, Role::acts }, { "box", 1, Role::acts }, { "fill", 1, Role::acts },
        { "text", 1, Role::acts },
        // Manipulating channels or subimages
        { "ch", 1, Role::acts }, { "chappend", 0, Role::acts }, { "unmip", 0, Role::acts },
        { "selectmip", 1, Role::acts }, { "subimage", 1, Role::acts }, { "sisplit", 0, Role::acts },
        { "siappend", 0, Role::acts }, { "siappendall", 0, Role::acts }, { "deepen", 0, Role::acts },
        { "flatten", 0, Role::acts },
        // Image stack manipulation
        { "dup", 0, Role::acts }, { "swap", 0, Role::acts }, { "pop", 0, Role::acts }, { "label", 1, Role::acts },
        // Color management
        { "colorconfig", 1, Role::plain }, { "iscolorspace", 1, Role::acts }, { "tocolorspace", 1, Role::acts },
        { "colorconvert", 2, Role::acts }, { "ccmatrix", 1, Role::acts }, { "ociolook", 1, Role::acts },
        { "ociodisplay", 2, Role::acts }, { "ociofiletransform", 1, Role::acts }, { "unpremult", 0, Role::acts },
        { "premult", 0, Role::acts }, { "repremult", 0, Role::acts }, { "iccwrite", 1, Role::acts },
        { "iccread", 1, Role::acts },
        // Not in --help
        { "noclobber", 0, Role::plain }, { "auto-orient", 0, Role::sticky }, { "nostderr", 0, Role::plain },
        { "crash", 0, Role::plain }, { "unittest", 0, Role::plain }, { "force-tiles", 0, Role::plain },
        { "quality", 1, Role::plain }, { "rotcw", 0, Role::acts }, { "rotccw", 0, Role::acts },
        { "rot180", 0, Role::acts }, { "cadd", 1, Role::acts }, { "csub", 1, Role::acts }, { "cmul", 1, Role::acts },
        { "cpow", 1, Role::acts }, { "flipflop", 0, Role::acts },
    };
    // clang-format on
    return commands;
}

bool is_command(const std::string& word)
{
    const std::size_t letter = word.rfind("--", 0) == 0 ? 2 : 1;
    return word.size() > letter && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[letter]));
}

std::string command_name(const std::string& word)
{
    const std::string name = word.substr(word.rfind("--", 0) == 0 ? 2 : 1);
    return name.substr(0, name.find(':'));
}

const OiiotoolCommand* find_oiiotool_command(const std::string& word)
{
    static const auto by_name = [] {
        std::unordered_map<std::string, const OiiotoolCommand*> map;
        for (const OiiotoolCommand& command : oiiotool_commands())
            map.emplace(command.name, &command);
        return map;
    }();
    const auto found = is_command(word) ? by_name.find(command_name(word)) : by_name.end();
    return found == by_name.end() ? nullptr : found->second;
}

const std::vector<SrispCommand>& srisp_commands()
{
    static const std::vector<SrispCommand> commands = {
        { "srisp-unprocess", "REF", kUnprocess, Effect::replaces, "reverse", "apply",
          "Turn the photo on top of the stack into the linear image that the camera of REF would have recorded" },
        { "srisp-process", nullptr, kProcess, Effect::replaces, "forward", "apply",
          "Turn a RAW-like image into a photo again, by the parameters recorded in it" },
        { "srisp-mosaic", nullptr, kMosaic, Effect::replaces, "reverse", "sensor",
          "Leave of each pixel of a RAW-like image the colour that the filter over it lets through, as a sensor does" },
        { "srisp-noise", "SOURCE", kNoise, Effect::replaces, "reverse", "sensor",
          "Add a sensor's noise to a RAW-like image or a mosaic" },
        { "srisp-develop", "SPACE", kDevelop, Effect::replaces, "reverse", "develop",
          "Turn a RAW-like image, or a camera's RAW file, into scene-linear colour: ACEScg, ACES2065-1, lin_rec709, "
          "lin_rec2020, lin_p3d65, XYZ" },
        { "srisp-params", "REF", kParams, Effect::reports, "reverse", "print",
          "Print the parameters that --srisp-unprocess would choose, as JSON on stdout, one line per image; the image "
          "stays as it is" },
        { "srisp-save-params", "FILE", kNoDoor, Effect::reports, "reverse", "save",
          "Write the parameters recorded in the image to FILE; # or %04d in its name is the frame number" },
        { "srisp-help", nullptr, kNoDoor, Effect::helps, "", "", "Print this" },
        { "quiet", nullptr, kNoDoor, Effect::configures, "", "", "No notes and no progress; the same as -q" },
        { "no-progress", nullptr, kNoDoor, Effect::configures, "", "", "No progress on the terminal" },
        { "allow-partial", nullptr, kNoDoor, Effect::configures, "", "",
          "Take photos that break off as far as they go, with a note, instead of an error" },
        { "max-megapixels", "N", kNoDoor, Effect::configures, "", "",
          "Refuse images of more than N million pixels; the same as SRISP_MAX_MEGAPIXELS" },
    };
    return commands;
}

const SrispCommand* find_srisp_command(const std::string& word)
{
    const std::string name = command_name(word);
    std::vector<std::string> known;
    for (const SrispCommand& command : srisp_commands()) {
        if (name == command.name)
            return &command;
        if (command.effect != Effect::configures)
            known.push_back(std::string("--") + command.name);
    }
    if (name.rfind("srisp", 0) == 0)
        fail_usage("unknown command '" + word + "'" + near_names("--" + name, known));
    return nullptr;
}

} // namespace srisp::tool
