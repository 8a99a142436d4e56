// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace srisp {

/// How many of a file's first bytes `reader_name` wants to see.
constexpr std::size_t kReaderHeadBytes = 132;

/// OpenImageIO's reader of RAW files, which is LibRaw's.
constexpr char kRawReader[] = "raw", kTiffReader[] = "tiff";

/// Which of OpenImageIO's readers a file is for: what its first bytes say, or the ending of its name for the few
/// formats that begin with nothing particular. A reader that gets another format's file may abort or hang. Empty: none.
std::string reader_name(const std::string& head, const std::string& path);

/// The reader that OpenImageIO's own list gives to the ending of a name; empty: none.
std::string reader_of_ending(const std::string& path);

} // namespace srisp
