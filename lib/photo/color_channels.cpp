// SPDX-License-Identifier: Apache-2.0
#include "photo/color_channels.h"

#include <algorithm>

#include <OpenImageIO/strutil.h>

namespace srisp {

namespace {

namespace Strutil = OIIO::Strutil;

/// What the file stores, where its reader gives RGB that it made without colour management; "" otherwise.
std::string foreign_color_model(const OIIO::ImageSpec& spec)
{
    for (const char* name : { "jpeg:ColorSpace", "tiff:ColorSpace" }) {
        const std::string model = spec.get_string_attribute(name);
        for (const char* foreign : { "CMYK", "YCbCrK", "YCCK", "CIELAB", "ICCLAB", "ITULAB", "LOGL", "LOGLUV" })
            if (Strutil::iequals(model, foreign))
                return model;
    }
    // 5: separated (inks), 8, 9, 10: Lab (TIFF 6.0)
    const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", 2);
    if (photometric == 5)
        return "CMYK";
    return photometric >= 8 && photometric <= 10 ? "Lab" : "";
}

int find_channel(const OIIO::ImageSpec& spec, const std::string& name)
{
    for (int c = 0; c < spec.nchannels; ++c)
        if (Strutil::iequals(spec.channel_name(c), name))
            return c;
    return -1;
}

/// R, G and B of the same layer, the one without a name first; empty where there are none.
std::vector<int> find_rgb(const OIIO::ImageSpec& spec)
{
    std::vector<std::string> layers = { "" };
    for (int c = 0; c < spec.nchannels; ++c) {
        const std::string name = spec.channel_name(c);
        if (Strutil::iends_with(name, ".R"))
            layers.push_back(name.substr(0, name.size() - 1));
    }
    for (const std::string& layer : layers) {
        const std::vector<int> found = { find_channel(spec, layer + "R"), find_channel(spec, layer + "G"),
                                         find_channel(spec, layer + "B") };
        if (std::count(found.begin(), found.end(), -1) == 0)
            return found;
    }
    return {};
}

std::string channel_list(const OIIO::ImageSpec& spec)
{
    return Strutil::join(spec.channelnames, ", ");
}

} // namespace

Expected<ColorChannels> find_color_channels(const OIIO::ImageSpec& spec, const std::string& where)
{
    const std::string foreign = foreign_color_model(spec);
    if (!foreign.empty())
        return Error{ where + ": is a " + foreign + " image; convert it to RGB first" };
    ColorChannels channels;
    channels.alpha = spec.alpha_channel >= 0 && spec.alpha_channel < spec.nchannels ? spec.alpha_channel : -1;
    channels.color = find_rgb(spec);
    if (channels.color.empty()) {
        if (find_channel(spec, "C") >= 0 && find_channel(spec, "M") >= 0 && find_channel(spec, "K") >= 0)
            return Error{ where + ": is a CMYK image; convert it to RGB first" };
        for (int c = 0; c < spec.nchannels; ++c)
            if (c != channels.alpha && c != spec.z_channel)
                channels.color.push_back(c);
        if (channels.color.size() != 1)
            return Error{ where + ": has the channels " + channel_list(spec) +
                          "; a photo needs R, G, B or one grey channel" };
    }
    for (int c = 0; c < spec.nchannels; ++c)
        if (c != channels.alpha && !std::count(channels.color.begin(), channels.color.end(), c))
            channels.others.push_back(c);
    return channels;
}

} // namespace srisp
