// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/model.h>
#include <srisp/noise.h>
#include <srisp/parameters.h>
#include <srisp/select.h>

#include "base/recently_kept.h"

namespace srisp {

struct Choice;

/// What is kept of one image for later ones: hosts open a file several times, and the frames of a shot share a model.
/// Threads: any number may use one.
class KeptResults {
public:
    /// Model::load, once per file as it is.
    Expected<std::shared_ptr<const Model>> load_model(const std::string& name);

    /// The model that parameters name: the one of that name in the known folders whose hash it is. The name may be a
    /// stranger's, from an image's metadata or a file of parameters, so it is never a path. The error says which model
    /// it was, and that model=FILE gives it.
    Expected<std::shared_ptr<const Model>> find_model_of(const Parameters& parameters);

    /// Prints `srisp: note: image: text` on stderr, each once.
    void print_notes(const std::string& image, const std::vector<std::string>& notes);

    RecentlyKept<std::shared_ptr<const Choice>> choices{ 64 };
    RecentlyKept<std::shared_ptr<const NoiseModel>> noises{ 64 };
    /// By the hashes of reference and model; 0.3 MB each.
    RecentlyKept<std::shared_ptr<const PreparedReference>> references{ 256 };
    /// By recipe and subimage: the first choice of a recipe that says `hold`.
    RecentlyKept<std::shared_ptr<const Choice>> held_choices{ 1 << 20 };

private:
    static constexpr std::size_t kMostModels = 8;

    RecentlyKept<std::shared_ptr<const Model>> m_models{ kMostModels };
    RecentlyKept<std::shared_ptr<const std::string>> m_model_paths{ kMostModels };
    std::mutex m_mutex; ///< of the notes
    std::set<std::string> m_printed_notes;
};

} // namespace srisp
