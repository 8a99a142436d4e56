// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// A folder that appears under its name only when it is complete: its files are written in a hidden folder beside it
/// (unfinished.h), which is renamed at the end. What is not published is removed; what a killed program left, by the
/// next one for the same name. Errors, as "'path' …".
class StagedFolder {
public:
    /// Whether a folder that is there is of the kind that is made here, with nothing else in it; the error says what is
    /// wrong: "holds no pack.json".
    using Check = std::function<Status(const std::string& folder)>;

    /// `replace`: a folder that passes the check may be there already. Errors: something else is there; the disk's own.
    static Expected<std::unique_ptr<StagedFolder>> create(const std::string& target, const Check& check, bool replace);
    ~StagedFolder();
    StagedFolder(const StagedFolder&) = delete;
    StagedFolder& operator=(const StagedFolder&) = delete;

    /// Where to write the files.
    const std::string& path() const { return m_path; }
    /// Gives the folder its name; what was there before goes. Call once, at the end.
    Status publish();

private:
    StagedFolder(std::string target, Check check, bool replace, std::string path, int lock);

    std::string m_target, m_path;
    Check m_check;
    bool m_replace;
    int m_lock; ///< open on the folder: says that this program lives
};

} // namespace srisp
