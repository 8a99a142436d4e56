// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "open_name.h"

namespace srisp::plugin {

/// The reader: OpenImageIO's calls turned into those of ResultImage, under ImageInput's own lock.
///
/// The parameters belong to the metadata, and OpenImageIO 2.4's ImageCache (oiiotool, maketx, ImageBuf) takes that from
/// what open and seek_subimage leave, never from spec(): so these select the parameters, which decodes photo and
/// reference once per process; pixels are computed when they are read. Where parameters are given, held or known
/// already, only headers are read; `lazy=1` in a query or hint asks for that always: for looking at sizes, since the
/// metadata may lack parameters then. A recipe that only reads its source is passed on to ImageFile.
class SrispInput final : public OIIO::ImageInput {
public:
    ~SrispInput() override { close(); }

    const char* format_name() const override { return "srisp"; }
    int supports(OIIO::string_view feature) const override;
    bool valid_file(const std::string& name) const override;
    bool open(const std::string& name, OIIO::ImageSpec& spec) override { return open(name, spec, OIIO::ImageSpec()); }
    bool open(const std::string& name, OIIO::ImageSpec& spec, const OIIO::ImageSpec& config) override;
    bool close() override;

    int current_subimage() const override;
    int current_miplevel() const override;
    bool seek_subimage(int subimage, int miplevel) override;

    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override;
    bool read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data) override;
    bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override;
    bool read_native_deep_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, int chbegin, int chend,
                                    OIIO::DeepData& deepdata) override;
    bool read_native_deep_tiles(int subimage, int miplevel, int xbegin, int xend, int ybegin, int yend, int zbegin,
                                int zend, int chbegin, int chend, OIIO::DeepData& deepdata) override;

private:
    bool fail(const std::string& message) const;

    Status seek(int subimage, int miplevel, bool& found);
    template<class Read> bool read_file(const Read& read) const;

    OpenedName m_opened;
    int m_subimage = -1, m_miplevel = -1;
};

} // namespace srisp::plugin
