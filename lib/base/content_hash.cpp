// SPDX-License-Identifier: Apache-2.0
#include "base/hashes.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "base/printed.h"

namespace srisp {

static std::string as_text(XXH128_hash_t hash)
{
    return printed("xxh128:%016llx%016llx", static_cast<unsigned long long>(hash.high64),
                   static_cast<unsigned long long>(hash.low64));
}

std::string hash_of_bytes(const void* data, std::size_t size)
{
    return as_text(XXH3_128bits(data, size));
}

Expected<std::string> hash_of_file(const std::string& path)
{
    std::unique_ptr<FILE, int (*)(FILE*)> file(std::fopen(path.c_str(), "rb"), std::fclose);
    if (!file)
        return Error{ "cannot open '" + path + "': " + std::strerror(errno) };
    std::unique_ptr<XXH3_state_t, XXH_errorcode (*)(XXH3_state_t*)> state(XXH3_createState(), XXH3_freeState);
    XXH3_128bits_reset(state.get());
    std::vector<char> buffer(1 << 20);
    while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), file.get()))
        XXH3_128bits_update(state.get(), buffer.data(), count);
    if (std::ferror(file.get()))
        return Error{ "cannot read '" + path + "': " + std::strerror(errno) };
    return as_text(XXH3_128bits_digest(state.get()));
}

} // namespace srisp
