// SPDX-License-Identifier: Apache-2.0
#include "manifest.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "../common/failure.h"
#include "../common/file_list.h"
#include "base/hashes.h"
#include "base/input_file.h"
#include "base/json_text.h"
#include "base/output_file.h"
#include "base/shown_text.h"
#include "base/write_all.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

const std::string kEnding = ".jsonl", kFailed = "failed", kAll = "all";

/// The files of lines in a folder: of what was made, or of what failed.
std::vector<std::string> record_files(const std::string& folder, bool failed)
{
    std::vector<std::string> files;
    std::error_code error;
    if (!fs::is_directory(folder, error))
        return files;
    for (const auto& entry : fs::directory_iterator(folder, error)) {
        const std::string name = entry.path().filename().string();
        if (entry.path().extension() == kEnding && name[0] != '.' && (name.rfind(kFailed, 0) == 0) == failed)
            files.push_back(entry.path().string());
    }
    if (error)
        fail("folder '" + folder + "' cannot be listed: " + error.message());
    std::sort(files.begin(), files.end());
    return files;
}

std::string text_line(const ordered_json& line)
{
    return line.dump(-1, ' ', true, ordered_json::error_handler_t::replace) + "\n";
}

void make_folder(const std::string& folder)
{
    std::error_code error;
    fs::create_directories(folder, error);
    if (error)
        fail("folder '" + folder + "' cannot be made: " + error.message());
}

/// A lock on the folder, LOCK_SH or LOCK_EX, until its descriptor is closed or the process ends. Where a file system
/// has no locks there is none.
int lock_folder(const std::string& folder, int kind)
{
    const int lock = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (lock < 0)
        fail("folder '" + folder + "' cannot be opened: " + std::strerror(errno));
    if (::flock(lock, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK)
        return lock;
    ::close(lock);
    fail("folder '" + folder +
         "': " + (kind == LOCK_EX ? "a run of srispbatch is at work" : "its manifests are being merged"));
}

std::string settings_path(const std::string& folder, const std::string& hash)
{
    const std::string digits = hash.substr(hash.find(':') + 1); // "xxh128:…"
    return (fs::path(folder) / ("settings-" + digits + ".json")).string();
}

std::string plan_path(const std::string& folder)
{
    return (fs::path(folder) / "plan.txt").string();
}

/// Which record of a result is the last: in one file the later line, whatever clocks said meanwhile; of two files the
/// one with the later time.
class LastRecord {
public:
    bool is_older(const std::string& file, std::int64_t time)
    {
        if (file != m_file && time < m_time)
            return true;
        m_file = file;
        m_time = time;
        return false;
    }

private:
    std::string m_file;
    std::int64_t m_time = -1;
};

} // namespace

