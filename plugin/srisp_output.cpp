// SPDX-License-Identifier: Apache-2.0
#include "srisp_output.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <nlohmann/json.hpp>
#include <srisp/metadata.h>

#include "base/guarded.h"
#include "base/output_file.h"
#include "base/shown_text.h"
#include "container/image_limits.h"
#include "container/image_memory.h"
#include "hand_over.h"
#include "open_name.h"
#include "recipe/frame_pattern.h"
#include "result/result_image.h"

namespace srisp::plugin {

namespace {

/// Prints the parameters that the job would apply to the image in a slot, as one line of JSON on stdout: `{"image":
/// name, …}`.
Status print_parameters(Recipe job, const std::string& slot_id)
{
    if (const auto slot = process_state().slots.find(slot_id))
        job.name = with_frame(job.name, slot->frame);
    auto image = ResultImage::open(job, open_slot_source(slot_id, job.name), {}, process_state().results);
    if (!image)
        return image.error();
    const auto choice = (*image)->choice(0, 0);
    if (!choice)
        return choice.error();
    const std::string name = nlohmann::json(job.name).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
    // to_json gives an object; the name goes in front of its first key.
    const std::string line = "{\"image\": " + name + ", " + to_json((*choice)->parameters, -1).substr(1) + "\n";
    if (std::fputs(line.c_str(), stdout) < 0 || std::fflush(stdout) != 0)
        return Error{ "parameters: stdout cannot be written" };
    return {};
}

/// Writes the parameters recorded in an image to the job's `file`, in whose last part `####` or `%04d` is replaced by
/// the frame number.
Status save_parameters(const Recipe& job, const OIIO::ImageSpec& spec, const std::string& frame)
{
    const auto parameters = recorded_parameters(spec, job.name);
    if (!parameters)
        return parameters.error();
    // Folders are literal: they may well hold '#' or '%20d'.
    std::filesystem::path file = job.file;
    file.replace_filename(with_frame(file.filename().string(), frame));
    const Status written = write_output_file(file.string(), to_json(*parameters) + "\n");
    return written ? written : Status(Error{ "parameters " + written.error().message });
}

} // namespace

int SrispOutput::supports(OIIO::string_view feature) const
{
    for (const char* known : { "alpha", "nchannels", "displaywindow", "origin", "negativeorigin", "tiles", "multiimage",
                               "appendsubimage", "mipmap", "random_access", "arbitrary_metadata", "exif", "iptc" })
        if (feature == known)
            return true;
    return false;
}

bool SrispOutput::fail(const std::string& message)
{
    errorfmt("{}", valid_utf8(message));
    return false;
}

Status SrispOutput::begin(const std::string& name)
{
    auto job = read_job(name);
    if (!job)
        return Error{ "'" + name + "': srisp files hold no pixels; write EXR or TIFF (no hand-over of srisptool's: " +
                      job.error().message + ")" };
    m_job = *job;
    m_path = name;
    m_slot = std::make_shared<Slot>();
    m_slot->job = m_job.path;
    m_slot->frame = parse_stub_name(name).frame;
    return {};
}

bool SrispOutput::succeeds(const std::function<Status()>& step)
{
    const Status done = guarded("srisp", {}, step);
    return done || fail(done.error().message);
}

Status SrispOutput::begin_level(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode)
{
    if (spec.deep)
        return Error{ name + ": a deep image cannot be unprocessed; flatten it first" };
    if (spec.depth > 1)
        return Error{ name + ": a volume cannot be unprocessed" };
    if (const Status size = check_size(spec); !size)
        return Error{ name + ": cannot be unprocessed: it " + size.error().message };
    if (const Status fits = check_memory(spec.image_pixels(), spec.nchannels); !fits)
        return Error{ name + ": cannot be unprocessed: it " + fits.error().message };
    if (mode == Create) {
        m_slot.reset();
        if (Status begun = begin(name); !begun)
            return begun;
    }
    if (!m_slot)
        return Error{ name + ": is not open" };
    m_spec = spec;
    m_spec.set_format(OIIO::TypeFloat);
    m_spec.channelformats.clear();
    limit_strips(m_spec);
    if (mode != AppendMIPLevel || m_slot->subimages.empty())
        m_slot->subimages.emplace_back();
    m_slot->subimages.back().push_back(
        { m_spec, KeptRows(std::size_t(m_spec.height), std::size_t(m_spec.width) * std::size_t(m_spec.nchannels)) });
    m_tile_row = -1;
    return {};
}

bool SrispOutput::open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode)
{
    return succeeds([&] { return begin_level(name, spec, mode); });
}

bool SrispOutput::open(const std::string& name, int subimages, const OIIO::ImageSpec* specs)
{
    return subimages > 0 && open(name, specs[0], Create);
}

bool SrispOutput::close()
{
    if (!m_slot)
        return true;
    const bool finished = succeeds([&] { return finish(); });
    m_slot.reset();
    return finished;
}

Status SrispOutput::finish()
{
    for (auto& levels : m_slot->subimages)
        for (SlotLevel& level : levels)
            level.rows.pack();
    const std::string id = process_state().slots.keep(m_slot);
    if (m_job.action == Recipe::Action::print)
        if (const Status printed = print_parameters(m_job, id); !printed)
            return printed;
    if (m_job.action == Recipe::Action::save)
        if (const Status saved = save_parameters(m_job, m_slot->subimages[0][0].spec, m_slot->frame); !saved)
            return saved;
    // A host renames what it wrote, so there must be a file even where nothing is read back.
    return write_output_file(m_path, stub_text(id));
}

bool SrispOutput::write_scanline(int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride)
{
    const int row = y - m_spec.y;
    if (!m_slot || row < 0 || row >= m_spec.height)
        return fail("scanline " + std::to_string(y) + " lies outside the image");
    return succeeds([&]() -> Status {
        std::vector<unsigned char> scratch;
        m_spec.auto_stride(xstride, format, m_spec.nchannels);
        const void* const native = to_native_scanline(format, data, xstride, scratch, 0, y, z);
        rows().put(std::size_t(row), static_cast<const float*>(native));
        return {};
    });
}

bool SrispOutput::write_tile(int x, int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride,
                             OIIO::stride_t ystride, OIIO::stride_t zstride)
{
    const int x0 = x - m_spec.x, y0 = y - m_spec.y;
    if (!m_slot || x0 < 0 || y0 < 0 || x0 >= m_spec.width || y0 >= m_spec.height)
        return fail("the tile at " + std::to_string(x) + ", " + std::to_string(y) + " lies outside the image");
    return succeeds([&]() -> Status {
        if (y0 != m_tile_row) // the ones above are complete, as a rule
            rows().pack();
        m_tile_row = y0;
        std::vector<unsigned char> scratch;
        m_spec.auto_stride(xstride, ystride, zstride, format, m_spec.nchannels, m_spec.tile_width, m_spec.tile_height);
        const auto* native =
            static_cast<const float*>(to_native_tile(format, data, xstride, ystride, zstride, scratch, 0, x, y, z));
        const std::size_t channels = std::size_t(m_spec.nchannels);
        const std::size_t columns = std::size_t(std::min(m_spec.tile_width, m_spec.width - x0)) * channels;
        const std::size_t tile_row = std::size_t(m_spec.tile_width) * channels;
        for (int row = 0; row < std::min(m_spec.tile_height, m_spec.height - y0); ++row)
            rows().put_part(std::size_t(y0 + row), std::size_t(x0) * channels, columns,
                            native + std::size_t(row) * tile_row);
        return {};
    });
}

} // namespace srisp::plugin
