// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// Reads a whole file of at most `max_bytes`; `where` starts every message ("model 'm.safetensors'").
Expected<std::string> read_file(const std::string& path, std::uint64_t max_bytes, const std::string& where);

/// A small text file. Errors, as `'path': reason`: missing, a folder, unreadable, more than `most` bytes.
Expected<std::string> read_text_file(const std::string& path, std::size_t most);

/// A whole file, mapped for reading: pages come from disk when they are touched, and are shared between processes. It
/// must not be made shorter meanwhile.
class MappedFile {
public:
    /// Errors, as "'path' …": missing, unreadable, no regular file, empty.
    static Expected<MappedFile> open(const std::string& path);
    MappedFile() = default;
    ~MappedFile();
    MappedFile(MappedFile&& other) noexcept;
    MappedFile& operator=(MappedFile&& other) noexcept;

    const char* data() const { return m_data; }
    std::size_t size() const { return m_size; }

private:
    const char* m_data = nullptr;
    std::size_t m_size = 0;
};

} // namespace srisp
