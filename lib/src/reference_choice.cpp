// SPDX-License-Identifier: Apache-2.0
#include <srisp/reference.h>

#include <filesystem>

#include "camera_files.h"

namespace srisp {

namespace {

/// FNV-1a, 64 bits, of the name, then SplitMix64 of that and the seed: the same on every machine and library, which
/// std::hash and the distributions of <random> do not promise.
std::uint64_t mixed(std::uint64_t seed, const std::string& name)
{
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : name)
        hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
    std::uint64_t z = hash + (seed + 1) * 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

} // namespace

Expected<std::string> choose_reference(const std::string& pattern, std::uint64_t seed, const std::string& photo_name)
{
    try {
        const auto files = expand_reference(pattern);
        if (!files)
            return files.error();
        const std::string name = std::filesystem::path(photo_name).filename().string();
        return (*files)[std::size_t(mixed(seed, name) % files->size())];
    } catch (const std::exception& failed) {
        return Error{ "reference '" + pattern + "': " + failed.what() };
    }
}

} // namespace srisp
