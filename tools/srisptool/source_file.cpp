// SPDX-License-Identifier: Apache-2.0
#include "source_file.h"

#include <filesystem>

#include "recipe/frame_pattern.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;

/// The numbers of the files that are named like a sequence, with the digits that they have there. More than oiiotool
/// takes, which looks at the number of digits, too.
std::vector<std::string> frames_on_disk(const std::string& name, const FrameWildcard& wildcard)
{
    const fs::path folder = fs::path(name).parent_path();
    const std::string prefix = fs::path(name.substr(0, wildcard.begin)).filename();
    const std::string suffix = name.substr(wildcard.begin + wildcard.length);
    std::vector<std::string> frames;
    std::error_code failed;
    for (fs::directory_iterator entry(folder.empty() ? "." : folder, failed), end; !failed && entry != end;
         entry.increment(failed)) {
        const std::string file = entry->path().filename();
        if (file.size() <= prefix.size() + suffix.size() || file.compare(0, prefix.size(), prefix) != 0 ||
            file.compare(file.size() - suffix.size(), suffix.size(), suffix) != 0)
            continue;
        const std::string frame = file.substr(prefix.size(), file.size() - prefix.size() - suffix.size());
        if (frame.find_first_not_of("0123456789", frame[0] == '-' ? 1 : 0) == std::string::npos)
            frames.push_back(frame);
    }
    return frames;
}

} // namespace

std::optional<SourceFile> find_source_file(const std::string& name, const NameRules& rules)
{
    const auto holds = [&](const char* text) { return name.find(text) != std::string::npos; };
    const bool view = rules.wildcards && (holds("%V") || holds("%v"));
    if (view || holds("?") || (rules.expressions && holds("{")) || fs::path(name).extension() == ".srisp")
        return {};
    if (rules.wildcards)
        for (const fs::path& folder : fs::path(name).parent_path())
            if (find_frame_wildcard(folder.string()).length > 0)
                return {};
    SourceFile source;
    source.path = fs::absolute(name).string();
    const FrameWildcard wildcard = rules.wildcards ? find_frame_wildcard(name) : FrameWildcard();
    if (wildcard.length == 0) {
        std::error_code error;
        return fs::is_regular_file(name, error) ? std::optional<SourceFile>(source) : std::nullopt;
    }
    source.path = fs::absolute(frame_pattern_of_image(name)).string();
    source.wildcard = name.substr(wildcard.begin, wildcard.length);
    source.frames = frames_on_disk(name, wildcard);
    const bool known = rules.frames || wildcard.has_range || !source.frames.empty();
    return known ? std::optional<SourceFile>(source) : std::nullopt;
}

} // namespace srisp::tool
