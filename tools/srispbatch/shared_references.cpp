// SPDX-License-Identifier: Apache-2.0
#include "shared_references.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

#include <srisp/reference.h>

#include "../common/machine_share.h"
#include "base/file_bytes.h"
#include "base/write_all.h"
#include "reference/reference_bytes.h"
#include "reference/reference_cache.h"

namespace srisp::tool {

namespace {

using Shared = std::shared_ptr<const SharedReference>;

Expected<Shared> decoded(const std::string& path)
{
    const auto reference = load_reference(path);
    if (!reference)
        return reference.error();
    const std::string bytes = bytes_of_reference(**reference);
    const int file = ::memfd_create("srisp reference", MFD_CLOEXEC);
    if (file < 0)
        return Error{ "no memory to share" };
    auto shared = std::make_shared<const SharedReference>(file);
    if (!write_all(bytes, [file](const char* data, std::size_t size) { return ::write(file, data, size); }))
        return Error{ "no memory to share" };
    return Shared(std::move(shared));
}

} // namespace

std::size_t most_references(double asked_memory_gb, unsigned processes)
{
    constexpr std::uint64_t kEach = 1'200'000; // bytes, with what selection needs of it
    const std::uint64_t fit = memory_limit(asked_memory_gb) / 8 / kEach / std::max(processes, 1u);
    return std::size_t(std::clamp<std::uint64_t>(fit, 8, 100'000));
}

SharedReference::~SharedReference()
{
    ::close(m_file);
}

std::string SharedReference::name() const
{
    return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(m_file);
}

Shared SharedReferences::get(const std::string& path)
{
    const auto found = m_kept.get(reference_state(path), [&] { return decoded(path); });
    return found ? *found : nullptr;
}

void take_shared_reference(const std::string& name, const std::string& path)
{
    if (name.empty() || is_reference_kept(path))
        return;
    constexpr std::size_t kMost = std::size_t(64) << 20; // bytes; a reference has 0.8 MB
    const auto bytes = read_head(name, kMost);
    auto reference = bytes ? reference_of_bytes(*bytes) : Expected<Reference>(bytes.error());
    if (!reference)
        return; // it will be decoded
    reference->path = path;
    reference->name = std::filesystem::path(path).filename().string();
    keep_reference(std::make_shared<const Reference>(std::move(*reference)));
}

} // namespace srisp::tool
