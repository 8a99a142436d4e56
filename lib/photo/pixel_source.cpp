// SPDX-License-Identifier: Apache-2.0
#include "photo/pixel_source.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "base/recently_kept.h"

namespace srisp {

namespace {

/// Writers put the time of writing where an image has none, and bytes would differ between runs.
void add_date(OIIO::ImageSpec& spec, const std::string& path)
{
    if (spec.find_attribute("DateTime") || !OIIO::Filesystem::exists(path))
        return;
    const std::time_t time = OIIO::Filesystem::last_write_time(path);
    std::tm utc{};
    char text[32];
    if (::gmtime_r(&time, &utc) && std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc))
        spec.attribute("DateTime", text);
}

/// Whole rows of tiles are read; those asked for are copied.
bool read_tile_rows(OIIO::ImageInput& input, const OIIO::ImageSpec& spec, int subimage, int miplevel, int y0, int y1,
                    float* rows)
{
    const int tile = spec.tile_height;
    const int first = y0 / tile * tile, last = std::min((y1 + tile - 1) / tile * tile, spec.height);
    const std::size_t row = std::size_t(spec.width) * spec.nchannels;
    std::vector<float> tiles(row * (last - first));
    if (!input.read_tiles(subimage, miplevel, spec.x, spec.x + spec.width, spec.y + first, spec.y + last, spec.z,
                          spec.z + 1, 0, spec.nchannels, OIIO::TypeFloat, tiles.data()))
        return false;
    std::copy_n(tiles.data() + row * (y0 - first), row * (y1 - y0), rows);
    return true;
}

bool read_image_rows(OIIO::ImageInput& input, int subimage, int miplevel, int y0, int y1, float* rows)
{
    const OIIO::ImageSpec spec = input.spec_dimensions(subimage, miplevel);
    if (spec.tile_width)
        return read_tile_rows(input, spec, subimage, miplevel, y0, y1, rows);
    return input.read_scanlines(subimage, miplevel, spec.y + y0, spec.y + y1, spec.z, 0, spec.nchannels,
                                OIIO::TypeFloat, rows);
}

class FileSource : public PixelSource {
public:
    FileSource(std::unique_ptr<OIIO::ImageInput> input, const std::string& path, const OIIO::ImageSpec& hints)
        : m_input(std::move(input)), m_path(path), m_key(file_state(path))
    {
        // One thread: a reader that waits for pool threads may be given other work meanwhile, such as the host's next
        // request to this same reader.
        m_input->threads(1);
        for (const OIIO::ParamValue& hint : hints.extra_attribs)
            m_key += "\n" + hint.name().string() + "=" + hint.get_string();
    }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        if (!m_input->seek_subimage(subimage, miplevel))
            return {};
        OIIO::ImageSpec spec = m_input->spec();
        add_date(spec, m_path);
        return spec;
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        if (read_image_rows(*m_input, subimage, miplevel, y0, y1, rows))
            return {};
        const std::string reason = m_input->geterror();
        return Error{ "source '" + m_path + "': " + (reason.empty() ? "cannot be read" : reason) };
    }

    const std::string& name() const override { return m_path; }
    const std::string& key() const override { return m_key; }

protected:
    std::unique_ptr<OIIO::ImageInput> m_input;

private:
    std::string m_path, m_key;
};

class WholeFileSource : public FileSource {
public:
    WholeFileSource(std::unique_ptr<OIIO::ImageInput> input, const std::string& path, const OIIO::ImageSpec& hints,
                    const std::string& name)
        : FileSource(std::move(input), path, hints), m_name(name)
    {
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        // Truncated JPEGs are read to the end, grey from where they break off; the reader's warning is all that tells.
        if (read_image_rows(*m_input, subimage, miplevel, y0, y1, rows) && !m_input->has_error())
            return {};
        const std::string reason = m_input->geterror();
        return Error{ m_name + ": damaged or truncated at row " + std::to_string(y0) +
                      (reason.empty() ? "" : ": " + reason) };
    }

    const std::string& name() const override { return m_name; }

private:
    std::string m_name;
};

} // namespace

Expected<std::unique_ptr<PixelSource>> open_file_source(const std::string& path, const OIIO::ImageSpec& config)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return Error{ "source '" + path + "': is a folder" };
    OIIO::ImageSpec hints;
    for (const OIIO::ParamValue& hint : config.extra_attribs)
        if (!OIIO::Strutil::istarts_with(hint.name(), "srisp:"))
            hints.extra_attribs.push_back(hint);
    hints.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) {
        const std::string reason = OIIO::geterror();
        // A name may be more than a path (OpenImageIO has readers that take queries), so this is asked last.
        if (!std::filesystem::exists(path, ignored))
            return Error{ "source '" + path + "' does not exist" };
        return Error{ "source '" + path + "': " + (reason.empty() ? "cannot be opened" : reason) };
    }
    return std::unique_ptr<PixelSource>(std::make_unique<FileSource>(std::move(input), path, hints));
}

Expected<std::unique_ptr<PixelSource>> open_whole_file_source(const std::string& path, const std::string& kind)
{
    const std::string name = kind + " '" + path + "'";
    std::error_code ignored;
    // Before OpenImageIO sees the name: it would offer it to every plugin.
    if (!std::filesystem::is_regular_file(path, ignored))
        return Error{ name + ": " +
                      (std::filesystem::exists(path, ignored) ? "is not a regular file" : "does not exist") };
    OIIO::ImageSpec hints;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    auto input = OIIO::ImageInput::open(path, &hints);
    if (!input) {
        const std::string reason = OIIO::geterror();
        return Error{ name + ": " + (reason.empty() ? "is not an image that OpenImageIO reads" : reason) };
    }
    return std::unique_ptr<PixelSource>(std::make_unique<WholeFileSource>(std::move(input), path, hints, name));
}

} // namespace srisp
