// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "evaluated_image.h"

namespace srisp::tool {

/// What an evaluation has found out so far, on disk: scores and pictures of each task that is done. A run that was
/// stopped goes on from it, and a run never has more than one picture in memory. One record follows the other: a line
/// of JSON, then the bytes whose sizes it tells; a last one that is not whole is none.
class Journal {
public:
    /// `path` "": a file without a name, which goes with this object. `settings`: what decides the results, for all
    /// tasks; records of others are thrown away. Throws Failure.
    Journal(const std::string& path, const std::string& settings);
    ~Journal();
    Journal(const Journal&) = delete;
    Journal& operator=(const Journal&) = delete;

    /// Names and states of the tasks that are in it.
    const std::set<std::string>& tasks() const { return m_tasks; }
    /// What could not be tested of these tasks, by their names.
    const std::map<std::string, std::vector<LeftOut>>& left_out() const { return m_left_out; }
    /// Adds what one task found out. Throws Failure, as on a full disk.
    void append(const std::string& task, const std::vector<EvaluatedImage>& images,
                const std::vector<LeftOut>& left_out = {});

    /// Where an image lies in it; scores are in memory, pictures are not.
    struct Entry {
        std::string task;
        ImageScore score;
        std::int64_t offset; ///< of its bytes
        std::string sizes;   ///< JSON: which bytes these are
    };
    const std::vector<Entry>& entries() const { return m_entries; }
    ImagePictures pictures(const Entry& entry) const;
    std::map<std::string, LabCounts> lab(const Entry& entry) const;

    /// Removes the file: everything that it holds is in its place.
    void remove();

private:
    void read_records(const std::string& settings);
    std::string bytes(std::int64_t offset, std::size_t count) const;

    std::string m_path;
    std::FILE* m_file = nullptr;
    std::int64_t m_end = 0; ///< of the last whole record
    std::set<std::string> m_tasks;
    std::vector<Entry> m_entries;
    std::map<std::string, std::vector<LeftOut>> m_left_out;
};

} // namespace srisp::tool
