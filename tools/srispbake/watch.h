// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace srisp::tool {

/// Tells when one of some files was changed, replaced, removed or came back.
class FileWatch {
public:
    explicit FileWatch(std::vector<std::string> paths);

    /// True once for each change, when the files were the same for two calls in a row: what is still being written is
    /// waited for.
    bool changed();

private:
    std::string state() const;

    std::vector<std::string> m_paths;
    std::string m_reported, m_last;
};

} // namespace srisp::tool
