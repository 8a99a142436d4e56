// SPDX-License-Identifier: Apache-2.0
#include "help.h"

#include <algorithm>
#include <sstream>

#include "command_line.h"

namespace srisp::tool {

namespace {

const char kHead[] = R"(srisptool -- oiiotool, and the way from a photo to a RAW-like image and back

Usage: srisptool [filename|command]...

Every command of oiiotool works as always; srisptool --help lists them. These
are added:

)";

const char kReferences[] = R"(
REF is a RAW file, a linear image that srisptool made, or any linear EXR in
camera RGB. A folder, a quoted pattern ("shots/*.dng") or a list ("a.dng;b.dng")
stands for one of its files, chosen by seed= and the photo's name. With params=
it may be "-". Names of references, parameters and models are taken literally:
# and {} are no wildcards and expressions there.

SOURCE says where the figures of the noise come from: "reference" (what REF says
of its noise, else the noise in REF's own pixels), "iso=800" (darktable's table
of cameras), "shot=0.01,read=0.0001" (variance = shot x value + read; three
figures each for R, G, B), or "upi" (drawn at random as Brooks et al. 2019 do).

Options of these commands follow the command, as in oiiotool:

)";

const char kTail[] = R"(
A value that holds a colon is quoted: '--srisp-unprocess:params="at 12:30.json"'

RAW-like images need more than 8 bits. Where no -d is given and the format
cannot hold float (PNG), 16 bits are written.

-o of a DNG takes layout=standard or cinema, compression=lossless, none or
deflate, bits=10 to 16, and datatype=half or float.

Examples:
  srisptool photo.jpg --srisp-unprocess ref.dng -o raw.exr
  srisptool raw.exr --srisp-process -o photo_again.png
  srisptool photo.jpg --srisp-unprocess ref.dng --srisp-mosaic \
            --srisp-noise reference -o photo.dng
  srisptool photo.jpg --srisp-unprocess ref.dng --srisp-develop ACEScg -o p.exr
  srisptool photo.jpg --srisp-params ref.dng > look.json
  srisptool photo.jpg --srisp-unprocess:params=look.json - -o raw.exr
  srisptool --frames 1-240 s.#.jpg --srisp-unprocess:hold=1 ref.dng -o raw.#.exr

Environment:
  SRISP_OIIOTOOL    the oiiotool to run; default: the first on PATH that is not
                    srisptool
  SRISP_MODEL_PATH  folders with models, separated by colons
  SRISP_MAX_MEGAPIXELS
                    the most pixels that an image may have, in millions; default
                    2000
  SRISP_MAX_MEMORY  the most memory that one image may take: 2G, or megabytes;
                    default all that the machine has
  TMPDIR            where small hand-over files lie while it runs

Exit codes: oiiotool's own; 1 where srisptool itself failed, 2 for wrong usage
of its commands.
)";

/// One entry of a list: its name, and its text wrapped in the column beside it.
std::string entry(const std::string& name, std::size_t column, const std::string& text)
{
    constexpr std::size_t kWidth = 80;
    std::string result, line = "  " + name;
    line.resize(std::max(line.size(), column - 1), ' ');
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        if (line.size() + 1 + word.size() > kWidth) {
            result += line + "\n";
            line.assign(column - 1, ' ');
        }
        line += " " + word;
    }
    return result + line + "\n";
}

std::string command_entry(const SrispCommand& command)
{
    std::string options;
    for (const std::string& key : option_keys(command.door))
        options += (options.empty() ? " (options: " : ", ") + key + "=";
    const std::string argument = command.argument ? std::string(" ") + command.argument : "";
    return entry(std::string("--") + command.name + argument, 28,
                 command.help + options + (options.empty() ? "" : ")"));
}

std::string option_entry(const Option& option)
{
    std::string text = option.help;
    const std::string by_default = std::string(" (default ") + option.default_value + ")";
    if (option.type == OptionType::number)
        text += by_default;
    if (option.type == OptionType::choice) {
        std::string values;
        for (std::size_t i = 0; i < option.values.size(); ++i)
            values += (i == 0 ? "" : i + 1 < option.values.size() ? ", " : " or ") + option.values[i];
        text = values + by_default + ": " + text;
    }
    return entry(std::string(option.key) + "=" + option.argument, 17, text);
}

} // namespace

std::string help_text()
{
    std::string text = kHead;
    for (const SrispCommand& command : srisp_commands())
        text += command_entry(command);
    text += kReferences;
    for (const Option& option : option_table())
        if (option.doors & kCommands)
            text += option_entry(option);
    return text + kTail;
}

} // namespace srisp::tool
