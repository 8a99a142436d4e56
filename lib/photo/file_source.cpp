// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <ctime>
#include <vector>

#include <OpenImageIO/filesystem.h>

#include "base/recently_kept.h"
#include "container/image_file.h"
#include "photo/code_values.h"
#include "photo/decoded_rows.h"
#include "photo/image_rows.h"
#include "photo/pixel_source.h"

namespace srisp {

namespace {

/// Writers put the time of writing where an image has none, and bytes would differ between runs. So it has the file's,
/// or that of $SOURCE_DATE_EPOCH [reproducible-builds.org].
void add_date(OIIO::ImageSpec& spec, const std::string& path)
{
    if (spec.find_attribute("DateTime") || !OIIO::Filesystem::exists(path))
        return;
    const char* const epoch = std::getenv("SOURCE_DATE_EPOCH");
    const std::time_t time =
        epoch ? std::time_t(std::strtoll(epoch, nullptr, 10)) : OIIO::Filesystem::last_write_time(path);
    std::tm utc{};
    char text[32];
    if (::gmtime_r(&time, &utc) && std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc))
        spec.attribute("DateTime", text);
}

/// `codes` start where a row of them does, in memory of new[] or of pages.
void to_floats(OIIO::TypeDesc type, const unsigned char* codes, std::size_t count, float* values)
{
    if (type == OIIO::TypeUInt8)
        codes_to_floats<std::uint8_t>(codes, count, values);
    else
        codes_to_floats(reinterpret_cast<const std::uint16_t*>(codes), count, values);
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

    void expect_second_pass(int subimage) override
    {
        const OIIO::ImageSpec spec = m_file->spec_dimensions(subimage, 0);
        m_offered.reset();
        m_decoding = {};
        if (holds_codes(spec))
            m_decoding = { subimage, 0, DecodedRows::create(row_values(spec) * spec.format.size(), spec.height) };
    }

    Status read_rows(int subimage, int miplevel, int y0, int y1, float* rows) override
    {
        const OIIO::ImageSpec spec = m_file->spec_dimensions(subimage, miplevel);
        const ImageLevel level{ subimage, miplevel };
        if (!holds_codes(spec)) // OpenImageIO makes floats of others
            return read_image_rows(*m_file, spec, level, y0, y1, OIIO::TypeFloat, rows) ? Status() : reading_error();
        const std::size_t values = row_values(spec) * std::size_t(y1 - y0);
        if (take_decoded(level, y0)) {
            to_floats(spec.format, m_taken.rows->row(y0), values, rows);
            m_taken.rows->forget_before(y1);
            return {};
        }
        const bool keeps = m_decoding.rows && miplevel == 0 && m_decoding.subimage == subimage && m_decoding.next == y0;
        if (!keeps)
            m_scratch.resize(values * spec.format.size());
        unsigned char* const codes = keeps ? m_decoding.rows->row(y0) : m_scratch.data();
        if (!read_image_rows(*m_file, spec, level, y0, y1, spec.format, codes))
            return reading_error();
        to_floats(spec.format, codes, values, rows);
        if (keeps && (m_decoding.next = y1) == spec.height) {
            m_offered = std::move(m_decoding.rows);
            DecodedRows::offer(decoded_key(subimage), m_offered);
        }
        return {};
    }

    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_key; }
    const GainMap* gain_map() const override { return m_file->gain_map(); }
    const std::vector<std::string>& notes() const override { return m_file->reading_notes(); }

private:
    struct Pass {
        int subimage = 0, next = 0; ///< row
        std::shared_ptr<DecodedRows> rows;
    };

    static bool holds_codes(const OIIO::ImageSpec& spec)
    {
        return spec.channelformats.empty() && are_codes(spec.format);
    }
    static std::size_t row_values(const OIIO::ImageSpec& spec)
    {
        return std::size_t(spec.width) * std::size_t(spec.nchannels);
    }
    std::string decoded_key(int subimage) const { return m_key + "\n" + std::to_string(subimage); }

    Error reading_error() const
    {
        const std::string reason = m_file->geterror();
        return Error{ reason.empty() ? m_name + ": cannot be read" : reason };
    }

    /// Whether the rows from y0 on are in `m_taken`.
    bool take_decoded(ImageLevel level, int y0)
    {
        if (level.miplevel != 0 || m_decoding.rows)
            return false;
        if (m_taken.rows && (m_taken.subimage != level.subimage || !m_taken.rows->holds(y0)))
            m_taken = {};
        if (!m_taken.rows)
            m_taken = { level.subimage, 0, DecodedRows::take(decoded_key(level.subimage)) };
        return m_taken.rows && m_taken.rows->holds(y0);
    }

    std::unique_ptr<ImageFile> m_file;
    std::string m_path, m_name, m_key;
    Pass m_decoding; ///< of a first pass: what it has decoded so far
    /// What a first pass has decoded: here until this source goes, wherever its next reader is.
    std::shared_ptr<DecodedRows> m_offered;
    Pass m_taken; ///< of a second pass
    std::vector<unsigned char> m_scratch;
};

} // namespace

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
