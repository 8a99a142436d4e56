// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>

#include "process_state.h"
#include "recipe/recipe.h"

namespace srisp::plugin {

/// The writer: keeps what a host writes in the memory of the process, for our reader or for the job's action (print or
/// save parameters). Only names that belong to a job are taken.
class SrispOutput final : public OIIO::ImageOutput {
public:
    ~SrispOutput() override { close(); }

    const char* format_name() const override { return "srisp"; }
    int supports(OIIO::string_view feature) const override;
    bool open(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode) override;
    bool open(const std::string& name, int subimages, const OIIO::ImageSpec* specs) override;
    bool close() override;

    bool write_scanline(int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride) override;
    bool write_tile(int x, int y, int z, OIIO::TypeDesc format, const void* data, OIIO::stride_t xstride,
                    OIIO::stride_t ystride, OIIO::stride_t zstride) override;

private:
    bool fail(const std::string& message);
    /// Runs a step of the writer; what is thrown in it is its failure, too.
    bool succeeds(const std::function<Status()>& step);
    Status begin(const std::string& name);
    Status begin_level(const std::string& name, const OIIO::ImageSpec& spec, OpenMode mode);
    Status finish();
    KeptRows& rows() { return m_slot->subimages.back().back().rows; }

    std::string m_path;
    Recipe m_job;
    std::shared_ptr<Slot> m_slot;
    int m_tile_row = -1; ///< the last tile's
};

} // namespace srisp::plugin
