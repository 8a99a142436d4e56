// SPDX-License-Identifier: Apache-2.0
// The tags of a TIFF file, and what is decided by them before a decoder sees the file.
#include "raw_file/tiff_tags.h"

#include "container/file_type.h"
#include "container/reader_name.h"
#include "memory_file.h"
#include "raw_file/dng_head.h"
#include "raw_file/libraw_traps.h"
#include "raw_images.h"
#include "reference/tiff_raw.h"

using namespace srisp;

namespace {

void check_folder(const TiffTags& tags, const TiffFolder& folder, std::size_t size)
{
    for (const TiffTag& tag : folder.tags) {
        fuzz::must_hold(tag.offset <= size, "values lie within the file");
        fuzz::must_hold(folder.find(tag.tag) != nullptr, "a tag is found");
        const auto values = tags.values(folder, tag.tag);
        fuzz::must_hold(values.size() <= std::size_t(1) << 20, "no tag has endless values");
        tags.text(folder, tag.tag);
        fuzz::must_hold(tags.bytes(folder, tag.tag).size() <= size, "bytes lie within the file");
        tags.linked_folder(folder, tag.tag);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile on_disk;
    const FileBytes file = fuzz::file_of(data, size);
    const TiffTags tags(file.data.get(), size);
    std::size_t count = 0;
    for (const TiffFolder& folder : tags.folders())
        if ((count += folder.tags.size()) < 1000)
            check_folder(tags, folder, size);
    check_folder(tags, tags.exif(), size);
    fuzz::is_accepted(check_libraw_traps(file));
    fuzz::is_accepted(check_tiff_raw(file));
    const std::string name = tiff_raw_name(file);
    fuzz::must_hold(valid_utf8(name) == name, "a name in a message is UTF-8");
    const std::string head = fuzz::text_of(data, std::min(size, kReaderHeadBytes));
    file_type(head, size);
    reader_name(head, "a.dng");
    dng_head(on_disk.holding(data, size));
    return 0;
}
