// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace srisp::tool {

/// What a name in the temporary folder stands for.
struct Subject {
    std::string image;     ///< as typed; "": it has no name
    std::string path;      ///< absolute, a frame pattern as printf has it; "": pixels come by hand-over
    std::string command;   ///< the user's; "": the image is only read
    bool sequence = false; ///< `image` has a frame wildcard
};
using Subjects = std::map<std::string, Subject>; ///< by the number that names in the folder begin with

/// What oiiotool and the plugin in it write to stderr, as the user of srisptool should read it: of each error one line,
/// with the names that the user typed, and without the command line that srisptool made.
class Messages {
public:
    /// `folder`: the temporary one. `lines`: of the command line that srisptool made, since oiiotool repeats it.
    Messages(std::string folder, Subjects subjects, int lines)
        : m_folder(std::move(folder)), m_subjects(std::move(subjects)), m_lines(lines)
    {
    }

    /// What is to be shown of all whole lines so far.
    std::string take(std::string_view bytes);
    /// The rest.
    std::string finish();

private:
    /// A name in the temporary folder that a line holds.
    struct Name {
        std::size_t begin = 0, end = 0;
        const Subject* subject = nullptr; ///< never null
        std::string frame;                ///< "": it has none
    };

    std::string shown(const std::string& line);
    void take_failed_write(const std::string& text);
    std::string release_warning();
    std::string error(const std::string& text, const std::optional<Name>& name) const;
    std::optional<Name> find_name(const std::string& text) const;
    std::string with_own_names(std::string text) const;

    const std::string m_folder;
    const Subjects m_subjects;
    const int m_lines;
    std::string m_line; ///< not yet whole
    int m_to_skip = 0;  ///< lines of the repeated command line
    std::string m_held; ///< a warning that may turn out to announce an error
    const Subject* m_held_for = nullptr;
    std::string m_failed_write; ///< the error for an output that could not be written
    bool m_failure_told = false;
};

} // namespace srisp::tool
