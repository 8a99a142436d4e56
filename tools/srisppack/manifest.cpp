// SPDX-License-Identifier: Apache-2.0
#include "manifest.h"

#include <algorithm>
#include <filesystem>

#include "base/hashes.h"
#include "base/near_names.h"
#include "base/shown_text.h"

#include "../common/csv_table.h"
#include "../common/failure.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kName[] = "manifest.csv";
constexpr std::uint64_t kValidationShare = 10; // one in so many

/// The column of that name; -1: there is none.
int find_column(const CsvTable& table, const std::string& name)
{
    const auto found = std::find(table.columns.begin(), table.columns.end(), name);
    return found == table.columns.end() ? -1 : int(found - table.columns.begin());
}

/// The field of one of two words: whether it is the first.
bool either(const std::vector<std::string>& row, int column, const char* first, const char* second,
            const std::string& where)
{
    if (column < 0 || row[column] == second)
        return false;
    if (row[column] != first)
        fail(where + ": '" + shown_text(row[column]) + "' is neither " + first + " nor " + second);
    return true;
}

} // namespace

Manifest Manifest::of_folder(const std::string& folder)
{
    Manifest manifest;
    const std::string path = (fs::path(folder) / kName).string();
    std::error_code ignored;
    if (!fs::exists(path, ignored))
        return manifest;
    const CsvTable table = read_csv(path);
    const int file = find_column(table, "file"), use = find_column(table, "use"), open = find_column(table, "open"),
              source = find_column(table, "source"), licence = find_column(table, "licence");
    if (file < 0)
        fail("'" + path + "' has no column 'file'" + near_names("file", table.columns));
    for (const std::vector<std::string>& row : table.rows) {
        const std::string where = "'" + path + "', file '" + shown_text(row[file]) + "'";
        Provenance provenance;
        provenance.listed = true;
        provenance.validation = either(row, use, "validation", "training", where);
        provenance.open = either(row, open, "yes", "no", where);
        if (source >= 0 && !row[source].empty())
            provenance.source = row[source];
        if (licence >= 0 && !row[licence].empty())
            provenance.licence = row[licence];
        if (!manifest.m_files.emplace(row[file], provenance).second)
            fail(where + " is listed twice");
    }
    manifest.m_present = true;
    return manifest;
}

Provenance Manifest::of(const std::string& name) const
{
    const auto found = m_files.find(name);
    if (found != m_files.end())
        return found->second;
    Provenance provenance;
    provenance.validation = seeded_hash(0, fs::path(name).filename().string()) % kValidationShare == 0;
    return provenance;
}

} // namespace srisp::tool
