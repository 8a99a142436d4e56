// SPDX-License-Identifier: Apache-2.0
#include "reference_set.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <sstream>

#include <OpenImageIO/strutil.h>

#include "../common/failure.h"
#include "base/hashes.h"
#include "base/input_file.h"
#include "base/parsed_number.h"
#include "base/shown_text.h"
#include "recipe/reference_pattern.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLargestCsv = std::size_t(1) << 30;

/// The fields of a line; a field in double quotes may hold commas, and "" for a quote. None: a quote does not end.
std::optional<std::vector<std::string>> fields_of(const std::string& line)
{
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"')
            fields.back() += line[++i];
        else if (c == '"' && (quoted || fields.back().empty()))
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    if (quoted)
        return {};
    return fields;
}

bool is_csv(const std::string& text)
{
    return OIIO::Strutil::iends_with(text, ".csv");
}

} // namespace

ReferenceSet ReferenceSet::read(const std::string& text)
{
    ReferenceSet set;
    if (is_csv(text)) {
        set.read_csv(text);
        return set;
    }
    set.m_references = require(expand_references(require(split_references(text))));
    for (const std::string& reference : set.m_references) {
        std::error_code error;
        if (!fs::exists(reference, error))
            fail("reference '" + reference + "' does not exist");
        set.m_up_to.push_back(double(set.m_up_to.size() + 1));
    }
    return set;
}

void ReferenceSet::read_csv(const std::string& path)
{
    const auto text = read_text_file(path, kLargestCsv);
    if (!text)
        fail("references " + text.error().message);
    const fs::path folder = fs::path(path).parent_path();
    std::istringstream lines(*text);
    std::vector<std::string> header;
    std::size_t number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        const std::string where = "references '" + path + "', line " + std::to_string(number) + ": ";
        const auto fields = fields_of(line);
        if (!fields)
            fail(where + "a quote does not end");
        if (line.empty())
            continue;
        if (header.empty()) {
            header = *fields;
            const bool known = header == std::vector<std::string>{ "photo", "reference" } ||
                               header == std::vector<std::string>{ "reference", "weight" };
            if (!known)
                fail(where + "'" + shown_text(line) + "' must be 'photo,reference' or 'reference,weight'");
            continue;
        }
        if (fields->size() != 2 || (*fields)[0].empty() || (*fields)[1].empty())
            fail(where + "must have two fields, " + header[0] + " and " + header[1]);
        if (header[0] == "photo") {
            m_of_photo[fs::path((*fields)[0]).lexically_normal().string()].push_back((folder / (*fields)[1]).string());
            continue;
        }
        const auto weight = parsed_number<double>((*fields)[1]);
        if (!weight || *weight <= 0)
            fail(where + "weight '" + shown_text((*fields)[1]) + "' is no number above 0");
        m_references.push_back((folder / (*fields)[0]).string());
        m_up_to.push_back((m_up_to.empty() ? 0 : m_up_to.back()) + *weight);
    }
    if (m_references.empty() && m_of_photo.empty())
        fail("references '" + path + "' names none");
}

std::vector<std::string> ReferenceSet::of(const ListedFile& photo, std::size_t place, const BatchOptions& options) const
{
    std::vector<std::string> chosen;
    if (has_pairs()) {
        const auto found = m_of_photo.find(photo.name);
        if (found == m_of_photo.end())
            fail("photo '" + photo.name + "' has no reference in the CSV file");
        for (const std::string& reference : found->second)
            chosen.insert(chosen.end(), std::size_t(options.per_image), reference);
        return chosen;
    }
    if (options.pairing == Pairing::all) {
        for (const std::string& reference : m_references)
            chosen.insert(chosen.end(), std::size_t(options.per_image), reference);
        return chosen;
    }
    for (int copy = 0; copy < options.per_image; ++copy) {
        std::size_t which = (place * std::size_t(options.per_image) + std::size_t(copy)) % m_references.size();
        if (options.pairing == Pairing::random) {
            const std::uint64_t hash = seeded_hash(options.seed, photo.name + "\nreference\n" + std::to_string(copy));
            const double at = double(hash >> 11) * 0x1p-53 * m_up_to.back();
            which = std::size_t(std::upper_bound(m_up_to.begin(), m_up_to.end(), at) - m_up_to.begin());
            which = std::min(which, m_references.size() - 1);
        }
        chosen.push_back(m_references[which]);
    }
    return chosen;
}

} // namespace srisp::tool
