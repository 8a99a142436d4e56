// SPDX-License-Identifier: Apache-2.0
#include "journal.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>

#include <sys/file.h>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "../common/failure.h"
#include "base/json_text.h"
#include "base/shown_text.h"
#include "score_json.h"

namespace srisp::tool {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr char kFormat[] = "srisp-evaluation-1";
constexpr std::size_t kLongestLine = std::size_t(64) << 20;
constexpr std::size_t kMostBytes = std::size_t(256) << 20; // of one picture or histogram
constexpr int kLongestSide = 1 << 20;                      // of a picture, pixels

std::string bytes_of(const std::vector<std::int64_t>& counts)
{
    return { reinterpret_cast<const char*>(counts.data()), counts.size() * sizeof counts[0] };
}

std::vector<std::int64_t> counts_of(const std::string& bytes)
{
    std::vector<std::int64_t> counts(bytes.size() / sizeof(std::int64_t));
    if (!counts.empty()) // memcpy takes no null
        std::memcpy(counts.data(), bytes.data(), counts.size() * sizeof counts[0]);
    return counts;
}

/// The named bytes of an image, in the order in which they are stored.
using Blobs = std::vector<std::pair<std::string, std::string>>;

Blobs blobs_of(const EvaluatedImage& image)
{
    const ImagePictures& pictures = image.pictures;
    Blobs blobs{ { "photo", pictures.photo }, { "truth", pictures.truth }, { "reference", pictures.reference } };
    for (const auto& [method, picture] : pictures.results)
        blobs.emplace_back("result " + method, picture);
    for (const auto& [method, counts] : image.lab) {
        blobs.emplace_back("lab result " + method, bytes_of(counts.result));
        blobs.emplace_back("lab wanted " + method, bytes_of(counts.wanted));
    }
    return blobs;
}

/// What a record's line says of an image's bytes.
ordered_json sizes_of(const EvaluatedImage& image, const Blobs& blobs)
{
    const ImagePictures& pictures = image.pictures;
    ordered_json list = ordered_json::array();
    for (const auto& [name, bytes] : blobs)
        list.push_back({ name, bytes.size() });
    return { { "size", { pictures.width, pictures.height, pictures.reference_width, pictures.reference_height } },
             { "white_balance", pictures.white_balance },
             { "color", pictures.color },
             { "bytes", list } };
}

/// What sizes_of wrote, all of it: how many bytes the image has; none where any of it is damaged. May throw
/// json::exception.
std::optional<std::int64_t> bytes_of_sizes(const json& sizes)
{
    const auto pixels = sizes.at("size").get<std::vector<json>>();
    const auto is_side = [](const json& side) { return side.is_number_unsigned() && side <= kLongestSide; };
    if (pixels.size() != 4 || !std::all_of(pixels.begin(), pixels.end(), is_side))
        return {};
    sizes.at("white_balance").get<std::array<float, 3>>();
    sizes.at("color").get<std::array<float, 9>>();
    std::int64_t sum = 0;
    for (const json& one : sizes.at("bytes")) {
        one.at(0).get_ref<const std::string&>();
        const json& count = one.at(1);
        if (!count.is_number_unsigned() || count > kMostBytes)
            return {};
        sum += count.get<std::int64_t>();
    }
    return sum;
}

} // namespace

Journal::Journal(const std::string& path, const std::string& settings) : m_path(path)
{
    const std::string shown = path.empty() ? "temporary file" : "'" + shown_text(path) + "'";
    m_file = path.empty() ? std::tmpfile() : std::fopen(path.c_str(), "ab+");
    if (!m_file)
        fail(shown + " cannot be created: " + std::strerror(errno));
    if (::flock(::fileno(m_file), LOCK_EX | LOCK_NB) != 0)
        fail(shown + " is in use by another srispeval");
    read_records(settings);
    if (::ftruncate(::fileno(m_file), m_end) != 0)
        fail(shown + " cannot be written: " + std::strerror(errno));
    if (m_end == 0) {
        const std::string head = ordered_json{ { "format", kFormat }, { "settings", settings } }.dump() + "\n";
        if (std::fwrite(head.data(), 1, head.size(), m_file) != head.size() || std::fflush(m_file) != 0)
            fail(shown + " cannot be written: " + std::strerror(errno));
        m_end = std::int64_t(head.size());
    }
}

Journal::~Journal()
{
    if (m_file)
        std::fclose(m_file);
}

/// The next line of a file, without its end; false where there is no whole one.
static bool read_line(std::FILE* file, std::string& line)
{
    line.clear();
    for (int c = std::getc(file); c != EOF && line.size() < kLongestLine; c = std::getc(file)) {
        if (c == '\n')
            return true;
        line += char(c);
    }
    return false;
}

