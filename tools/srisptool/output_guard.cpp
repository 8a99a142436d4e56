// SPDX-License-Identifier: Apache-2.0

// Loaded into the stock oiiotool by srisptool (LD_PRELOAD). oiiotool 2.4 writes to `name.XXXXXXXX.temp.ext` and
// renames, but most of its writers do not notice a full disk (measured: EXR, TIFF, PNG, JPEG 2000, Targa, BMP, SGI end
// with exit code 0), so that a broken file replaces a good one; JPEG and signals leave the temporary file behind. Here:
// * once any write to a file has failed for want of space, renaming an unfinished output fails with that error.
// oiiotool then
//   removes the file, says so, and exits with 1;
// * an output that is a device or a pipe is written to, where oiiotool would put a file in its place;
// * a PNG file gets its orientation where readers look for it (png_orientation.h);
// * every unfinished output is listed for srisptool, which removes those that are left when oiiotool has ended.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/statvfs.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "base/device_output.h"
#include "base/png_orientation.h"

#include "../common/unfinished_output.h"
#include "output_guard.h"

#define GUARDED extern "C" __attribute__((visibility("default")))

using srisp::tool::is_unfinished_output;

namespace {

std::atomic<int> write_error{ 0 }; ///< errno of the first write that failed for want of space

/// The function that would be called without this library.
template<class Function> Function* original(const char* name)
{
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

/// Says which output it was, for srisptool to tell (messages.h): oiiotool's own words lack the reason, or the name.
void report_failure(int file)
{
    const char* const stream = std::getenv(srisp::tool::kGuardStreamVariable);
    char path[PATH_MAX];
    const ssize_t length = readlink(("/proc/self/fd/" + std::to_string(file)).c_str(), path, sizeof path);
    if (!stream || length <= 0 || !is_unfinished_output({ path, std::size_t(length) }))
        return;
    std::string line = srisp::tool::kGuardFailure + std::string(std::strerror(write_error)) + ": ";
    line.append(path, std::size_t(length));
    std::replace(line.begin(), line.end(), '\n', '?');
    line += '\n';
    static const auto write_file = original<ssize_t(int, const void*, size_t)>("write");
    if (write_file(std::atoi(stream), line.data(), line.size()) < 0)
        return; // nobody is there to be told
}

/// `lost`: nobody tries again what a signal interrupted.
void note_failure(int file, bool lost = false)
{
    const int saved = errno;
    const bool no_space = saved == ENOSPC || saved == EDQUOT || saved == EFBIG || saved == EIO || saved == EROFS ||
                          (lost && saved == EINTR);
    int none = 0;
    if (no_space && file > STDERR_FILENO && write_error.compare_exchange_strong(none, saved))
        report_failure(file);
    errno = saved;
}

/// The errno of a write that failed where that is gone.
int likely_reason(int file)
{
    struct statvfs disk;
    rlimit limit;
    if (fstatvfs(file, &disk) == 0 && disk.f_bavail == 0)
        return ENOSPC;
    return getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY ? EFBIG : EIO;
}

void list_output(const char* path)
{
    const char* const list = std::getenv(srisp::tool::kGuardListVariable);
    if (!list || !path || !is_unfinished_output(path))
        return;
    const int saved = errno;
    std::string line;
    char folder[PATH_MAX];
    if (path[0] != '/' && getcwd(folder, sizeof folder))
        line = std::string(folder) + "/";
    line += path;
    static const auto open_file = original<int(const char*, int, ...)>("open");
    static const auto write_file = original<ssize_t(int, const void*, size_t)>("write");
    const int file = open_file(list, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0600);
    if (file >= 0) {
        if (write_file(file, line.c_str(), line.size() + 1) < 0)
            note_failure(file);
        close(file);
    }
    errno = saved;
}

mode_t mode_argument(int flags, std::va_list arguments)
{
    return flags & (O_CREAT | O_TMPFILE) ? va_arg(arguments, mode_t) : 0;
}

} // namespace

#define GUARD_OPEN(name)                                                                                               \
    GUARDED int name(const char* path, int flags, ...)                                                                 \
    {                                                                                                                  \
        static const auto next = original<int(const char*, int, ...)>(#name);                                          \
        std::va_list arguments;                                                                                        \
        va_start(arguments, flags);                                                                                    \
        const mode_t mode = mode_argument(flags, arguments);                                                           \
        va_end(arguments);                                                                                             \
        if (flags & O_CREAT)                                                                                           \
            list_output(path);                                                                                         \
        return next(path, flags, mode);                                                                                \
    }
GUARD_OPEN(open)
GUARD_OPEN(open64)

#define GUARD_FOPEN(name)                                                                                              \
    GUARDED FILE* name(const char* path, const char* mode)                                                             \
    {                                                                                                                  \
        static const auto next = original<FILE*(const char*, const char*)>(#name);                                     \
        if (mode[0] != 'r')                                                                                            \
            list_output(path);                                                                                         \
        return next(path, mode);                                                                                       \
    }
GUARD_FOPEN(fopen)
GUARD_FOPEN(fopen64)

/// Our own writer of DNG files gives them a name when they are complete.
GUARDED int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags)
{
    static const auto next = original<int(int, const char*, int, const char*, int)>("linkat");
    list_output(to);
    return next(from_folder, from, to_folder, to, flags);
}

GUARDED ssize_t write(int file, const void* data, size_t size)
{
    static const auto next = original<ssize_t(int, const void*, size_t)>("write");
    const ssize_t written = next(file, data, size);
    if (written < 0)
        note_failure(file);
    return written;
}

GUARDED ssize_t writev(int file, const iovec* parts, int count)
{
    static const auto next = original<ssize_t(int, const iovec*, int)>("writev");
    const ssize_t written = next(file, parts, count);
    if (written < 0)
        note_failure(file);
    return written;
}

#define GUARD_PWRITE(name)                                                                                             \
    GUARDED ssize_t name(int file, const void* data, size_t size, off_t offset)                                        \
    {                                                                                                                  \
        static const auto next = original<ssize_t(int, const void*, size_t, off_t)>(#name);                            \
        const ssize_t written = next(file, data, size, offset);                                                        \
        if (written < 0)                                                                                               \
            note_failure(file);                                                                                        \
        return written;                                                                                                \
    }
GUARD_PWRITE(pwrite)
GUARD_PWRITE(pwrite64)

// The C library's own streams write without calling the functions above, so their errors are seen here: fwrite returns
// what it could write, fprintf and fputc leave the stream's error mark, and fclose writes the rest.

GUARDED size_t fwrite(const void* data, size_t size, size_t count, FILE* stream)
{
    static const auto next = original<size_t(const void*, size_t, size_t, FILE*)>("fwrite");
    const size_t written = next(data, size, count, stream);
    if (written < count)
        note_failure(fileno(stream), true);
    return written;
}

GUARDED int fflush(FILE* stream)
{
    static const auto next = original<int(FILE*)>("fflush");
    const int result = next(stream);
    if (result != 0 && stream)
        note_failure(fileno(stream), true);
    return result;
}

GUARDED int fclose(FILE* stream)
{
    static const auto next = original<int(FILE*)>("fclose");
    const int file = fileno(stream);
    if (ferror(stream) && (fcntl(file, F_GETFL) & O_ACCMODE) != O_RDONLY) {
        errno = likely_reason(file);
        note_failure(file);
    }
    const int result = next(stream);
    if (result != 0)
        note_failure(file);
    return result;
}

/// What `rename` is for an output that is a device or pipe: that is written to, not replaced.
static int write_to_device(const char* from, const char* to)
{
    const int source = open(from, O_RDONLY | O_CLOEXEC), target = srisp::open_device_output(to);
    char bytes[1 << 16];
    ssize_t count = source < 0 || target < 0 ? -1 : 1;
    while (count > 0 && (count = read(source, bytes, sizeof bytes)) > 0)
        for (ssize_t done = 0, written = 0; done < count; done += written)
            if ((written = write(target, bytes + done, std::size_t(count - done))) < 0) {
                count = -1;
                break;
            }
    const int failed = count < 0 ? errno : 0;
    close(source);
    close(target);
    if (failed == 0)
        unlink(from);
    errno = failed;
    return failed == 0 ? 0 : -1;
}

GUARDED int rename(const char* from, const char* to)
{
    static const auto next = original<int(const char*, const char*)>("rename");
    if (!is_unfinished_output(from))
        return next(from, to);
    if (const int failed = write_error; failed != 0) {
        errno = failed;
        return -1;
    }
    srisp::place_png_orientation(from);
    return srisp::is_device_output(to) ? write_to_device(from, to) : next(from, to);
}
