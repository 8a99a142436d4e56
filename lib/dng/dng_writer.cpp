// SPDX-License-Identifier: Apache-2.0
#include "dng/dng_writer.h"

#include <algorithm>
#include <limits>

#include "base/guarded.h"
#include "base/output_file.h"
#include "dng/camera_tags.h"
#include "dng/dng_check.h"
#include "dng/dng_tags.h"
#include "dng/image_blocks.h"
#include "dng/tiff_folder.h"
#include "raw_file/tiff_numbers.h"

namespace srisp {

namespace {

using namespace tiff_tag;

/// Which programs do not read it, or not rightly.
void note_readers(const DngImage& image, std::vector<std::string>& notes)
{
    if (std::min(image.width, image.height) < kSmallestLibrawSide)
        notes.push_back("LibRaw and dcraw do not read RAW images under " + std::to_string(kSmallestLibrawSide) +
                        " pixels a side");
    if (image.floats)
        notes.push_back("dcraw, LibRaw 0.20 and RawTherapee 5.9 do not read three channels of floats");
    if (image.planes == 3 && std::any_of(image.black.begin(), image.black.end(), [](float v) { return v > 0; }))
        notes.push_back(
            "darktable 4.2 and RawTherapee 5.9 show three channels in wrong colours where black is above 0");
}

/// The file: its folders, then the preview, then the RAW image. All sizes are known before the first byte is written,
/// so that a pipe can take it.
class DngFile {
public:
    DngFile(const DngImage& image, const DngOptions& options)
        : m_image(image), m_preview(image.preview && options.layout == DngLayout::standard), m_blocks(image, options),
          m_exif(exif_folder(image.facts))
    {
        set_file_tags(image, m_first, m_notes);
        set_camera_tags(image.facts, m_first, m_notes);
        m_first.set_longs(kExifFolder, { 0 });
        if (m_preview) {
            m_first.set_longs(kSubFolders, { 0 });
            set_preview_tags(image, 0, m_first);
        }
        set_raw_tags(image, options, m_blocks, raw_folder());
        note_readers(image, m_notes);
    }

    const std::vector<std::string>& notes() const { return m_notes; }

    Status write(ByteSink& file)
    {
        const std::uint64_t exif_at = kFirstAt + m_first.size(), sub_at = exif_at + m_exif.size();
        const std::uint64_t preview_at = sub_at + (m_preview ? m_sub.size() : 0);
        const std::uint64_t preview_size = m_preview ? ImageBlocks::padded(std::uint32_t(preview_bytes(m_image))) : 0;
        const std::uint64_t raw_at = preview_at + preview_size;
        if (Status status = check_end(raw_at); !status)
            return status;

        m_first.set_longs(kExifFolder, { std::uint32_t(exif_at) });
        if (m_preview) {
            m_first.set_longs(kSubFolders, { std::uint32_t(sub_at) });
            set_preview_tags(m_image, std::uint32_t(preview_at), m_first);
        }
        set_raw_offsets(m_blocks, std::uint32_t(raw_at), raw_folder());
        file.write(tiff_header());
        file.write(m_first.bytes(kFirstAt));
        file.write(m_exif.bytes(std::uint32_t(exif_at)));
        if (m_preview) {
            file.write(m_sub.bytes(std::uint32_t(sub_at)));
            file.write(m_image.preview, preview_bytes(m_image));
            file.write("\0", std::size_t(preview_size) - preview_bytes(m_image));
        }
        m_blocks.write(file);
        return {};
    }

private:
    static constexpr std::uint32_t kFirstAt = 8; // after the header

    TiffFolderBytes& raw_folder() { return m_preview ? m_sub : m_first; }

    Status check_end(std::uint64_t raw_at) const
    {
        std::uint64_t end = raw_at;
        for (const std::uint32_t size : m_blocks.sizes())
            end += ImageBlocks::padded(size);
        constexpr std::uint64_t kMostBytes = std::numeric_limits<std::uint32_t>::max();
        if (end > kMostBytes)
            return Error{ "file of " + std::to_string(end) + " bytes: " + std::to_string(kMostBytes) +
                          " are the limit" };
        return {};
    }

    const DngImage& m_image;
    const bool m_preview;
    const ImageBlocks m_blocks;
    TiffFolderBytes m_first, m_sub;
    const TiffFolderBytes m_exif;
    std::vector<std::string> m_notes;
};

} // namespace

Expected<std::vector<std::string>> write_dng(ByteSink& sink, const DngImage& image, const DngOptions& options)
{
    if (Status status = check_dng_image(image, options); !status)
        return status.error();
    if (Status status = check_dng_samples(image, options); !status)
        return status.error();
    DngFile dng(image, options);
    if (Status status = dng.write(sink); !status)
        return status.error();
    return dng.notes();
}

Expected<std::vector<std::string>> write_dng(const std::string& path, const DngImage& image, const DngOptions& options)
{
    using Notes = Expected<std::vector<std::string>>;
    return guarded("DNG", path, [&]() -> Notes {
        OutputFile file(path);
        Notes notes = write_dng(file, image, options);
        if (!notes)
            return Error{ "DNG '" + path + "': " + notes.error().message };
        const Status finished = file.finish();
        return finished ? notes : Notes(finished.error());
    });
}

} // namespace srisp
