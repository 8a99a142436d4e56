// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace srisp {

/// A tag's value where a whole number is meant, as an offset, which may be any double: 0 for what is less or NaN, at
/// most 2⁵³.
std::uint64_t whole_number(double value);

/// One tag of a TIFF folder: where its values lie.
struct TiffTag {
    std::uint16_t tag, type;
    std::uint32_t count;
    std::size_t offset; ///< of the first value, in the file; the values lie within the file
};

struct TiffFolder {
    std::uint32_t offset = 0; ///< in the file
    std::vector<TiffTag> tags;

    const TiffTag* find(std::uint16_t tag) const;
};

/// Reads the tags of a TIFF file in memory (DNG, NEF, …). Every offset is checked against the file, loops and endless
/// chains end; what does not fit is left out, so damaged files give fewer tags, never a crash.
class TiffTags {
public:
    /// `data` must outlive this object. Classic TIFF of either byte order, and what differs from it by its number alone
    /// (Olympus, Panasonic); anything else has no folders.
    TiffTags(const unsigned char* data, std::size_t size);

    /// The first folder, its SubIFDs, then the next folder of the chain and so on.
    const std::vector<TiffFolder>& folders() const { return m_folders; }
    /// The Exif folder; without tags if there is none.
    const TiffFolder& exif() const { return m_exif; }
    /// The folder whose offset is a tag's value; without tags if there is none.
    TiffFolder linked_folder(const TiffFolder& folder, std::uint16_t tag) const;
    /// What no program should follow, though this one can: folders in a loop, too many, or too deeply nested; else
    /// empty.
    const std::string& problem() const { return m_problem; }

    /// All values of a tag as numbers (at most 1 Mi); empty if the tag is missing or no number. n/0 gives 0.
    std::vector<double> values(const TiffFolder& folder, std::uint16_t tag) const;
    /// The first value, or `otherwise`.
    double value(const TiffFolder& folder, std::uint16_t tag, double otherwise) const;
    /// An ASCII tag up to its first NUL, without spaces at its end.
    std::string text(const TiffFolder& folder, std::uint16_t tag) const;
    /// The bytes of a tag of type BYTE or UNDEFINED; empty if it is missing or of another type.
    std::string bytes(const TiffFolder& folder, std::uint16_t tag) const;

private:
    std::uint64_t integer(std::size_t offset, int bytes) const;
    double number(const TiffTag& tag, std::uint32_t index) const;
    std::uint32_t read_folder(std::size_t offset, TiffFolder& folder) const;
    void read_chain(std::uint32_t offset, int depth);

    const unsigned char* m_data;
    std::size_t m_size;
    bool m_little = true;
    std::vector<TiffFolder> m_folders;
    std::vector<std::uint32_t> m_seen; ///< offsets of folders that were read
    std::vector<std::uint32_t> m_path; ///< of the chain that is being read, and of those that it hangs on
    TiffFolder m_exif;
    std::string m_problem;
};

} // namespace srisp
