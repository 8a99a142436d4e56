// SPDX-License-Identifier: Apache-2.0
// Tables of comma-separated values.
#include "memory_file.h"
#include "tools/common/csv_table.h"
#include "tools/common/failure.h"

using namespace srisp;

namespace {

std::string quoted(const std::vector<std::string>& fields)
{
    std::string line;
    for (const std::string& field : fields) {
        line += line.empty() ? "\"" : ",\"";
        for (const char c : field)
            line += c == '"' ? std::string("\"\"") : std::string(1, c);
        line += '"';
    }
    return line + "\n";
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    try {
        const tool::CsvTable table = tool::read_csv(file.holding(data, size));
        std::string text = quoted(table.columns);
        for (const auto& row : table.rows) {
            fuzz::must_hold(row.size() == table.columns.size(), "rows are as long as the header");
            text += quoted(row);
        }
        const tool::CsvTable again = tool::read_csv(file.holding(text));
        fuzz::must_hold(again.columns == table.columns && again.rows == table.rows, "a table comes back as it was");
    } catch (const tool::Failure& failure) {
        fuzz::check_message(failure.message);
    }
    return 0;
}
