// SPDX-License-Identifier: Apache-2.0
#include <ctime>
#include <filesystem>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "base/text_file.h"
#include "photo/image_rows.h"
#include "photo/pixel_source.h"

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

    bool find_level(int subimage, int miplevel, OIIO::ImageSpec& spec) override
    {
        if (!m_input->seek_subimage(subimage, miplevel))
            return false;
        spec = m_input->spec();
        add_date(spec, m_path);
        return true;
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

private:
    std::unique_ptr<OIIO::ImageInput> m_input;
    std::string m_path, m_key;
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

} // namespace srisp
