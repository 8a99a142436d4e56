// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace srisp {

/// What the first segment APPn of a JPEG that starts with `signature` holds after it. Segments up to the first scan are
/// searched; whatever is damaged ends the search.
std::optional<std::string_view> find_app_segment(std::string_view jpeg, int n, std::string_view signature);

/// What a JPEG says of its frame, and how many scans follow.
struct JpegFrame {
    int width = 0, height = 0, channels = 0;
    bool arithmetic = false;  ///< coded so, not by Huffman's codes
    bool progressive = false; ///< each scan adds to what the ones before it said
    std::size_t scans = 0;
};
/// None: no frame is found. As decoders do, passes over bytes between segments that belong to none.
std::optional<JpegFrame> find_jpeg_frame(std::string_view jpeg);

/// The packet of XMP that a JPEG holds; what overflows into extended XMP is not in it.
std::optional<std::string_view> find_xmp_packet(std::string_view jpeg);

/// The bytes from the start of a JPEG image through its end-of-image marker; none: it has no end.
std::optional<std::size_t> jpeg_image_size(std::string_view jpeg);

/// The images that a file holds beside its first one, by its multi-picture index (CIPA DC-007), at most 16. Entries
/// that point outside the file, or to what does not start as a JPEG does, are left out.
std::vector<std::string_view> find_further_images(std::string_view file);

} // namespace srisp
