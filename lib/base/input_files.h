// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <utility>

#include <srisp/expected.h>

namespace srisp {

/// The files that a program reads, so that it writes onto none of them: known by device and inode, whatever their
/// spelling, through links of both kinds.
class InputFiles {
public:
    /// `what`: "reference". What is not there or no regular file is no file that can be lost.
    void add(const std::string& what, const std::string& path);
    /// Error: "output 'b.dng' is the reference 'a.dng' itself; inputs are never overwritten".
    Status check_output(const std::string& path) const;

private:
    std::map<std::pair<unsigned long long, unsigned long long>, std::string> m_files;
};

} // namespace srisp
