// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>

namespace srisp::tool {

/// What is known of a file beside its pixels.
struct Provenance {
    bool listed = false; ///< in a manifest
    bool open = false, validation = false;
    std::string source = "not stated", licence = "not stated";
};

/// `manifest.csv` of a folder: column `file` (path within the folder), and any of `use` (training, validation), `open`
/// (yes, no), `source`, `licence`; other columns are ignored. Without one, every tenth file by the hash of its name is
/// for validation, none is open, and nothing is stated.
class Manifest {
public:
    /// Fails with file and line: no column `file`, a file twice, other values of use and open.
    static Manifest of_folder(const std::string& folder);

    bool present() const { return m_present; }
    /// By path within the folder.
    const std::map<std::string, Provenance>& files() const { return m_files; }
    /// Of a file of the folder; `name`: its path in there.
    Provenance of(const std::string& name) const;

private:
    bool m_present = false;
    std::map<std::string, Provenance> m_files;
};

} // namespace srisp::tool
