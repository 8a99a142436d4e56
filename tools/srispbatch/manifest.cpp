// SPDX-License-Identifier: Apache-2.0
#include "manifest.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "../common/failure.h"
#include "base/json_text.h"
#include "base/output_file.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const char kEnding[] = ".jsonl", kFailed[] = "failed";

std::string text_of(const json& line, const char* key)
{
    const auto found = line.find(key);
    return found != line.end() && found->is_string() ? found->get<std::string>() : std::string();
}

} // namespace

Manifest::Manifest(const std::string& folder, const std::string& shard_name)
    : m_folder((fs::path(folder) / "manifest").string()), m_shard_name(shard_name)
{
    std::error_code error;
    if (!fs::is_directory(m_folder, error))
        return;
    std::vector<std::string> files;
    for (const auto& entry : fs::directory_iterator(m_folder, error)) {
        const fs::path& path = entry.path();
        if (path.extension() == kEnding && path.filename().string().rfind(kFailed, 0) != 0)
            files.push_back(path.string());
    }
    if (error)
        fail("folder '" + m_folder + "' cannot be listed: " + error.message());
    std::sort(files.begin(), files.end());
    for (const std::string& file : files)
        read(file);
}

Manifest::~Manifest()
{
    if (m_file >= 0)
        ::close(m_file);
}

void Manifest::read(const std::string& path)
{
    std::ifstream lines(path);
    if (!lines)
        fail("manifest '" + path + "' cannot be read");
    for (std::string text; std::getline(lines, text);) {
        const auto line = parse_json<json>(text);
        if (!line || !line->is_object())
            continue;
        ManifestEntry entry{ text_of(*line, "output"), text_of(*line, "settings"), text_of(*line, "reference"), 0,
                             text_of(*line, "output_hash") };
        const auto bytes = line->find("bytes");
        if (entry.output.empty() || bytes == line->end() || !bytes->is_number_unsigned())
            continue;
        entry.bytes = bytes->get<std::uint64_t>();
        m_entries[entry.output] = std::move(entry);
    }
}

void Manifest::append(const nlohmann::ordered_json& line)
{
    const std::lock_guard lock(m_mutex);
    const std::string path = (fs::path(m_folder) / (m_shard_name + kEnding)).string();
    std::string text = line.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    if (m_file < 0) {
        std::error_code error;
        fs::create_directories(m_folder, error);
        m_file = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
        // A line that was cut off must not swallow the next one.
        char last = '\n';
        const off_t size = m_file < 0 ? 0 : ::lseek(m_file, 0, SEEK_END);
        if (size > 0 && ::pread(m_file, &last, 1, size - 1) == 1 && last != '\n')
            text = "\n" + text;
    }
    if (m_file < 0 || ::write(m_file, text.data(), text.size()) != ssize_t(text.size()))
        fail("manifest '" + path + "' cannot be written: " + std::strerror(errno));
}

std::string Manifest::failed_path() const
{
    return (fs::path(m_folder) /
            (m_shard_name == "all" ? kFailed + std::string(kEnding) : kFailed + ("-" + m_shard_name) + kEnding))
        .string();
}

void Manifest::write_failed(const std::vector<nlohmann::ordered_json>& lines) const
{
    std::error_code error;
    if (lines.empty()) {
        fs::remove(failed_path(), error);
        return;
    }
    fs::create_directories(m_folder, error);
    std::string text;
    for (const auto& line : lines)
        text += line.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    require(write_output_file(failed_path(), text));
}

} // namespace srisp::tool
