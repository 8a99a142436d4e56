// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "gain_map/gain_map.h"

namespace srisp {

struct OwnDng;

/// An image file as it really is: pixels come from the reader that its first bytes name, and what that reader does not
/// hand over is put right here, so that the spec alone says how pixels are to be read, on whatever way they go:
/// * colour: `ICCProfile`, `CICP`, or `oiio:ColorSpace` (with `chromaticities`), only the one that holds by the rules
/// of
///   the format; integers whose colour space nothing names are "sRGB";
/// * `Orientation`, where the format or its EXIF has one;
/// * alpha: straight where the host asks for that (`oiio:UnassociatedAlpha` in `config`), associated elsewhere;
/// * a DNG that srisp wrote: linear camera RGB, demosaiced, with its whole record (other RAW files: as OpenImageIO has
///   them, by default an sRGB picture);
/// * one picture: of an animation the first frame, of a layered file the merged picture.
/// A file that breaks off is an error, unless `srisp:allow_partial` in `config` takes what is there.
class ImageFile final : public OIIO::ImageInput {
public:
    /// A regular file, or with '?' in it a name that a reader understands. Reads headers only. `where`: what the file
    /// is called in messages ("photo 'a.jpg'"), which begin so.
    static Expected<std::unique_ptr<ImageFile>> open(const std::string& path, const OIIO::ImageSpec& config,
                                                     const std::string& where);

    /// What reading has shown so far, beside what the spec says (note_list).
    const std::vector<std::string>& reading_notes() const { return m_notes; }
    /// Of a JPEG photo, where `srisp:gainmap` in `config` is "apply"; null: it has none, or none is wanted.
    const GainMap* gain_map() const { return m_gain_map ? &*m_gain_map : nullptr; }
    /// What the file is called in messages.
    const std::string& where() const { return m_where; }

    const char* format_name() const override { return m_inner->format_name(); }
    int supports(OIIO::string_view feature) const override { return m_inner->supports(feature); }
    bool open(const std::string&, OIIO::ImageSpec&) override { return false; }
    bool close() override { return m_inner->close(); }
    int current_subimage() const override { return m_subimage; }
    int current_miplevel() const override { return m_miplevel; }
    bool seek_subimage(int subimage, int miplevel) override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override;
    bool read_native_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, void* data) override;
    bool read_native_tile(int subimage, int miplevel, int x, int y, int z, void* data) override;
    bool read_native_deep_scanlines(int subimage, int miplevel, int ybegin, int yend, int z, int chbegin, int chend,
                                    OIIO::DeepData& deepdata) override;
    bool read_native_deep_tiles(int subimage, int miplevel, int xbegin, int xend, int ybegin, int yend, int zbegin,
                                int zend, int chbegin, int chend, OIIO::DeepData& deepdata) override;

private:
    ImageFile(std::unique_ptr<OIIO::ImageInput> inner, const std::string& path, const OIIO::ImageSpec& config,
              const std::string& where);
    Status check_spec(const OIIO::ImageSpec& spec) const;
    bool accept(bool read, int y, void* data, std::size_t bytes);
    void look_for_gain_map(OIIO::ImageSpec& spec);
    void put_right(void* data, int width, int height) const;

    std::unique_ptr<OIIO::Filesystem::IOProxy> m_file; ///< what `m_inner` reads; null: by name
    std::unique_ptr<OIIO::ImageInput> m_inner;
    std::string m_path, m_where;
    bool m_wants_straight, m_allows_partial, m_applies_gain_map;
    int m_subimage = -1, m_miplevel = -1;
    bool m_associates = false; ///< colour is stored straight and wanted associated
    bool m_widens = false;     ///< from 8 to 16 bits, or colours under little alpha would be lost in that
    bool m_inverts = false;    ///< white is stored as 0
    std::optional<GainMap> m_gain_map;
    std::shared_ptr<const OwnDng> m_own_dng; ///< null: it is none
    std::vector<std::string> m_notes;
};

} // namespace srisp
