// SPDX-License-Identifier: Apache-2.0
#include "messages.h"

#include <algorithm>
#include <climits>
#include <cstring>
#include <filesystem>
#include <regex>
#include <utility>

#include "recipe/frame_pattern.h"

#include "output_guard.h"

namespace srisp::tool {

namespace {

const std::string kError = "oiiotool ERROR", kWarning = "oiiotool WARNING";
const char kRepeats[] = "Full command line was:";
const char kNothingToWrite[] = "did not have any current image to output";
const std::string kOurWriter = kError + ": -o:datatype=float:bits=0:autocc=0"; // as the rewriter writes it
const std::string kJpegError = "Output file write error";
const std::string kNote = "srisp: note: ";
const std::string kMissing = kError + ": read : File does not exist: ";

bool begins_with(const std::string& text, const std::string& beginning)
{
    return text.compare(0, beginning.size(), beginning) == 0;
}

bool contains(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

void replace_all(std::string& text, const std::string& from, const std::string& to)
{
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

/// A folder is literal, whatever it holds.
std::string frame_of(const std::string& pattern, const std::string& frame)
{
    std::filesystem::path file = pattern;
    file.replace_filename(with_frame(file.filename().string(), frame));
    return file.string();
}

std::string typed_name(const Subject& subject, const std::string& frame)
{
    return subject.sequence && !frame.empty() ? frame_of(frame_pattern_of_image(subject.image), frame) : subject.image;
}

/// All before the last part of a path.
std::string folder_of(const std::string& path)
{
    return path.substr(0, path.rfind('/') + 1);
}

/// What the user takes the image for.
std::string kind_of(const Subject& subject)
{
    return subject.command == "--srisp-unprocess" || subject.command == "--srisp-params" ? "photo" : "image";
}

std::string named(const Subject& subject, const std::string& frame)
{
    return subject.image.empty() ? "image" : kind_of(subject) + " '" + typed_name(subject, frame) + "'";
}

/// Takes the beginning off, if it is there.
bool take_off(std::string& text, const std::string& beginning)
{
    const bool there = !beginning.empty() && begins_with(text, beginning);
    if (there)
        text.erase(0, beginning.size());
    return there;
}

/// A reason that says itself which file is meant: "reference 'a.dng': …".
bool names_a_file(const std::string& reason)
{
    const std::size_t kind = reason.find_first_not_of("abcdefghijklmnopqrstuvwxyz ");
    return kind != std::string::npos && kind > 1 && reason[kind] == '\'' && reason[kind - 1] == ' ' && reason[0] != ' ';
}

/// The reason why an image was refused, behind its name as the user typed it.
std::string reason_for(const Subject& subject, const std::string& frame, std::string reason)
{
    const std::string typed = typed_name(subject, frame);
    const std::string path = subject.sequence && !subject.path.empty() ? frame_of(subject.path, frame) : subject.path;
    for (const std::string& own : { path, typed }) {
        if (own.empty())
            continue;
        const bool image = take_off(reason, own + ": ") || take_off(reason, "photo '" + own + "'") ||
                           take_off(reason, "image '" + own + "'");
        if (!image)
            continue;
        take_off(reason, ": ");
        // Readers begin with the name, too.
        if (take_off(reason, '"' + own + '"') || take_off(reason, "'" + own + "'") || take_off(reason, own)) {
            take_off(reason, ":");
            take_off(reason, " ");
        }
        replace_all(reason, path.empty() ? own : path, typed);
        return named(subject, frame) + ": " + reason;
    }
    return names_a_file(reason) ? reason : named(subject, frame) + ": " + reason;
}

/// oiiotool's error for an output, or libjpeg's.
bool is_failed_output(const std::string& line)
{
    return (begins_with(line, kError + ": -o") && !begins_with(line, kOurWriter)) || begins_with(line, kJpegError);
}

/// Whether oiiotool tells of a hand-over file of ours that could not be written; `end`: behind its name.
bool is_failed_hand_over(const std::string& text, std::size_t end)
{
    return begins_with(text, kOurWriter) &&
           (text.compare(end, 12, "' cannot be ") == 0 || contains(text, "could not move temp file"));
}

} // namespace

std::string Messages::take(std::string_view bytes)
{
    std::string text;
    for (const char c : bytes) {
        if (c != '\n') {
            m_line += c;
            continue;
        }
        text += shown(m_line);
        m_line.clear();
    }
    return text;
}

std::string Messages::finish()
{
    const std::string text = m_line.empty() ? "" : shown(m_line);
    m_line.clear();
    return text + release_warning() + std::exchange(m_failed_write, "");
}

void Messages::take_failed_write(const std::string& text)
{
    const std::size_t end = std::min(text.find(": "), text.size());
    std::string path = with_own_names(text.substr(std::min(end + 2, text.size())));
    std::error_code error;
    take_off(path, (std::filesystem::current_path(error) / "").string());
    m_failed_write = "srisptool: ERROR: output '" + path + "' cannot be written: " + text.substr(0, end) + "\n";
}

std::string Messages::release_warning()
{
    m_held_for = nullptr;
    return std::exchange(m_held, "");
}

std::string Messages::shown(const std::string& line)
{
    if (m_to_skip > 0) {
        m_to_skip = line == "> " ? 0 : m_to_skip - 1; // oiiotool may not know its command line
        return "";
    }
    if (line == kRepeats) {
        m_to_skip = m_lines;
        return "";
    }
    if (begins_with(line, kGuardFailure)) {
        take_failed_write(line.substr(std::strlen(kGuardFailure)));
        return "";
    }
    if ((m_failure_told || !m_failed_write.empty()) && is_failed_output(line)) {
        m_failure_told = true;
        return release_warning() + std::exchange(m_failed_write, "");
    }
    const auto name = find_name(line);
    if (name && begins_with(line, kWarning) && contains(line, kNothingToWrite)) {
        const std::string before = release_warning();
        m_held = "srisptool: WARNING: " + name->subject->command + ": no image before it\n";
        m_held_for = name->subject;
        return before;
    }
    if (name && name->subject == m_held_for)
        m_held.clear(); // the error says it
    const std::string before = release_warning();
    return before + (begins_with(line, kError) ? error(line, name) : with_own_names(line)) + "\n";
}

std::string Messages::error(const std::string& text, const std::optional<Name>& name) const
{
    const std::string ours = "srisptool: ERROR: ";
    if (!name) {
        if (begins_with(text, kMissing)) {
            std::string file = text.substr(kMissing.size());
            std::replace(file.begin(), file.end(), '"', '\'');
            return ours + "image " + file + " does not exist";
        }
        // Our writer's, whose name is not in it; the reason says which image is meant.
        if (!begins_with(text, kOurWriter))
            return with_own_names(text);
        const std::string reason = text.substr(text.find(" : ") + 3);
        for (const auto& [number, subject] : m_subjects)
            if (!subject.image.empty() && begins_with(reason, subject.image + ": "))
                return ours + reason_for(subject, "", reason);
        return ours + reason;
    }
    if (is_failed_hand_over(text, name->end))
        return ours + "a temporary file cannot be written: " + text.substr(text.rfind(": ") + 2) +
               " (TMPDIR may name another folder)";
    const Subject& subject = *name->subject;
    if (begins_with(text, kMissing))
        return ours + (subject.path.empty() ? subject.command + ": no image before it"
                                            : named(subject, name->frame) + " does not exist");
    std::string reason = text.substr(name->end); // behind `read : "name`
    take_off(reason, "\"");
    return take_off(reason, ": ") ? ours + reason_for(subject, name->frame, reason) : with_own_names(text);
}

std::optional<Messages::Name> Messages::find_name(const std::string& text) const
{
    static const std::regex name("([0-9]+)(?:\\.([^ \"/]*?))?\\.(?:srisp|json)");
    for (std::size_t at = 0; (at = text.find(m_folder + "/", at)) != std::string::npos; ++at) {
        std::smatch match;
        const std::size_t start = at + m_folder.size() + 1;
        const auto begin = text.begin() + static_cast<std::ptrdiff_t>(start);
        // Ours are short, and std::regex calls itself for every character.
        const auto end = begin + static_cast<std::ptrdiff_t>(std::min<std::size_t>(text.size() - start, NAME_MAX));
        if (!std::regex_search(begin, end, match, name, std::regex_constants::match_continuous))
            continue;
        const auto found = m_subjects.find(match.str(1));
        if (found == m_subjects.end())
            continue;
        const bool number = match.str(2).find_first_not_of("-0123456789") == std::string::npos;
        return Name{ at, std::size_t(match[0].second - text.begin()), &found->second, number ? match.str(2) : "" };
    }
    return {};
}

std::string Messages::with_own_names(std::string text) const
{
    for (auto name = find_name(text); name; name = find_name(text)) {
        const std::string own = typed_name(*name->subject, name->frame);
        text.replace(name->begin, name->end - name->begin, own.empty() ? "image" : own);
    }
    // The plugin's notes begin with an image's path, or with "photo 'path'".
    if (begins_with(text, kNote)) {
        std::size_t start = kNote.size();
        for (const std::string kind : { "photo '", "image '" })
            if (text.compare(start, kind.size(), kind) == 0)
                start += kind.size();
        const std::string folder = folder_of(text.substr(start, text.find(": ", start) - start));
        for (const auto& [number, subject] : m_subjects)
            if (!folder.empty() && folder == folder_of(subject.path)) {
                text.replace(start, folder.size(), folder_of(subject.image));
                break;
            }
    }
    replace_all(text, m_folder, "(temporary folder)");
    // oiiotool writes to `x.01234567.temp.exr` first.
    static const std::regex unfinished("\\.[0-9A-Fa-f]{8}\\.temp(?=\\.)");
    return std::regex_replace(text, unfinished, "");
}

} // namespace srisp::tool
