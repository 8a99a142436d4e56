// SPDX-License-Identifier: Apache-2.0
#include "result/file_encoder.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "base/installed_files.h"
#include "base/png_orientation.h"
#include "base/shown_reason.h"

namespace srisp {

namespace {

/// As much of a value as a kind of file can hold; a writer takes the nearest that it has.
OIIO::TypeDesc stored_type(const std::string& format)
{
    if (format == "openexr")
        return OIIO::TypeHalf;
    const char* const floats[] = { "tiff", "fits", "hdr" };
    return std::count(std::begin(floats), std::end(floats), format) ? OIIO::TypeFloat : OIIO::TypeUInt16;
}

bool is_png(const OIIO::ImageOutput& output)
{
    return output.format_name() == std::string("png");
}

} // namespace

OIIO::ImageSpec file_spec(const OIIO::ImageOutput& output, const OIIO::ImageSpec& image, OIIO::TypeDesc type)
{
    OIIO::ImageSpec spec = image;
    spec.set_format(type == OIIO::TypeUnknown ? stored_type(output.format_name()) : type);
    const int orientation = spec.get_int_attribute("Orientation", 1);
    if (is_png(output) && orientation > 1 && orientation <= 8)
        spec.attribute(kPngOrientationKey, std::to_string(orientation) + kPngOrientationRest);
    spec.tile_width = spec.tile_height = 0; // tiles of the photo may have a size that this writer refuses
    return spec;
}

FileEncoder::FileEncoder(std::unique_ptr<OIIO::ImageOutput> output, const std::string& name)
    : m_name(name), m_bytes(std::make_unique<std::vector<unsigned char>>()),
      m_memory(std::make_unique<OIIO::Filesystem::IOVecOutput>(*m_bytes)), m_output(std::move(output))
{
}

Expected<FileEncoder> FileEncoder::create(const std::string& name)
{
    FileEncoder encoder(OIIO::ImageOutput::create(name, nullptr, plugins_beside()), name);
    if (!encoder.m_output)
        return Error{ shown_reason(OIIO::geterror()) };
    if (!encoder.m_output->supports("ioproxy") || !encoder.m_output->set_ioproxy(encoder.m_memory.get()))
        return Error{ std::string("OpenImageIO's writer of ") + encoder.m_output->format_name() +
                      " files writes to disks only" };
    return encoder;
}

Status FileEncoder::written(bool done) const
{
    if (done)
        return {};
    const std::string reason = shown_reason(m_output->geterror());
    return Error{ reason.empty() ? "its writer does not say why" : reason };
}

Status FileEncoder::begin(const OIIO::ImageSpec& image, OIIO::TypeDesc type, const std::string& compression)
{
    m_spec = file_spec(*m_output, image, type);
    if (!compression.empty())
        m_spec.attribute("compression", compression);
    m_bytes->reserve(m_spec.image_bytes()); // most files become smaller; memory that is not written costs nothing
    // Some writers (DPX) record the name, which shall name no folder.
    return written(m_output->open(std::filesystem::path(m_name).filename().string(), m_spec));
}

Status FileEncoder::add_rows(const float* rows, int count)
{
    const int first = m_spec.y + std::exchange(m_next, m_next + count);
    return written(m_output->write_scanlines(first, first + count, 0, OIIO::TypeFloat, rows));
}

Expected<std::vector<unsigned char>> FileEncoder::finish()
{
    if (const Status closed = written(m_output->close()); !closed)
        return closed.error();
    if (is_png(*m_output))
        place_png_orientation(*m_bytes);
    m_output.reset();
    return std::move(*m_bytes);
}

} // namespace srisp
