// SPDX-License-Identifier: Apache-2.0
#include "container/image_file.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>

#include "base/file_bytes.h"
#include "base/recently_kept.h"
#include "base/regular_file.h"
#include "base/shown_reason.h"
#include "base/shown_text.h"
#include "color/color_encoding.h"
#include "container/file_description.h"
#include "container/image_limits.h"
#include "container/image_memory.h"
#include "container/own_dng_input.h"
#include "container/reader_name.h"
#include "container/size_in_header.h"
#include "container/webp_input.h"
#include "gain_map/find_gain_map.h"
#include "jpeg/jpeg_damage.h"
#include "raw_file/decoder_process.h"
#include "raw_file/libraw_traps.h"

namespace srisp {

namespace {

/// What is known of the pictures that one of OpenImageIO's readers gives.
struct Container {
    const char* reader;
    bool first_only = false;     ///< further subimages are other pictures: frames, layers, sizes
    bool straight_alpha = false; ///< colour is straight, though the reader may not say so
    void (*describe)(const std::string& path, OIIO::ImageSpec& spec) = nullptr;
};
constexpr Container kContainers[] = {
    { "bmp", false, true, describe_bmp },
    { "dpx", false, true },
    { "gif", true, true },
    { "heif", true, true, describe_heif },
    { "ico", true, true },
    { "jpeg2000", false, true },
    { "png", false, true, describe_png },
    { "psd", true, true, describe_psd },
    { "sgi", false, true },
    { "webp", true, true },
};

const Container& container_of(const char* reader)
{
    static constexpr Container kOther{ "" };
    const auto found = std::find_if(std::begin(kContainers), std::end(kContainers),
                                    [&](const Container& known) { return std::strcmp(known.reader, reader) == 0; });
    return found == std::end(kContainers) ? kOther : *found;
}

Expected<std::unique_ptr<OIIO::ImageInput>> open_by(const std::string& reader, const std::string& path,
                                                    const OIIO::ImageSpec& hints)
{
    if (reader == "webp")
        return open_webp(path);
    auto input = OIIO::ImageInput::create(reader);
    OIIO::ImageSpec spec;
    if (input && input->open(path, spec, hints))
        return input;
    const std::string reason = shown_reason(input ? input->geterror() : OIIO::geterror());
    return Error{ reason.empty() ? "is damaged, its reader does not say how" : reason };
}

/// LibRaw trusts the files that OpenImageIO gives it: first somebody else tries, or looks.
Status check_raw(const std::string& path, bool isolate)
{
    if (isolate) { // a photo is opened several times
        constexpr std::size_t kMostKept = 64;
        static auto& tried = *new RecentlyKept<std::shared_ptr<const std::string>>(kMostKept);
        const auto harmless = tried.get(file_state(path), [&]() -> Expected<std::shared_ptr<const std::string>> {
            auto answer = run_decoder(DecoderTask::trial, path);
            if (!answer)
                return answer.error();
            return std::make_shared<const std::string>(*answer);
        });
        return harmless ? Status() : Status(harmless.error());
    }
    const auto file = read_whole_file(path);
    return file ? check_libraw_traps(*file) : Status(file.error());
}

/// A reader of films takes "pipe:0.mp4" or "http:/host/a.mp4" for something else than a file.
std::string name_for_reader(const std::string& path)
{
    return path.find(':') < path.find('/') ? "./" + path : path;
}

struct OpenedInput {
    std::unique_ptr<OIIO::Filesystem::IOProxy> file; ///< what the input reads; null: by name
    std::unique_ptr<OIIO::ImageInput> input;
    std::shared_ptr<const OwnDng> own_dng; ///< null: it is none
};

/// Of a file, or of a name that only a reader understands.
Expected<OpenedInput> open_input(const std::string& path, OIIO::ImageSpec hints, bool isolate)
{
    std::error_code ignored;
    if (is_url(path))
        return Error{ kIsUrl };
    if (!std::filesystem::exists(path, ignored)) {
        if (path.find('?') == std::string::npos)
            return Error{ "does not exist" };
        auto input = OIIO::ImageInput::open(name_for_reader(path), &hints);
        if (!input)
            return Error{ OIIO::geterror() };
        return OpenedInput{ nullptr, std::move(input), nullptr };
    }
    if (!std::filesystem::is_regular_file(path, ignored))
        return Error{ std::filesystem::is_directory(path, ignored) ? "is a folder" : kIsNoRegularFile };
    const auto head = read_head(path, kReaderHeadBytes);
    if (!head)
        return head.error();
    std::string reader = reader_name(*head, path);
    if (reader.empty())
        return Error{ "is not an image that OpenImageIO reads" };
    const bool named_raw = reader == kRawReader;
    const auto own_dng = named_raw || reader == kTiffReader ? find_own_dng(path, named_raw)
                                                            : Expected<std::shared_ptr<const OwnDng>>(nullptr);
    if (!own_dng)
        return own_dng.error();
    std::unique_ptr<OIIO::Filesystem::IOProxy> file;
    if (*own_dng) { // whatever it is called
        reader = (*own_dng)->is_float ? kTiffReader : kRawReader;
        if ((*own_dng)->is_float)
            file = ask_for_main_image(**own_dng, path, hints);
        else
            ask_for_camera_rgb(**own_dng, hints);
    }
    if (reader == kRawReader)
        if (Status status = check_raw(path, isolate); !status)
            return status.error();
    if (const Status header = check_header(reader, path); !header)
        return header.error();
    auto input = open_by(reader, name_for_reader(path), hints);
    if (!input)
        return input.error();
    return OpenedInput{ std::move(file), std::move(*input), *own_dng };
}

/// Of integers that nothing names, or whose name nobody knows: what an image was is forgotten once a program has made
/// it float. Every PNM is "Rec709" to its reader, whatever it holds.
void name_color_space(OIIO::ImageSpec& spec)
{
    const std::string name = spec.get_string_attribute("oiio:ColorSpace");
    const bool known = named_encoding(name) && name != "Rec709";
    if (spec.format.is_floating_point() || known)
        return;
    if (!name.empty() && name != "Rec709")
        add_note(spec, "the colour space '" + shown_text(name) + "' is not known; taken as display-encoded sRGB");
    spec.attribute("oiio:ColorSpace", "sRGB");
}

/// OpenImageIO turns these right up to 8 bits, alpha included.
bool is_min_is_white(const OIIO::ImageSpec& spec)
{
    return spec.get_int_attribute("tiff:PhotometricInterpretation", 1) == 0;
}

template<class Value> void invert(void* data, std::size_t count)
{
    Value* const values = static_cast<Value*>(data);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = static_cast<Value>(~values[i]);
}

/// 8-bit values at the start of their own place become 16-bit ones.
void widen(void* data, std::size_t count)
{
    const auto* const bytes = static_cast<const std::uint8_t*>(data);
    auto* const shorts = static_cast<std::uint16_t*>(data);
    for (std::size_t i = count; i-- > 0;)
        shorts[i] = static_cast<std::uint16_t>(bytes[i] * 257);
}

} // namespace

Expected<std::unique_ptr<ImageFile>> ImageFile::open(const std::string& path, const OIIO::ImageSpec& config,
                                                     const std::string& where)
{
    OIIO::ImageSpec hints;
    for (const OIIO::ParamValue& hint : config.extra_attribs)
        if (hint.name().string().rfind("srisp:", 0) != 0)
            hints.extra_attribs.push_back(hint);
    // Colour is asked for straight, so that nothing is lost in dark transparent pixels.
    hints.attribute("oiio:UnassociatedAlpha", 1);

    auto opened = open_input(path, hints, config.get_int_attribute("srisp:isolate", 1) != 0);
    if (!opened)
        return Error{ where + ": " + opened.error().message };
    auto file = std::unique_ptr<ImageFile>(new ImageFile(std::move(opened->input), path, config, where));
    if (opened->own_dng && !opened->own_dng->truncation.empty()) {
        if (!file->m_allows_partial)
            return Error{ where + ": " + opened->own_dng->truncation };
        file->m_notes = { opened->own_dng->truncation + "; the rest was left as its reader gives it" };
    }
    file->m_own_dng = std::move(opened->own_dng);
    file->m_file = std::move(opened->file);
    if (!file->seek_subimage(0, 0))
        return Error{ file->geterror() };
    return file;
}

ImageFile::ImageFile(std::unique_ptr<OIIO::ImageInput> inner, const std::string& path, const OIIO::ImageSpec& config,
                     const std::string& where)
    : m_inner(std::move(inner)), m_path(path), m_where(where),
      m_wants_straight(config.get_int_attribute("oiio:UnassociatedAlpha") != 0),
      m_allows_partial(config.get_int_attribute("srisp:allow_partial") != 0),
      m_applies_gain_map(config.get_string_attribute("srisp:gainmap") == "apply")
{
    // One thread: a reader that waits for pool threads may be given other work meanwhile, such as the host's next
    // request to this same reader.
    m_inner->threads(1);
}

bool ImageFile::seek_subimage(int subimage, int miplevel)
{
    const lock_guard lock(*this);
    if (subimage == m_subimage && miplevel == m_miplevel)
        return true;
    const Container& container = container_of(m_inner->format_name());
    const bool found = !(container.first_only && subimage > 0) && m_inner->seek_subimage(subimage, miplevel);
    if (!found) {
        m_inner->geterror(); // or the next reading would find it
        return false;
    }
    OIIO::ImageSpec spec = m_inner->spec();
    if (const Status size = check_spec(spec); !size) {
        errorfmt("{}: {}", m_where, size.error().message);
        return false;
    }
    limit_strips(spec);
    if (container.straight_alpha)
        spec.attribute("oiio:UnassociatedAlpha", 1);
    if (container.describe && subimage == 0)
        container.describe(m_path, spec);
    else if (spec.get_int_attribute("oiio:Movie") && m_inner->seek_subimage(1, 0)) {
        m_inner->seek_subimage(0, 0);
        add_note(spec, "is an animation; its first frame was taken");
    }
    if (std::strcmp(format_name(), "jpeg") == 0)
        look_for_gain_map(spec);
    if (m_own_dng)
        describe_own_dng(*m_own_dng, spec);
    else
        name_color_space(spec);

    const bool white_is_0 = is_min_is_white(spec);
    if (white_is_0 && (spec.format.is_floating_point() || spec.nchannels > 1)) {
        errorfmt("{}: stores white as 0 (PhotometricInterpretation 0) in {}, which is not supported", m_where,
                 spec.nchannels > 1 ? "an image with alpha" : "floating point");
        return false;
    }
    m_inverts = white_is_0 && spec.format.size() > 1;
    const bool straight = spec.get_int_attribute("oiio:UnassociatedAlpha") != 0 && spec.alpha_channel >= 0;
    m_associates = straight && !m_wants_straight;
    m_widens = m_associates && spec.format == OIIO::TypeUInt8 && spec.channelformats.empty();
    if (m_widens)
        spec.set_format(OIIO::TypeUInt16);
    if (!straight || m_associates)
        spec.erase_attribute("oiio:UnassociatedAlpha");
    m_spec = std::move(spec);
    m_subimage = subimage;
    m_miplevel = miplevel;
    return true;
}

Status ImageFile::check_spec(const OIIO::ImageSpec& spec) const
{
    if (Status size = check_size(spec); !size)
        return size;
    if (Status fits = check_reading_memory(format_name(), spec); !fits)
        return fits;
    std::error_code no_file; // but a name that its reader understands
    const std::uintmax_t bytes = std::filesystem::file_size(m_path, no_file);
    if (no_file)
        return {};
    // The header of a JPEG was looked at before it was opened: it says how the file is coded, too.
    const bool looked = std::strcmp(format_name(), "jpeg") == 0;
    return looked ? Status() : check_claim(format_name(), std::uint64_t(spec.width), std::uint64_t(spec.height), bytes);
}

/// Nothing about it is an error: the photo is there without it.
void ImageFile::look_for_gain_map(OIIO::ImageSpec& spec)
{
    const auto found = find_gain_map_of_file(m_path);
    if (found && !*found)
        return;
    const std::string taken = "; the SDR rendition was taken";
    if (!found) {
        add_note(spec, found.error().message + taken);
    } else if (!m_applies_gain_map) {
        add_note(spec, "holds a gain map (" + (*found)->name() + "), and so a picture of more range" + taken +
                           " (gainmap=apply takes the other)");
    } else {
        auto map = GainMap::create(**found, spec.width, spec.height);
        if (map)
            m_gain_map = std::move(*map);
        else
            add_note(spec, map.error().message + taken);
    }
}

/// What the reader made of some rows or a tile.
bool ImageFile::accept(bool read, int y, void* data, std::size_t bytes)
{
    if (read && !m_inner->has_error())
        return true;
    std::string reason = shown_reason(m_inner->geterror());
    if (read && !m_notes.empty())
        return true; // told already
    if (std::strcmp(format_name(), "jpeg") == 0) {
        const JpegDamage damage = find_jpeg_damage(m_path);
        reason = damage.text;
        if (read && !damage.pixels_missing) {
            m_notes = { "is damaged, though no pixel is missing: " + reason };
            return true;
        }
    }
    const std::string what = "damaged or truncated at row " + std::to_string(y) + (reason.empty() ? "" : ": " + reason);
    if (!m_allows_partial) {
        errorfmt("{}: {}", m_where, what);
        return false;
    }
    if (!read)
        std::memset(data, 0, bytes);
    if (m_notes.empty())
        m_notes = { what + "; the rest was left as its reader gives it" };
    return true;
}

void ImageFile::put_right(void* data, int width, int height) const
{
    const std::size_t values = std::size_t(width) * std::size_t(height) * std::size_t(m_spec.nchannels);
    if (m_widens)
        widen(data, values);
    if (m_inverts && m_spec.format.size() == 2)
        invert<std::uint16_t>(data, values);
    else if (m_inverts)
        invert<std::uint32_t>(data, values);
    if (m_associates && m_spec.channelformats.empty())
        OIIO::premult(m_spec.nchannels, width, height, 1, 0, m_spec.nchannels, m_spec.format, data, OIIO::AutoStride,
                      OIIO::AutoStride, OIIO::AutoStride, m_spec.alpha_channel, m_spec.z_channel);
}

bool ImageFile::read_native_scanline(int subimage, int miplevel, int y, int z, void* data)
{
    return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
}

bool ImageFile::read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data)
{
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    const int end = std::min(yend, m_spec.y + m_spec.height), rows = end - ybegin;
    if (ybegin < m_spec.y || rows < 1) {
        errorfmt("{}: has no rows {} to {}", m_where, ybegin, yend);
        return false;
    }
    const bool read = m_inner->read_native_scanlines(subimage, miplevel, ybegin, end, z, data);
    if (!accept(read, ybegin - m_spec.y, data, m_spec.scanline_bytes(true) * static_cast<std::size_t>(rows)))
        return false;
    put_right(data, m_spec.width, rows);
    return true;
}

bool ImageFile::read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data)
{
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    const bool read = m_inner->read_native_tile(subimage, miplevel, x, y, z, data);
    if (!accept(read, y - m_spec.y, data, m_spec.tile_bytes(true)))
        return false;
    put_right(data, m_spec.tile_width, m_spec.tile_height);
    return true;
}

bool ImageFile::read_native_deep_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, int chbegin,
                                           int chend, OIIO::DeepData& deepdata)
{
    return m_inner->read_native_deep_scanlines(subimage, miplevel, ybegin, yend, z, chbegin, chend, deepdata);
}

bool ImageFile::read_native_deep_tiles(int subimage, int miplevel, int xbegin, int xend, int ybegin, int yend,
                                       int zbegin, int zend, int chbegin, int chend, OIIO::DeepData& deepdata)
{
    return m_inner->read_native_deep_tiles(subimage, miplevel, xbegin, xend, ybegin, yend, zbegin, zend, chbegin, chend,
                                           deepdata);
}

} // namespace srisp
