// SPDX-License-Identifier: Apache-2.0
#include "base/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/parallel.h"

namespace srisp {

namespace {

constexpr std::size_t kLargestFile = std::size_t(2) << 30;
constexpr std::size_t kPart = std::size_t(2) << 20;

/// An open regular file; closes itself.
class OpenFile {
public:
    static Expected<OpenFile> open(const std::string& path)
    {
        // O_NONBLOCK: a FIFO without a writer must not hang us; it is refused below.
        OpenFile file(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
        struct stat status;
        if (file.m_descriptor < 0 || ::fstat(file.m_descriptor, &status) != 0)
            return Error{ std::strerror(errno) };
        if (S_ISDIR(status.st_mode))
            return Error{ "is a folder; a file is expected here" };
        if (!S_ISREG(status.st_mode))
            return Error{ "is not a regular file" };
        if (status.st_size == 0)
            return Error{ "is empty" };
        file.m_size = std::size_t(status.st_size);
        return file;
    }

    explicit OpenFile(int descriptor) : m_descriptor(descriptor) {}
    OpenFile(OpenFile&& other) noexcept : m_descriptor(other.m_descriptor), m_size(other.m_size)
    {
        other.m_descriptor = -1;
    }
    ~OpenFile()
    {
        if (m_descriptor >= 0)
            ::close(m_descriptor);
    }

    std::size_t size() const { return m_size; }

    /// Reads from `offset` until `size` bytes or the end; the number read, or -1. Threads: safe.
    long long read(void* target, std::size_t offset, std::size_t size) const
    {
        std::size_t done = 0;
        while (done < size) {
            const ssize_t n =
                ::pread(m_descriptor, static_cast<char*>(target) + done, size - done, off_t(offset + done));
            if (n < 0 && errno == EINTR)
                continue;
            if (n < 0)
                return -1;
            if (n == 0)
                break;
            done += std::size_t(n);
        }
        return static_cast<long long>(done);
    }

private:
    int m_descriptor;
    std::size_t m_size = 0;
};

} // namespace

Expected<std::string> read_head(const std::string& path, std::size_t limit)
{
    auto file = OpenFile::open(path);
    if (!file)
        return file.error();
    std::string head(std::min(limit, file->size()), '\0');
    const long long got = file->read(head.data(), 0, head.size());
    if (got < 0)
        return Error{ std::strerror(errno) };
    head.resize(std::size_t(got));
    return head;
}

Expected<FileBytes> read_whole_file(const std::string& path)
{
    auto file = OpenFile::open(path);
    if (!file)
        return file.error();
    if (file->size() > kLargestFile)
        return Error{ "has " + std::to_string(file->size()) + " bytes, the limit is " + std::to_string(kLargestFile) };
    const std::shared_ptr<unsigned char[]> data(new unsigned char[file->size()]);
    // By all threads, since the kernel copies, and hands out memory, about as slowly as RAW files are unpacked.
    const std::size_t parts = (file->size() + kPart - 1) / kPart;
    std::atomic<std::size_t> size{ file->size() };
    std::atomic<int> failed{ 0 };
    parallel_tasks(std::int64_t(parts), 0, [&](std::int64_t part) {
        const std::size_t begin = std::size_t(part) * kPart, wanted = std::min(kPart, file->size() - begin);
        const long long got = file->read(data.get() + begin, begin, wanted);
        if (got < 0)
            failed = errno;
        else if (std::size_t(got) < wanted) // shrunk since it was opened
            for (std::size_t end = begin + std::size_t(got), now = size; end < now;)
                size.compare_exchange_weak(now, end);
    });
    if (failed)
        return Error{ std::strerror(failed) };
    return FileBytes{ std::move(data), size };
}

} // namespace srisp
