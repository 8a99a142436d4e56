// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/expected.h>

namespace srisp {

/// OutputFile for libraries that write files by their name: they get a hidden one (unfinished.h) of the same kind,
/// whose file is there already. Errors, without the file's name.
class NamedOutput {
public:
    explicit NamedOutput(std::string path);
    ~NamedOutput();
    NamedOutput(const NamedOutput&) = delete;
    NamedOutput& operator=(const NamedOutput&) = delete;

    /// Whether there is such a file.
    const Status& created() const { return m_created; }
    /// What to write to.
    const std::string& name() const { return m_name; }
    /// Call once, when it is written: the file takes its place, or is copied to the device that has the name.
    Status finish();

private:
    std::string m_path, m_name; ///< "": nothing to be removed
    bool m_device;
    int m_descriptor = -1; ///< locked
    Status m_created;
};

} // namespace srisp
