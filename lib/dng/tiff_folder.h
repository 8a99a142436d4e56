// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace srisp {

/// A fraction that is the same float as `value`, of the smallest denominator that is easily found; the nearest one
/// where 32 bits, of which one is a sign's, hold none.
std::pair<std::int32_t, std::int32_t> fraction_of(float value);

/// A folder of tags for a little-endian TIFF file. Its size is known before its values are, so that offsets can be set
/// when all sizes are known. (libtiff would decide on types and order of values, add tags of its own, and write folders
/// anew; strict readers of DNG are particular about all that.)
class TiffFolderBytes {
public:
    void set_bytes(std::uint16_t tag, std::string_view values) { set(tag, 1, values.size(), std::string(values)); }
    void set_undefined(std::uint16_t tag, std::string_view values) { set(tag, 7, values.size(), std::string(values)); }
    /// Up to the first NUL.
    void set_text(std::uint16_t tag, const std::string& text);
    void set_shorts(std::uint16_t tag, const std::vector<std::uint32_t>& values) { set_integers(tag, 3, 2, values); }
    void set_longs(std::uint16_t tag, const std::vector<std::uint32_t>& values) { set_integers(tag, 4, 4, values); }
    /// Not negative.
    void set_rationals(std::uint16_t tag, const std::vector<float>& values) { set_fractions(tag, 5, values); }
    void set_signed_rationals(std::uint16_t tag, const std::vector<float>& values) { set_fractions(tag, 10, values); }
    void set_doubles(std::uint16_t tag, const std::vector<double>& values);

    /// Bytes in the file; even.
    std::size_t size() const;
    /// As they lie at `offset` in the file, sorted by tag; no folder follows.
    std::string bytes(std::uint32_t offset) const;

private:
    struct Entry {
        std::uint16_t type;
        std::uint32_t count;
        std::string values;
    };
    void set(std::uint16_t tag, std::uint16_t type, std::size_t count, std::string values);
    void set_integers(std::uint16_t tag, std::uint16_t type, int bytes, const std::vector<std::uint32_t>& values);
    void set_fractions(std::uint16_t tag, std::uint16_t type, const std::vector<float>& values);

    std::map<std::uint16_t, Entry> m_entries;
};

/// The start of such a file; its first folder comes next.
std::string tiff_header();

} // namespace srisp
