// SPDX-License-Identifier: Apache-2.0
#include "base/input_files.h"

#include <optional>

#include <sys/stat.h>

namespace srisp {

static std::optional<std::pair<unsigned long long, unsigned long long>> identity_of(const std::string& path)
{
    struct stat info;
    if (::stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode))
        return {};
    return std::pair<unsigned long long, unsigned long long>(info.st_dev, info.st_ino);
}

void InputFiles::add(const std::string& what, const std::string& path)
{
    if (const auto identity = identity_of(path))
        m_files.emplace(*identity, what + " '" + path + "'");
}

Status InputFiles::check_output(const std::string& path) const
{
    const auto identity = identity_of(path);
    const auto found = identity ? m_files.find(*identity) : m_files.end();
    if (found == m_files.end())
        return {};
    return Error{ "output '" + path + "' is the " + found->second + " itself; inputs are never overwritten" };
}

} // namespace srisp
