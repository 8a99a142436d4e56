// SPDX-License-Identifier: Apache-2.0
#include "result/kept_results.h"

#include <cstdio>

namespace srisp {

Expected<std::shared_ptr<const Model>> KeptResults::load_model(const std::string& name)
{
    if (const auto path = m_model_paths.find(name))
        if (const auto model = m_models.find(file_state(*path)))
            return model;
    auto model = Model::load(name);
    if (!model)
        return model;
    m_model_paths.keep(name, std::make_shared<const std::string>((*model)->path()));
    return m_models.keep(file_state((*model)->path()), *model);
}

void KeptResults::print_notes(const std::string& image, const std::vector<std::string>& notes)
{
    constexpr std::size_t kMostRemembered = 10000;
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_printed_notes.size() > kMostRemembered)
        m_printed_notes.clear();
    for (const std::string& note : notes) {
        const std::string line = "srisp: note: " + image + ": " + note + "\n";
        if (m_printed_notes.insert(line).second)
            std::fputs(line.c_str(), stderr);
    }
}

} // namespace srisp
