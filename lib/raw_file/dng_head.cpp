// SPDX-License-Identifier: Apache-2.0
#include "raw_file/dng_head.h"

#include "base/file_bytes.h"
#include "raw_file/tiff_numbers.h"
#include "raw_file/tiff_tags.h"

namespace srisp {

DngHead dng_head(const std::string& path)
{
    constexpr std::size_t kLook = std::size_t(64) << 10; // DNGs begin with their first folder
    const auto head = read_head(path, kLook);
    if (!head)
        return DngHead::no;
    const TiffTags tags(reinterpret_cast<const unsigned char*>(head->data()), head->size());
    if (tags.folders().empty())
        return DngHead::no;
    const TiffFolder& first = tags.folders()[0];
    if (first.tags.empty())
        return DngHead::unknown;
    return first.find(tiff_tag::kDngVersion) ? DngHead::yes : DngHead::no;
}

} // namespace srisp
