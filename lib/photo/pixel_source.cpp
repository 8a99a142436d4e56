// SPDX-License-Identifier: Apache-2.0
#include "photo/pixel_source.h"

#include <algorithm>
#include <ctime>
#include <vector>

#include <OpenImageIO/filesystem.h>

#include "base/recently_kept.h"
#include "container/image_file.h"
#include "container/image_limits.h"

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
    const int first = y0 / tile * tile;
    const int end = std::min(first + rows_in_tiles(y1 - first, spec), spec.height);
    const std::size_t row = std::size_t(spec.width) * std::size_t(spec.nchannels);
    std::vector<float> tiles(row * std::size_t(end - first));
    if (!input.read_tiles(subimage, miplevel, spec.x, spec.x + spec.width, spec.y + first, spec.y + end, spec.z,
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
    FileSource(std::unique_ptr<ImageFile> file, const std::string& path, const OIIO::ImageSpec& hints,
               const std::string& name)
        : m_file(std::move(file)), m_path(path), m_name(name), m_key(file_state(path))
    {
        for (const OIIO::ParamValue& hint : hints.extra_attribs)
            m_key += "\n" + hint.name().string() + "=" + hint.get_string();
    }

    std::optional<OIIO::ImageSpec> find_level(int subimage, int miplevel) override
    {
        if (!m_file->seek_subimage(subimage, miplevel))
            return {};
        OIIO::ImageSpec spec = m_file->spec();
        add_date(spec, m_path);
        return spec;
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        if (read_image_rows(*m_file, subimage, miplevel, y0, y1, rows))
            return {};
        const std::string reason = m_file->geterror();
        return Error{ reason.empty() ? m_name + ": cannot be read" : reason };
    }

    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_key; }
    const GainMap* gain_map() const override { return m_file->gain_map(); }
    const std::vector<std::string>& notes() const override { return m_file->reading_notes(); }

private:
    std::unique_ptr<ImageFile> m_file;
    std::string m_path, m_name, m_key;
};

} // namespace

OIIO::ImageSpec reading_hints(const Options& options, const OIIO::ImageSpec& config)
{
    OIIO::ImageSpec hints = config;
    if (options.allow_partial)
        hints.attribute("srisp:allow_partial", 1);
    if (!options.isolate)
        hints.attribute("srisp:isolate", 0);
    if (options.gain_map == GainMapUse::apply)
        hints.attribute("srisp:gainmap", "apply");
    return hints;
}

Expected<std::unique_ptr<PixelSource>> open_file_source(const std::string& path, const std::string& kind,
                                                        const OIIO::ImageSpec& config)
{
    OIIO::ImageSpec hints = config;
    hints.attribute("oiio:UnassociatedAlpha", 1);
    const std::string name = kind + " '" + path + "'";
    auto file = ImageFile::open(path, hints, name);
    if (!file)
        return file.error();
    return std::unique_ptr<PixelSource>(std::make_unique<FileSource>(std::move(*file), path, hints, name));
}

} // namespace srisp
