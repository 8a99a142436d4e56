// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "../common/file_list.h"
#include "batch_options.h"

namespace srisp::tool {

/// The references of a set, and which of them a photo gets.
class ReferenceSet {
public:
    /// `text`: files, folders, globs or a list of them, as srisptool takes references; or a CSV file, whose first line
    /// says what it holds: "reference,weight", or "photo,reference" (photos by their names, relative to the folder that
    /// was given). Names in a CSV file are relative to its folder. Throws Failure: nothing is found, a CSV file that
    /// cannot be read, weights that are not above 0.
    static ReferenceSet read(const std::string& text);

    /// Whether photos have references of their own.
    bool has_pairs() const { return !m_of_photo.empty(); }

    /// One reference for each result of a photo. `place`: of the photo in the sorted list, for Pairing::round_robin.
    /// Throws Failure: a photo that the CSV file does not name.
    std::vector<std::string> of(const ListedFile& photo, std::size_t place, const BatchOptions& options) const;

private:
    void read_csv(const std::string& path);

    std::vector<std::string> m_references;
    std::vector<double> m_up_to; ///< sums of weights, up to each
    std::map<std::string, std::vector<std::string>> m_of_photo;
};

} // namespace srisp::tool
