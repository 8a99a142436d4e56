// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace srisp::tool {

/// What is known of a file that was made.
struct ManifestEntry {
    std::string output;      ///< relative to the output folder
    std::string settings;    ///< a hash of all that decides its bytes but photo, reference and seed
    std::string reference;   ///< as it was named
    std::uint64_t bytes = 0; ///< its size
    std::string hash;        ///< of its bytes
};

/// The records of an output folder, `manifest/*.jsonl`: a line for each file that was made, appended when it is in its
/// place. Each shard has a file of its own. A line that is cut off, as by a power cut, is no line.
class Manifest {
public:
    /// Reads what is there. `shard_name`: of the file that lines are appended to. Throws Failure: it cannot be read.
    Manifest(const std::string& folder, const std::string& shard_name);
    ~Manifest();
    Manifest(const Manifest&) = delete;
    Manifest& operator=(const Manifest&) = delete;

    /// The last line of each output.
    const std::map<std::string, ManifestEntry>& entries() const { return m_entries; }

    /// One write of a whole line. Throws Failure where that fails. Threads: safe.
    void append(const nlohmann::ordered_json& line);

    /// Replaces the list of what failed; an empty one is removed. Throws Failure.
    void write_failed(const std::vector<nlohmann::ordered_json>& lines) const;
    std::string failed_path() const;

private:
    void read(const std::string& path);

    std::string m_folder, m_shard_name;
    std::map<std::string, ManifestEntry> m_entries;
    std::mutex m_mutex;
    int m_file = -1;
};

} // namespace srisp::tool
