// SPDX-License-Identifier: Apache-2.0
#include "file_copies.h"

#include <algorithm>
#include <filesystem>

#include "../common/failure.h"
#include "../common/file_list.h"
#include "../common/interrupt.h"
#include "base/hashes.h"
#include "base/named_output.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

/// Whether it was copied: not where the same is there.
bool copy_file(const ListedFile& file, const fs::path& target, bool overwrite)
{
    std::error_code error;
    if (fs::exists(target, error)) {
        const bool same_size = fs::file_size(target, error) == fs::file_size(file.path, error);
        if (same_size && require(hash_of_file(file.path)) == require(hash_of_file(target.string())))
            return false;
        if (!overwrite)
            fail("output '" + target.string() + "' exists and differs from '" + file.path +
                 "'; --overwrite replaces it");
    }
    const std::string where = "output '" + target.string() + "' cannot be written: ";
    fs::create_directories(target.parent_path(), error);
    NamedOutput output(target.string());
    if (!output.created())
        fail(where + output.created().error().message);
    if (!fs::copy_file(file.path, output.name(), fs::copy_options::overwrite_existing, error))
        fail(where + error.message());
    if (const Status done = output.finish(); !done)
        fail(where + done.error().message);
    return true;
}

} // namespace

std::int64_t copy_files(const BatchOptions& options, const std::set<std::string>& results)
{
    std::int64_t copied = 0;
    for (const ListedFile& file : list_companions(options.photos, options.copy, options.output)) {
        check_interrupt();
        if (results.count(file.name))
            fail_usage("--copy: '" + file.path + "' would be copied onto a result");
        copied += copy_file(file, fs::path(options.output) / file.name, options.overwrite);
    }
    return copied;
}

} // namespace srisp::tool
