// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <srisp/expected.h>
#include <srisp/options.h>

namespace srisp {

struct Reference;

/// What is to be done with one image: the contents of a `.srisp` file, of a query, or of a job that srisptool wrote.
/// Which of it each of these may say: option_table.h.
struct Recipe : Options {
    enum class Action {
        apply,
        print,  ///< the parameters that would be applied
        save,   ///< the parameters recorded in the image
        read,   ///< gives the source as it is, its description put right
        sensor, ///< only mosaic and noise: the source is RAW-like already
        develop ///< only development: the source is RAW-like, or a camera's RAW file
    };

    std::string source; ///< path of the photo; empty in a job whose pixels come by hand-over; a frame pattern in
                        ///< one that reads frames
    Direction direction = Direction::reverse;
    std::vector<std::string> references;        ///< files, folders and globs; may be empty where parameters are given
    std::shared_ptr<const Reference> reference; ///< in their place: one that is loaded
    bool lazy = false;     ///< opening reads headers only; metadata lacks parameters that must be selected
    bool hold = false;     ///< the first image's parameters hold for all later ones of this process
    bool progress = false; ///< on stderr, after two seconds
    bool notes = false;    ///< what was assumed or clipped, on stderr
    Action action = Action::apply;
    std::string file;    ///< where `save` writes
    std::string name;    ///< what a handed-over image is called: in print's output and where seed chooses a reference
    std::string command; ///< what the user typed; recorded in the result where srisptool says it
    std::string path;    ///< of the recipe or job itself; key of `hold`
    std::function<bool()> cancelled; ///< asked now and then by the calling thread; true ends what is under way

    /// What decides, with a seed, among references and samples.
    std::string photo_name() const { return std::filesystem::path(source.empty() ? name : source).filename().string(); }
};

/// Reads a recipe (`is_job` false) or job from its JSON text. `path` is where it lies: paths in it are relative to its
/// folder. Errors: not JSON, unknown keys or values (the near ones listed), wrong types, parameters that cannot be
/// read.
Expected<Recipe> recipe_from_json(const std::string& text, const std::string& path, bool is_job);

/// Sets one value from a text, as a query or a configuration hint says it. Paths are relative to the working folder.
Status set_by_text(Recipe& recipe, const std::string& key, const std::string& value);

/// What names a space and no reference develops an image that is RAW-like already.
void take_as_development(Recipe& recipe);

/// Whether parameters can be had at all. `where` names the recipe in the message.
Status check_complete(const Recipe& recipe, const std::string& where);

} // namespace srisp
