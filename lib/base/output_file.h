// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include <srisp/expected.h>

namespace srisp {

/// A file that appears under its name only when it is complete: it is written to a temporary name in the same folder,
/// flushed to disk and renamed. What is not finished is removed. Errors, as `'path' cannot be created: reason`.
class OutputFile {
public:
    explicit OutputFile(std::string path);
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Appends; after a failure it does nothing, and `finish` says why.
    void write(const void* data, std::size_t bytes);
    void write(const std::string& text) { write(text.data(), text.size()); }
    /// Writes over the first bytes, which were written before.
    void write_start(const void* data, std::size_t bytes);
    /// Whether all went well so far.
    bool good() const { return m_error.empty(); }

    /// Call once, at the end.
    Status finish();

private:
    void fail(const std::string& doing);

    std::string m_path, m_temporary, m_error;
    std::FILE* m_file;
};

/// A whole file at once.
Status write_output_file(const std::string& path, const std::string& bytes);

} // namespace srisp
