// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include <srisp/expected.h>

#include "base/byte_sink.h"

namespace srisp {

/// A file that appears under its name only when it is complete: it is written without a name where the file system has
/// that, else under a hidden one (unfinished.h), flushed to disk, and takes the place of what had the name, be that a
/// link. What is not finished is gone. A device or pipe (device_output.h) is written to as it is. Errors, as `'path'
/// cannot be created: reason`.
class OutputFile : public ByteSink {
public:
    explicit OutputFile(std::string path);
    ~OutputFile() override;
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    /// Appends; after a failure it does nothing, and `finish` says why.
    using ByteSink::write;
    void write(const void* data, std::size_t bytes) override;
    /// Writes over the first bytes, which were written before.
    void write_start(const void* data, std::size_t bytes);
    bool good() const override { return m_error.empty(); }

    /// Call once, at the end.
    Status finish();

private:
    int open();
    bool place();
    void fail(const std::string& doing);

    std::string m_path, m_error;
    std::string m_unfinished; ///< its name until it is finished; "": it has none, or is a device
    bool m_device;
    std::FILE* m_file = nullptr;
};

/// A whole file at once.
Status write_output_file(const std::string& path, const void* data, std::size_t bytes);
Status write_output_file(const std::string& path, const std::string& bytes);

} // namespace srisp
