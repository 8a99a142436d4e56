// SPDX-License-Identifier: Apache-2.0
// Scores as JSON, and the journal of an evaluation; the first byte says which.
#include "memory_file.h"
#include "tools/common/failure.h"
#include "tools/srispeval/journal.h"
#include "tools/srispeval/score_json.h"

using namespace srisp;

namespace {

void check_evaluation(const std::string& path)
{
    const auto evaluation = tool::read_evaluation(path);
    if (!fuzz::is_accepted(evaluation))
        return;
    for (const tool::ImageScore& image : evaluation->images) {
        const nlohmann::json once(tool::to_json(image));
        const auto again = tool::image_score_from_json(once);
        fuzz::must_hold(bool(again), "what was written can be read", again ? "" : again.error().message);
    }
}

void check_journal(const std::string& path)
{
    const tool::Journal journal(path, "settings");
    for (const auto& entry : journal.entries()) {
        journal.pictures(entry);
        journal.lab(entry);
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static fuzz::MemoryFile file;
    if (size == 0)
        return 0;
    const std::string& path = file.holding(data + 1, size - 1);
    try {
        if (data[0] == 'j')
            check_journal(path);
        else
            check_evaluation(path);
    } catch (const tool::Failure& failure) {
        fuzz::check_message(failure.message);
    }
    return 0;
}
