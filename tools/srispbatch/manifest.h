// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace srisp::tool {

/// What is known of a file that was made.
struct ManifestEntry {
    std::string output;         ///< relative to the output folder
    std::string settings;       ///< a hash of all that decides its bytes but photo, reference and seed
    std::string reference;      ///< as it was named
    std::string photo_hash;     ///< of the files' bytes, as they were
    std::string reference_hash; ///< the same
    std::uint64_t bytes = 0;    ///< its size
    std::string hash;           ///< of its bytes
};

/// The folder of an output folder's records.
std::string manifest_folder(const std::string& output);

/// A member of a line; "" or -1 where it is missing or something else.
std::string text_of(const nlohmann::ordered_json& line, const char* key);
std::int64_t number_of(const nlohmann::ordered_json& line, const char* key);

/// Calls `use` for each whole line of all manifests there, file after file, in the order of their names, with the file
/// and the line's number from 1. A line that is cut off, as by a power cut, is no line. Throws Failure: one cannot be
/// read.
void for_each_record(
    const std::string& output,
    const std::function<void(const nlohmann::ordered_json& line, const std::string& file, std::size_t number)>& use);

/// The records of an output folder, `manifest/*.jsonl`: a line for each file that was made, appended when it is in its
/// place. Each shard has a file of its own.
class Manifest {
public:
    /// Reads what is there. `shard_name`: of the file that lines are appended to. Throws Failure: it cannot be read.
    Manifest(const std::string& output, const std::string& shard_name);
    ~Manifest();
    Manifest(const Manifest&) = delete;
    Manifest& operator=(const Manifest&) = delete;

    /// Of each output the line that was written last.
    const std::map<std::string, ManifestEntry>& entries() const { return m_entries; }

    /// One write of a whole line. Throws Failure where that fails. Threads: safe.
    void append(const nlohmann::ordered_json& line);

    /// From here on until the end this run is at work: nothing merges. Throws Failure: someone does.
    void begin();

    /// Keeps the settings that lines name by their hash, as `settings-HASH.json`. Throws Failure.
    void write_settings(const std::string& hash, const std::string& text) const;

    /// Keeps the names of all results that the set is to have, of all shards, for those who check whether it is
    /// complete. Throws Failure.
    void write_plan(const std::vector<std::string>& outputs) const;

    /// Replaces the list of what failed; an empty one is removed. Throws Failure.
    void write_failed(const std::vector<nlohmann::ordered_json>& lines) const;
    std::string failed_path() const;

private:
    std::string m_folder, m_shard_name;
    std::map<std::string, ManifestEntry> m_entries;
    std::mutex m_mutex;
    int m_file = -1;
    int m_lock = -1; ///< shared with other runs, not with merge_manifests
};

/// The names that write_plan kept. Throws Failure: there are none.
std::vector<std::string> read_plan(const std::string& output);

/// The text of the settings that a line names. Throws Failure.
std::string read_settings(const std::string& output, const std::string& hash);

/// Makes one manifest of those of all shards, `all.jsonl`, sorted by output, each with its last line; likewise one list
/// of what failed. Returns how many results it has. Throws Failure: a run is at work there; a file cannot be read or
/// written.
std::size_t merge_manifests(const std::string& output);

} // namespace srisp::tool