void Journal::read_records(const std::string& settings)
{
    std::fseek(m_file, 0, SEEK_END);
    const std::int64_t size = std::ftell(m_file);
    std::rewind(m_file);
    std::string line;
    if (!read_line(m_file, line))
        return;
    const auto head = parse_json<json>(line, kLongestLine);
    if (!head || !head->is_object() || head->value("format", json()) != kFormat ||
        head->value("settings", json()) != settings)
        return;
    m_end = std::ftell(m_file);
    while (read_line(m_file, line)) {
        const auto record = parse_json<json>(line, kLongestLine);
        if (!record)
            return;
        try {
            const std::string task = record->at("task").get<std::string>();
            std::int64_t offset = std::ftell(m_file);
            std::vector<Entry> entries;
            for (const json& image : record->at("images")) {
                auto score = image_score_from_json(image.at("score"));
                if (!score)
                    return;
                const json& pictures = image.at("pictures");
                const auto bytes = bytes_of_sizes(pictures);
                if (!bytes)
                    return;
                entries.push_back({ task, std::move(*score), offset, pictures.dump() });
                offset += *bytes;
            }
            std::vector<LeftOut> left_out;
            for (const json& one : record->at("left_out"))
                left_out.push_back({ one.at(0).get<std::string>(), one.at(1).get<std::string>() });
            if (offset > size || std::fseek(m_file, offset, SEEK_SET) != 0)
                return;
            m_end = offset;
            m_tasks.insert(task);
            m_left_out[task] = std::move(left_out);
            m_entries.insert(m_entries.end(), std::make_move_iterator(entries.begin()),
                             std::make_move_iterator(entries.end()));
        } catch (const json::exception&) {
            return; // damaged: what comes before it counts
        }
    }
}

void Journal::append(const std::string& task, const std::vector<EvaluatedImage>& images,
                     const std::vector<LeftOut>& left_out)
{
    ordered_json list = ordered_json::array(), missing = ordered_json::array();
    for (const LeftOut& one : left_out)
        missing.push_back({ one.file, one.reason });
    std::string bytes;
    std::vector<Entry> entries;
    for (const EvaluatedImage& image : images) {
        const Blobs blobs = blobs_of(image);
        const ordered_json sizes = sizes_of(image, blobs);
        const ordered_json score = to_json(image.score);
        // As a run that goes on will read it, so that both have the same bits.
        entries.push_back(
            { task, require(image_score_from_json(json(score))), std::int64_t(bytes.size()), sizes.dump() });
        list.push_back({ { "score", score }, { "pictures", sizes } });
        for (const auto& [name, blob] : blobs)
            bytes += blob;
    }
    const std::string line = ordered_json{ { "task", task }, { "images", list }, { "left_out", missing } }.dump(
                                 -1, ' ', false, json::error_handler_t::replace) +
                             "\n";
    const std::int64_t start = m_end + std::int64_t(line.size());
    const bool written = std::fseek(m_file, 0, SEEK_END) == 0 &&
                         std::fwrite(line.data(), 1, line.size(), m_file) == line.size() &&
                         std::fwrite(bytes.data(), 1, bytes.size(), m_file) == bytes.size() && std::fflush(m_file) == 0;
    if (!written)
        fail((m_path.empty() ? std::string("temporary file") : "'" + shown_text(m_path) + "'") +
             " cannot be written: " + std::strerror(errno));
    for (Entry& entry : entries) {
        entry.offset += start;
        m_entries.push_back(std::move(entry));
    }
    m_end = start + std::int64_t(bytes.size());
    m_tasks.insert(task);
    m_left_out[task] = left_out;
}

std::string Journal::bytes(std::int64_t offset, std::size_t count) const
{
    std::string result(count, '\0');
    if (std::fseek(m_file, offset, SEEK_SET) != 0 || std::fread(&result[0], 1, count, m_file) != count)
        fail("what was kept of this evaluation cannot be read again: " + std::string(std::strerror(errno)));
    return result;
}

ImagePictures Journal::pictures(const Entry& entry) const
{
    const json sizes = require(parse_json<json>(entry.sizes));
    ImagePictures pictures;
    pictures.width = sizes["size"][0];
    pictures.height = sizes["size"][1];
    pictures.reference_width = sizes["size"][2];
    pictures.reference_height = sizes["size"][3];
    pictures.white_balance = sizes["white_balance"].get<std::array<float, 3>>();
    pictures.color = sizes["color"].get<std::array<float, 9>>();
    const std::string result = "result ";
    std::int64_t offset = entry.offset;
    for (const json& one : sizes["bytes"]) {
        const auto name = one[0].get<std::string>();
        const auto count = one[1].get<std::size_t>();
        if (name == "photo")
            pictures.photo = bytes(offset, count);
        else if (name == "truth")
            pictures.truth = bytes(offset, count);
        else if (name == "reference")
            pictures.reference = bytes(offset, count);
        else if (name.compare(0, result.size(), result) == 0)
            pictures.results[name.substr(result.size())] = bytes(offset, count);
        offset += std::int64_t(count);
    }
    return pictures;
}

std::map<std::string, LabCounts> Journal::lab(const Entry& entry) const
{
    const std::string of_result = "lab result ", of_wanted = "lab wanted ";
    std::map<std::string, LabCounts> lab;
    std::int64_t offset = entry.offset;
    const json sizes = require(parse_json<json>(entry.sizes));
    for (const json& one : sizes["bytes"]) {
        const auto name = one[0].get<std::string>();
        const auto count = one[1].get<std::size_t>();
        if (name.compare(0, of_result.size(), of_result) == 0)
            lab[name.substr(of_result.size())].result = counts_of(bytes(offset, count));
        else if (name.compare(0, of_wanted.size(), of_wanted) == 0)
            lab[name.substr(of_wanted.size())].wanted = counts_of(bytes(offset, count));
        offset += std::int64_t(count);
    }
    return lab;
}

void Journal::remove()
{
    if (!m_path.empty())
        ::unlink(m_path.c_str());
}

} // namespace srisp::tool
