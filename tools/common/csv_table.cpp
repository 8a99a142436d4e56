// SPDX-License-Identifier: Apache-2.0
#include "csv_table.h"

#include <algorithm>
#include <set>

#include "base/input_file.h"
#include "base/shown_text.h"

#include "failure.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kMaxBytes = std::size_t(1) << 28;
constexpr std::size_t kMaxColumns = 10000;

/// Takes fields and rows from a text.
class CsvReader {
public:
    CsvReader(const std::string& text, const std::string& where) : m_text(text), m_where(where)
    {
        if (m_text.compare(0, 3, "\xef\xbb\xbf") == 0) // the mark that spreadsheets put first
            m_at = 3;
    }

    bool at_end() const { return m_at >= m_text.size(); }
    int line() const { return m_line; }

    std::vector<std::string> row()
    {
        std::vector<std::string> fields = { field() };
        while (!at_end() && m_text[m_at] == ',') {
            ++m_at;
            fields.push_back(field());
        }
        if (!at_end() && m_text[m_at] == '\r')
            ++m_at;
        if (!at_end() && m_text[m_at] != '\n')
            fail(where() + ": text behind a closing quote");
        ++m_at;
        ++m_line;
        return fields;
    }

    std::string where() const { return m_where + ", line " + std::to_string(m_line); }

private:
    std::string field()
    {
        std::string value;
        if (at_end() || m_text[m_at] != '"') {
            const std::size_t end = std::min(m_text.find_first_of(",\r\n", m_at), m_text.size());
            value = m_text.substr(m_at, end - m_at);
            m_at = end;
            return value;
        }
        for (++m_at; !at_end(); ++m_at) {
            if (m_text[m_at] == '"' && (++m_at >= m_text.size() || m_text[m_at] != '"'))
                return value; // a doubled quote is a quote
            value += m_text[m_at];
        }
        fail(where() + ": a quote is not closed");
    }

    const std::string& m_text;
    std::string m_where;
    std::size_t m_at = 0;
    int m_line = 1;
};

} // namespace

CsvTable read_csv(const std::string& path)
{
    const std::string where = "'" + path + "'";
    const Expected<std::string> text = read_text_file(path, kMaxBytes);
    if (!text)
        fail(text.error().message);
    CsvReader reader(*text, where);
    if (reader.at_end())
        fail(where + " is empty");
    CsvTable table;
    table.columns = reader.row();
    if (table.columns.size() > kMaxColumns)
        fail(where + ": has " + std::to_string(table.columns.size()) + " columns, limit " +
             std::to_string(kMaxColumns));
    std::set<std::string> known;
    for (const std::string& column : table.columns)
        if (!known.insert(column).second)
            fail(where + ": column '" + shown_text(column) + "' appears twice");
    while (!reader.at_end()) {
        const std::string here = reader.where();
        std::vector<std::string> row = reader.row();
        if (row.size() == 1 && row[0].empty())
            continue;
        if (row.size() != table.columns.size())
            fail(here + ": has " + std::to_string(row.size()) + " fields, the header has " +
                 std::to_string(table.columns.size()));
        table.rows.push_back(std::move(row));
    }
    return table;
}

} // namespace srisp::tool
