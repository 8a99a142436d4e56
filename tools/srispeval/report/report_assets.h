// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

// Files that the report is made of, in the program (embed.cmake).

namespace srisp::tool {

/// A file's text and its SHA-256, as 64 hexadecimal digits.
struct Asset {
    std::string_view text, sha256;
};

Asset report_css();
Asset report_sort_js();
Asset report_pictures_js();
Asset report_viewer_js();
Asset report_viewer_html();

} // namespace srisp::tool
