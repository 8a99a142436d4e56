// SPDX-License-Identifier: Apache-2.0
// Preloaded, it makes of the machine what $FAULTS_MEMORY and $FAULTS_CLOCK say.
//   FAULTS_MEMORY  "least at": of all requests for memory of `least` bytes and more, by all libraries and all processes
//                  that share the file $FAULTS_COUNT, number `at` (0: none) fails. The file holds how many there were.
//   FAULTS_CLOCK   the time of day goes back by an hour each time that it is asked for
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/time.h>
#include <time.h>
#include <unistd.h>

#define REPLACED extern "C" __attribute__((visibility("default")))

// The C library's own, which need no dlsym: that asks for memory.
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* __libc_calloc(std::size_t, std::size_t);
extern "C" void* __libc_realloc(void*, std::size_t);
extern "C" void* __libc_memalign(std::size_t, std::size_t);

namespace {

std::size_t g_least = 0; ///< 0: nothing is counted
long g_at = 0;
std::atomic<long>* g_count = nullptr;
std::atomic<long> g_hours{ 0 };
bool g_clock = false;

__attribute__((constructor)) void read_environment()
{
    g_clock = std::getenv("FAULTS_CLOCK") != nullptr;
    const char* const memory = std::getenv("FAULTS_MEMORY");
    const char* const name = std::getenv("FAULTS_COUNT");
    if (!memory || !name)
        return;
    const int file = ::open(name, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    void* shared = MAP_FAILED;
    if (file >= 0 && ::ftruncate(file, sizeof *g_count) == 0)
        shared = ::mmap(nullptr, sizeof *g_count, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    if (file >= 0)
        ::close(file);
    if (shared == MAP_FAILED)
        return;
    g_count = static_cast<std::atomic<long>*>(shared);
    std::sscanf(memory, "%zu %ld", &g_least, &g_at);
}

bool fails(std::size_t size)
{
    if (!g_least || size < g_least || ++*g_count != g_at)
        return false;
    errno = ENOMEM;
    return true;
}

time_t earlier()
{
    return g_clock ? 3600 * ++g_hours : 0;
}

} // namespace

REPLACED void* malloc(std::size_t size)
{
    return fails(size) ? nullptr : __libc_malloc(size);
}

REPLACED void* calloc(std::size_t count, std::size_t size)
{
    return size && count >= g_least / size && fails(count * size) ? nullptr : __libc_calloc(count, size);
}

REPLACED void* realloc(void* memory, std::size_t size)
{
    return fails(size) ? nullptr : __libc_realloc(memory, size);
}

REPLACED void* memalign(std::size_t alignment, std::size_t size)
{
    return fails(size) ? nullptr : __libc_memalign(alignment, size);
}

REPLACED void* aligned_alloc(std::size_t alignment, std::size_t size)
{
    return memalign(alignment, size);
}

REPLACED int posix_memalign(void** memory, std::size_t alignment, std::size_t size)
{
    void* const taken = memalign(alignment, size);
    if (!taken)
        return ENOMEM;
    *memory = taken;
    return 0;
}

REPLACED void* mmap(void* at, std::size_t size, int protection, int flags, int file, off_t offset)
{
    using Function = void* (*)(void*, std::size_t, int, int, int, off_t);
    static const auto real = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "mmap"));
    return fails(size) ? MAP_FAILED : real(at, size, protection, flags, file, offset);
}

REPLACED int clock_gettime(clockid_t clock, timespec* time)
{
    using Function = int (*)(clockid_t, timespec*);
    static const auto real = reinterpret_cast<Function>(::dlsym(RTLD_NEXT, "clock_gettime"));
    const int result = real(clock, time);
    if (result == 0 && clock == CLOCK_REALTIME)
        time->tv_sec -= earlier();
    return result;
}

REPLACED time_t time(time_t* target)
{
    timespec now;
    clock_gettime(CLOCK_REALTIME, &now);
    if (target)
        *target = now.tv_sec;
    return now.tv_sec;
}

REPLACED int gettimeofday(timeval* target, void*)
{
    timespec now;
    const int result = clock_gettime(CLOCK_REALTIME, &now);
    if (result == 0)
        *target = { now.tv_sec, now.tv_nsec / 1000 };
    return result;
}
