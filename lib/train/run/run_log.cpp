// SPDX-License-Identifier: Apache-2.0
#include "train/run/run_log.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <iterator>
#include <memory>
#include <sstream>

#include "base/input_file.h"
#include "base/json_text.h"
#include "base/output_file.h"

namespace srisp::train {

namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kMostBytes = std::uint64_t(1) << 32;
const char* const kColumns[] = { "step",        "seconds",    "steps_per_second", "loss",
                                 "reverse",     "forward",    "teacher",          "gradient_norm",
                                 "rate_factor", "data_share", "learning_share",   "score",
                                 "psnr",        "angle" };

std::string head_line()
{
    std::string line;
    for (const char* column : kColumns)
        line += (line.empty() ? "" : ",") + std::string(column);
    return line + "\n";
}

std::string csv_line(const ordered_json& entry)
{
    std::string line;
    for (const char* column : kColumns) {
        const auto found = entry.find(column);
        line += (line.empty() ? "" : ",") + (found == entry.end() || !found->is_number() ? "" : found->dump());
    }
    return line + "\n";
}

Status append(const std::string& path, const std::string& line)
{
    const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "ab"), std::fclose);
    if (!file || std::fwrite(line.data(), 1, line.size(), file.get()) != line.size() || std::fflush(file.get()) != 0)
        return Error{ "'" + path + "': cannot write: " + std::strerror(errno) };
    return {};
}

/// Keeps the lines for which `step_of` is at most `step`; a line that was cut off has step -1 and goes as well.
Status keep_lines(const std::string& path, std::int64_t step,
                  const std::function<std::int64_t(const std::string&)>& step_of)
{
    if (std::error_code error; !std::filesystem::exists(path, error))
        return {};
    const Expected<std::string> text = read_file(path, kMostBytes, "log");
    if (!text)
        return text.error();
    std::string kept;
    std::istringstream lines(*text);
    for (std::string line; std::getline(lines, line);)
        if (const std::int64_t of_line = step_of(line); of_line >= 0 && of_line <= step)
            kept += line + "\n";
    return write_output_file(path, kept);
}

std::int64_t step_of_csv(const std::string& line)
{
    if (line + "\n" == head_line())
        return 0;
    char* end = nullptr;
    const std::int64_t step = std::strtoll(line.c_str(), &end, 10);
    return *end == ',' && std::count(line.begin(), line.end(), ',') + 1 == std::ptrdiff_t(std::size(kColumns)) ? step
                                                                                                               : -1;
}

std::int64_t step_of_json(const std::string& line)
{
    const auto entry = parse_json<nlohmann::json>(line);
    const nlohmann::json step = entry && entry->is_object() ? entry->value("step", nlohmann::json()) : nlohmann::json();
    return step.is_number_integer() ? step.get<std::int64_t>() : -1;
}

} // namespace

RunLog::RunLog(const std::string& folder) : m_csv_path(folder + "/" + kCsvLog), m_json_path(folder + "/" + kJsonLog) {}

Status RunLog::resume_after(std::int64_t step)
{
    if (Status status = keep_lines(m_csv_path, step, step_of_csv); !status)
        return status;
    return keep_lines(m_json_path, step, step_of_json);
}

Status RunLog::add(const ordered_json& entry)
{
    if (std::error_code error; !std::filesystem::exists(m_csv_path, error))
        if (Status status = append(m_csv_path, head_line()); !status)
            return status;
    if (Status status = append(m_csv_path, csv_line(entry)); !status)
        return status;
    return append(m_json_path, entry.dump() + "\n");
}

} // namespace srisp::train
