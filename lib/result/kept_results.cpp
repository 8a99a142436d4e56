// SPDX-License-Identifier: Apache-2.0
#include "result/kept_results.h"

#include <cstdio>

#include "base/shown_text.h"
#include "model/model_files.h"

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

Expected<std::shared_ptr<const Model>> KeptResults::find_model_of(const Parameters& parameters)
{
    const std::string sought = "parameters were chosen with model '" + shown_text(parameters.model_name) + "' (" +
                               shown_text(parameters.model_hash) + "), ";
    std::string found;
    for (const std::string& file : model_files_named(parameters.model_name)) {
        const auto model = load_model(file);
        if (model && (*model)->hash() == parameters.model_hash)
            return model;
        found +=
            (found.empty() ? "but " : ", ") + (model ? "'" + file + "' is " + (*model)->hash() : model.error().message);
    }
    if (found.empty())
        found = "which is not among the models known here (" + model_folder_list() + ")";
    return Error{ sought + found + "; model=FILE gives it" };
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
