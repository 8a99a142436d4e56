// SPDX-License-Identifier: Apache-2.0
#include "base/output_file.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "base/device_output.h"
#include "base/unfinished.h"

namespace srisp {

namespace fs = std::filesystem;

namespace {

/// By which a file without a name is found.
std::string link_to(int descriptor)
{
    return "/proc/self/fd/" + std::to_string(descriptor);
}

/// -1: the file system has no files without a name, or they could get none later.
int open_nameless(const std::string& path)
{
    const fs::path folder = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
    const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    if (descriptor >= 0 && ::access(link_to(descriptor).c_str(), F_OK) == 0)
        return descriptor;
    if (descriptor >= 0)
        ::close(descriptor);
    return -1;
}

bool link_as(int descriptor, const std::string& path)
{
    return ::linkat(AT_FDCWD, link_to(descriptor).c_str(), AT_FDCWD, path.c_str(), AT_SYMLINK_FOLLOW) == 0;
}

} // namespace

OutputFile::OutputFile(std::string path) : m_path(std::move(path)), m_device(is_device_output(m_path))
{
    const int descriptor = open();
    if (descriptor < 0)
        return;
    m_file = ::fdopen(descriptor, "wb");
    if (m_file)
        return;
    fail("cannot be created");
    ::close(descriptor);
}

int OutputFile::open()
{
    if (!m_device)
        remove_leftover_files(m_path);
    const int descriptor = m_device ? open_device_output(m_path) : open_nameless(m_path);
    if (descriptor >= 0)
        return descriptor;
    if (m_device) {
        fail("cannot be opened");
        return -1;
    }
    const Expected<Unfinished> made = make_unfinished_file(m_path);
    if (!made) {
        m_error = "'" + m_path + "' cannot be created: " + made.error().message;
        return -1;
    }
    m_unfinished = made->path;
    return made->descriptor;
}

OutputFile::~OutputFile()
{
    if (!m_unfinished.empty())
        std::remove(m_unfinished.c_str());
    if (m_file)
        std::fclose(m_file);
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

/// Gives the file its name.
bool OutputFile::place()
{
    const int descriptor = ::fileno(m_file);
    if (m_unfinished.empty()) {
        if (link_as(descriptor, m_path))
            return true;
        if (errno != EEXIST)
            return false;
        const std::string name = unfinished_name(m_path).string();
        if (!link_as(descriptor, name))
            return false;
        m_unfinished = name;
    }
    if (std::rename(m_unfinished.c_str(), m_path.c_str()) != 0)
        return false;
    m_unfinished.clear();
    return true;
}

Status OutputFile::finish()
{
    if (!m_file)
        return Error{ m_error };
    // A full disk may show only at the flush or the sync.
    if (m_error.empty() && (std::fflush(m_file) != 0 || (!m_device && ::fsync(::fileno(m_file)) != 0)))
        fail("cannot be written");
    // Closing ends the lock, so that it comes last.
    if (m_error.empty() && !m_device && !place())
        fail("cannot be renamed from its temporary name");
    // What is synced and in its place is written, whatever the close says.
    if (std::fclose(std::exchange(m_file, nullptr)) != 0 && m_device)
        fail("cannot be written");
    return m_error.empty() ? Status() : Status(Error{ m_error });
}

Status write_output_file(const std::string& path, const void* data, std::size_t bytes)
{
    OutputFile file(path);
    file.write(data, bytes);
    return file.finish();
}

Status write_output_file(const std::string& path, const std::string& bytes)
{
    return write_output_file(path, bytes.data(), bytes.size());
}

} // namespace srisp
