// SPDX-License-Identifier: Apache-2.0
#include "base/file_bytes.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstring>

#include "base/parallel.h"
#include "base/regular_file.h"

namespace srisp {

namespace {

constexpr std::size_t kLargestFile = std::size_t(2) << 30;
constexpr std::size_t kPart = std::size_t(2) << 20;

Expected<RegularFile> open_with_content(const std::string& path)
{
    auto file = RegularFile::open(path);
    if (!file && file.error().message == kIsFolder)
        return Error{ "is a folder; a file is expected here" };
    return file && file->size() == 0 ? Expected<RegularFile>(Error{ "is empty" }) : std::move(file);
}

} // namespace

Expected<std::string> read_head(const std::string& path, std::size_t limit)
{
    auto file = open_with_content(path);
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
    auto file = open_with_content(path);
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