std::string text_of(const ordered_json& line, const char* key)
{
    const auto found = line.find(key);
    return found != line.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::int64_t number_of(const ordered_json& line, const char* key)
{
    const auto found = line.find(key);
    return found != line.end() && found->is_number_integer() ? found->get<std::int64_t>() : -1;
}

std::string manifest_folder(const std::string& output)
{
    return (fs::path(output) / "manifest").string();
}

void for_each_record(
    const std::string& output,
    const std::function<void(const ordered_json& line, const std::string& file, std::size_t number)>& use)
{
    for (const std::string& file : record_files(manifest_folder(output), false)) {
        std::ifstream lines(file);
        if (!lines)
            fail("manifest '" + file + "' cannot be read");
        std::size_t number = 0;
        for (std::string text; std::getline(lines, text);) {
            ++number;
            const auto line = parse_json<ordered_json>(text);
            if (!line || !line->is_object() || text_of(*line, "output").empty() || number_of(*line, "bytes") < 0)
                continue;
            if (leads_out(text_of(*line, "output")))
                fail("manifest '" + file + "', line " + std::to_string(number) + ": output '" +
                     shown_text(text_of(*line, "output")) + "' is not in the folder '" + output + "'");
            use(*line, file, number);
        }
    }
}

Manifest::Manifest(const std::string& output, const std::string& shard_name)
    : m_folder(manifest_folder(output)), m_shard_name(shard_name)
{
    std::map<std::string, LastRecord> last;
    for_each_record(output, [&](const ordered_json& line, const std::string& file, std::size_t) {
        ManifestEntry entry{ text_of(line, "output"),         text_of(line, "settings"),
                             text_of(line, "reference"),      text_of(line, "photo_hash"),
                             text_of(line, "reference_hash"), std::uint64_t(number_of(line, "bytes")),
                             text_of(line, "output_hash") };
        if (last[entry.output].is_older(file, number_of(line, "time")))
            return;
        m_entries[entry.output] = std::move(entry);
    });
}

Manifest::~Manifest()
{
    for (const int file : { m_file, m_lock })
        if (file >= 0)
            ::close(file);
}

void Manifest::begin()
{
    make_folder(m_folder);
    m_lock = lock_folder(m_folder, LOCK_SH);
}

void Manifest::append(const ordered_json& line)
{
    const std::lock_guard lock(m_mutex);
    const std::string path = (fs::path(m_folder) / (m_shard_name + kEnding)).string();
    std::string text = text_line(line);
    if (m_file < 0) {
        make_folder(m_folder);
        m_file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        // A line that was cut off must not swallow the next one.
        char last = '\n';
        const off_t size = m_file < 0 ? 0 : ::lseek(m_file, 0, SEEK_END);
        if (size > 0 && ::pread(m_file, &last, 1, size - 1) == 1 && last != '\n')
            text = "\n" + text;
    }
    const auto write = [this](const char* data, std::size_t size) { return ::write(m_file, data, size); };
    if (m_file < 0 || !write_all(text, write))
        fail("manifest '" + path + "' cannot be written: " + std::strerror(errno));
}

void Manifest::write_settings(const std::string& hash, const std::string& text) const
{
    make_folder(m_folder);
    const std::string path = settings_path(m_folder, hash);
    std::error_code error;
    if (!fs::exists(path, error))
        require(write_output_file(path, text));
}

void Manifest::write_plan(const std::vector<std::string>& outputs) const
{
    make_folder(m_folder);
    std::string text;
    for (const std::string& output : outputs)
        text += text_line(output);
    const std::string path = plan_path(m_folder);
    const auto there = hash_of_file(path);
    if (!there || *there != hash_of_bytes(text.data(), text.size()))
        require(write_output_file(path, text));
}

std::string Manifest::failed_path() const
{
    return (fs::path(m_folder) / (kFailed + (m_shard_name == kAll ? "" : "-" + m_shard_name) + kEnding)).string();
}

void Manifest::write_failed(const std::vector<ordered_json>& lines) const
{
    std::error_code error;
    if (lines.empty()) {
        fs::remove(failed_path(), error);
        return;
    }
    make_folder(m_folder);
    std::string text;
    for (const auto& line : lines)
        text += text_line(line);
    require(write_output_file(failed_path(), text));
}

std::vector<std::string> read_plan(const std::string& output)
{
    const std::string path = plan_path(manifest_folder(output));
    std::ifstream lines(path);
    if (!lines)
        fail("'" + path + "' cannot be read: what the set is to have is not known (the first shard writes it)");
    std::vector<std::string> outputs;
    for (std::string text; std::getline(lines, text);)
        if (const auto name = parse_json<ordered_json>(text); name && name->is_string())
            outputs.push_back(name->get<std::string>());
    return outputs;
}

std::string read_settings(const std::string& output, const std::string& hash)
{
    if (hash.find('/') != std::string::npos)
        fail("settings '" + shown_text(hash) + "' are no hash");
    const std::string path = settings_path(manifest_folder(output), hash);
    auto text = read_text_file(path, kLargestJson);
    if (!text)
        fail("settings " + text.error().message);
    return *text;
}

std::size_t merge_manifests(const std::string& output)
{
    const std::string folder = manifest_folder(output);
    struct Last {
        LastRecord record;
        std::string text;
    };
    std::map<std::string, Last> lines;
    std::error_code none;
    const int lock = fs::is_directory(folder, none) ? lock_folder(folder, LOCK_EX) : -1;
    for_each_record(output, [&](const ordered_json& line, const std::string& file, std::size_t) {
        Last& last = lines[text_of(line, "output")];
        if (!last.record.is_older(file, number_of(line, "time")))
            last.text = text_line(line);
    });
    if (lines.empty())
        fail("folder '" + output + "' has no manifest of srispbatch's");
    const auto join = [&](const std::string& name, const std::string& text, bool failed) {
        const std::string joined = (fs::path(folder) / (name + kEnding)).string();
        const std::vector<std::string> parts = record_files(folder, failed);
        if (!text.empty())
            require(write_output_file(joined, text));
        std::error_code error;
        for (const std::string& part : parts)
            if (part != joined || text.empty())
                fs::remove(part, error);
    };
    std::string text, failed;
    for (const auto& [name, last] : lines)
        text += last.text;
    for (const std::string& file : record_files(folder, true)) {
        std::ifstream list(file);
        for (std::string line; std::getline(list, line);)
            if (const auto parsed = parse_json<ordered_json>(line); parsed && parsed->is_object())
                if (lines.count(text_of(*parsed, "output")) == 0)
                    failed += line + "\n";
    }
    join(kAll, text, false);
    join(kFailed, failed, true);
    ::close(lock);
    return lines.size();
}

} // namespace srisp::tool
