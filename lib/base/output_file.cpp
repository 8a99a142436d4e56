// SPDX-License-Identifier: Apache-2.0
#include "base/output_file.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <unistd.h>

namespace srisp {

OutputFile::OutputFile(std::string path)
    : m_path(std::move(path)), m_temporary(m_path + ".tmp-" + std::to_string(::getpid())),
      m_file(std::fopen(m_temporary.c_str(), "wb"))
{
    if (!m_file)
        fail("cannot be created");
}

OutputFile::~OutputFile()
{
    if (!m_file)
        return;
    std::fclose(m_file);
    std::remove(m_temporary.c_str());
}

void OutputFile::fail(const std::string& doing)
{
    if (m_error.empty())
        m_error = "'" + m_path + "' " + doing + ": " + std::strerror(errno);
}

void OutputFile::write(const void* data, std::size_t bytes)
{
    if (m_error.empty() && bytes > 0 && std::fwrite(data, 1, bytes, m_file) != bytes)
        fail("cannot be written");
}

void OutputFile::write_start(const void* data, std::size_t bytes)
{
    if (good() && std::fseek(m_file, 0, SEEK_SET) != 0)
        fail("cannot be written");
    write(data, bytes);
    if (good() && std::fseek(m_file, 0, SEEK_END) != 0)
        fail("cannot be written");
}

Status OutputFile::finish()
{
    if (!m_file)
        return Error{ m_error };
    // A full disk may show only at the flush, the sync or the close.
    if (m_error.empty() && (std::fflush(m_file) != 0 || ::fsync(::fileno(m_file)) != 0))
        fail("cannot be written");
    if (std::fclose(std::exchange(m_file, nullptr)) != 0)
        fail("cannot be written");
    if (m_error.empty() && std::rename(m_temporary.c_str(), m_path.c_str()) != 0)
        fail("cannot be renamed from its temporary name");
    if (m_error.empty())
        return {};
    std::remove(m_temporary.c_str());
    return Error{ m_error };
}

Status write_output_file(const std::string& path, const std::string& bytes)
{
    OutputFile file(path);
    file.write(bytes);
    return file.finish();
}

} // namespace srisp
