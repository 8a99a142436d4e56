// SPDX-License-Identifier: Apache-2.0
#include "srisp_input.h"

#include <algorithm>

#include "base/guarded.h"
#include "base/shown_text.h"
#include "process_state.h"

namespace srisp::plugin {

namespace {

/// Runs a step of the reader; what is thrown in it becomes an error.
template<class Step> Status guarded_step(const Step& step)
{
    return guarded("srisp", {}, step);
}

} // namespace

int SrispInput::supports(OIIO::string_view feature) const
{
    return feature == "arbitrary_metadata" || feature == "exif" || feature == "iptc" || feature == "multiimage" ||
           feature == "mipmap";
}

/// Whether it is; fails where there is no memory to look.
static Expected<bool> looks_ours(const std::string& name)
{
    bool ours = false;
    const Status looked = guarded_step([&]() -> Status {
        ours = is_our_name(name);
        return {};
    });
    return looked ? Expected<bool>(ours) : looked.error();
}

bool SrispInput::valid_file(const std::string& name) const
{
    const auto ours = looks_ours(name);
    return ours && *ours;
}

bool SrispInput::open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config)
{
    // OpenImageIO 2.4 sets "nowait" when it offers a file that nobody knows to every reader, and holds a lock meanwhile
    // that any call of ours would wait for.
    const auto ours = config.get_int_attribute("nowait") ? Expected<bool>(false) : looks_ours(name);
    if (!ours)
        return fail(ours.error().message);
    if (!*ours)
        return fail("'" + name + "': is not a recipe of srisp's");
    close();
    const Status opened = guarded_step([&]() -> Status {
        auto opened_name = open_name(name, config);
        if (!opened_name)
            return opened_name.error();
        m_opened = std::move(*opened_name);
        return {};
    });
    if (!opened)
        return fail(opened.error().message);
    if (!seek_subimage(0, 0))
        return false;
    spec = m_spec;
    return true;
}

bool SrispInput::close()
{
    const lock_guard lock(*this);
    m_opened = {};
    m_subimage = m_miplevel = -1;
    m_spec = OIIO::ImageSpec();
    return true;
}

bool SrispInput::fail(const std::string& message) const
{
    errorfmt("{}", valid_utf8(message));
    return false;
}

int SrispInput::current_subimage() const
{
    const lock_guard lock(*this);
    return m_subimage;
}

int SrispInput::current_miplevel() const
{
    const lock_guard lock(*this);
    return m_miplevel;
}

Status SrispInput::seek(int subimage, int miplevel, bool& found)
{
    if (ImageFile* const file = m_opened.file.get()) {
        found = file->seek_subimage(subimage, miplevel);
        if (found)
            m_spec = file->spec();
        else if (file->has_error())
            return Error{ file->geterror() };
        return {};
    }
    auto spec = m_opened.result->header(subimage, miplevel);
    if (spec && *spec && !m_opened.result->is_lazy())
        spec = m_opened.result->full_spec(subimage, miplevel, threads());
    if (!spec)
        return spec.error();
    if ((found = *spec != nullptr))
        m_spec = **spec;
    return {};
}

bool SrispInput::seek_subimage(int subimage, int miplevel)
{
    const lock_guard lock(*this);
    if (!m_opened.result && !m_opened.file)
        return false;
    if (subimage == m_subimage && miplevel == m_miplevel)
        return true;
    bool found = false;
    const Status sought = guarded_step([&] { return seek(subimage, miplevel, found); });
    if (!sought)
        return fail(sought.error().message);
    if (found) {
        m_subimage = subimage;
        m_miplevel = miplevel;
    }
    return found;
}

/// What reading from a file has shown goes to the user here; pixels are on their way to another command.
template<class Read> bool SrispInput::read_file(const Read& read) const
{
    ImageFile& file = *m_opened.file;
    const Status done = guarded_step([&]() -> Status { return read(file) ? Status() : Error{ file.geterror() }; });
    if (!done)
        return fail(done.error().message);
    if (m_opened.notes)
        process_state().results.print_notes(file.where(), file.reading_notes());
    return true;
}

bool SrispInput::read_native_scanline(int subimage, int miplevel, int y, int z, void* data)
{
    return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
}

bool SrispInput::read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data)
{
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    if (m_opened.file)
        return read_file(
            [&](ImageFile& file) { return file.read_native_scanlines(subimage, miplevel, ybegin, yend, z, data); });
    const int y0 = ybegin - m_spec.y, y1 = std::min(yend - m_spec.y, m_spec.height);
    if (y0 < 0 || y0 > y1)
        return fail("scanlines " + std::to_string(ybegin) + " to " + std::to_string(yend) + " lie outside the image");
    const int width = m_spec.width;
    const std::size_t row = std::size_t(width) * m_spec.nchannels;
    const Status read = guarded_step([&] {
        return m_opened.result->read(subimage, miplevel, threads(), 0, width, y0, y1, static_cast<float*>(data), row);
    });
    return read || fail(read.error().message);
}

bool SrispInput::read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data)
{
    const lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel))
        return false;
    if (m_opened.file)
        return read_file([&](ImageFile& file) { return file.read_native_tile(subimage, miplevel, x, y, z, data); });
    const int x0 = x - m_spec.x, y0 = y - m_spec.y;
    if (!m_spec.tile_width || x0 < 0 || y0 < 0 || x0 >= m_spec.width || y0 >= m_spec.height)
        return fail("the image has no tile at " + std::to_string(x) + ", " + std::to_string(y));
    const std::size_t row = std::size_t(m_spec.tile_width) * m_spec.nchannels;
    const int x1 = std::min(x0 + m_spec.tile_width, m_spec.width);
    const int y1 = std::min(y0 + m_spec.tile_height, m_spec.height);
    float* tile = static_cast<float*>(data);
    std::fill_n(tile, row * m_spec.tile_height, 0.0f);
    const Status read =
        guarded_step([&] { return m_opened.result->read(subimage, miplevel, threads(), x0, x1, y0, y1, tile, row); });
    return read || fail(read.error().message);
}

bool SrispInput::read_native_deep_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, int chbegin,
                                            int chend, OIIO::DeepData& deepdata)
{
    const lock_guard lock(*this);
    return m_opened.file && read_file([&](ImageFile& file) {
               return file.read_native_deep_scanlines(subimage, miplevel, ybegin, yend, z, chbegin, chend, deepdata);
           });
}

bool SrispInput::read_native_deep_tiles(int subimage, int miplevel, int xbegin, int xend, int ybegin, int yend,
                                        int zbegin, int zend, int chbegin, int chend, OIIO::DeepData& deepdata)
{
    const lock_guard lock(*this);
    return m_opened.file && read_file([&](ImageFile& file) {
               return file.read_native_deep_tiles(subimage, miplevel, xbegin, xend, ybegin, yend, zbegin, zend, chbegin,
                                                  chend, deepdata);
           });
}

} // namespace srisp::plugin
