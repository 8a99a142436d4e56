// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp::tool {

/// A table of texts with a header line, fields separated by commas, quoted where they hold commas (RFC 4180).
struct CsvTable {
    std::vector<std::string> columns;
    std::vector<std::vector<std::string>> rows; ///< each as long as `columns`
};

/// Reads a file. Fails with its name and line: missing, empty, a row of another length, a quote that is not closed, a
/// column twice.
CsvTable read_csv(const std::string& path);

} // namespace srisp::tool
