// SPDX-License-Identifier: Apache-2.0
#include "base/named_output.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>
#include <vector>

#include <unistd.h>

#include "base/device_output.h"
#include "base/output_file.h"
#include "base/unfinished.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

Status copy_to(const std::string& device, int descriptor)
{
    OutputFile output(device);
    std::vector<char> part(1 << 20);
    ssize_t count = 0;
    for (off_t at = 0; output.good() && (count = ::pread(descriptor, part.data(), part.size(), at)) > 0; at += count)
        output.write(part.data(), std::size_t(count));
    return count < 0 ? Status(Error{ std::strerror(errno) }) : output.finish();
}

} // namespace

NamedOutput::NamedOutput(std::string path) : m_path(std::move(path)), m_device(is_device_output(m_path))
{
    // Beside a device there is no place for files.
    std::error_code error;
    const fs::path target = m_device ? fs::temp_directory_path(error) / fs::path(m_path).filename() : fs::path(m_path);
    if (error) {
        m_created = Error{ "TMPDIR: " + error.message() };
        return;
    }
    remove_leftover_files(target);
    // What a device or pipe gets is none of other users' business.
    const Expected<Unfinished> made = m_device ? make_private_unfinished_file(target) : make_unfinished_file(target);
    if (!made) {
        m_created = made.error();
        return;
    }
    m_name = made->path;
    m_descriptor = made->descriptor;
}

NamedOutput::~NamedOutput()
{
    if (!m_name.empty())
        std::remove(m_name.c_str());
    if (m_descriptor >= 0)
        ::close(m_descriptor);
}

Status NamedOutput::finish()
{
    if (m_device)
        return copy_to(m_path, m_descriptor);
    if (std::rename(m_name.c_str(), m_path.c_str()) != 0)
        return Error{ std::strerror(errno) };
    m_name.clear();
    return {};
}

} // namespace srisp
