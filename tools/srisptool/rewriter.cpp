// SPDX-License-Identifier: Apache-2.0
#include "rewriter.h"

#include <algorithm>
#include <optional>

#include "recipe/frame_pattern.h"

#include "../common/failure.h"
#include "orientation_words.h"
#include "output_depth.h"
#include "source_file.h"

namespace srisp::tool {

namespace {

// Options in force must not touch what is handed over: pixels go as they are, and come back at once. (`now`: a later
// round of a loop reuses the name.)
const char kHandOver[] = "-o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0";
const char kTakeBack[] = "-i:now=1:autocc=0:info=0";
// Left to itself oiiotool reads pixels when it comes to them, in one of the threads of a loop of its own, while the
// others wait for it by spinning: that takes the cores away that apply needs. And what it reads so it keeps to its end.
const char kReadNow[] = "-i:now=1", kNow[] = ":now=1";

// Takes the place of the user's name where that was printed, and is not printed again.
const char kReadQuietly[] = ":now=1:autocc=0:info=0";

/// Whether a step prints names of images on the stack, or may: there the user's own have to be.
bool prints_names(const Step& step)
{
    for (const char* name : { "printinfo", "printstats", "diff", "pdiff" })
        if (step.is_named(name))
            return true;
    return std::any_of(step.words.begin(), step.words.end(), [](const std::string& word) {
        return word.find('{') != std::string::npos && word.find(".file") != std::string::npos;
    });
}

class Rewriter {
public:
    Rewriter(const std::vector<Step>& steps, const RewriteOptions& options)
        : m_steps(steps), m_options(options), m_end_of_reading(end_of_reading(steps)),
          m_own_names(std::any_of(steps.begin(), steps.end(), prints_names))
    {
        m_rules.frames = contains(steps, "frames");
        m_theirs_only = contains(steps, "framepadding");
    }

    Rewritten run()
    {
        // oiiotool would record the words that it is given, which hold names of temporary files.
        m_result.words.push_back("--nosoftwareattrib");
        for (std::size_t i = 0; i < m_steps.size(); ++i) {
            const Step& step = m_steps[i];
            end_output(step);
            if (step.srisp)
                i = add_ours(i);
            else if (!name_read_by(step).empty())
                add_image(step, i);
            else
                add_theirs(step);
        }
        return m_result;
    }

private:
    void emit(const std::vector<std::string>& words)
    {
        m_result.words.insert(m_result.words.end(), words.begin(), words.end());
    }

    void note_image(const std::string& name)
    {
        m_any_image = true;
        m_typed_name = name;
        m_image_name = m_rules.wildcards ? frame_pattern_of_image(name) : name;
    }

    void add_theirs(const Step& step)
    {
        std::vector<std::string> words = step.words;
        if (step.oiiotool && int(words.size()) <= step.oiiotool->arguments)
            fail_usage(words[0] + " lacks an argument"); // oiiotool would print its help, too
        const Role role = step.oiiotool ? step.oiiotool->role : Role::acts;
        m_changes_reading |= role == Role::sticky;
        m_acted |= role == Role::acts;
        if (role == Role::reads || role == Role::creates)
            note_image("");
        for (const char* name : { "info", "stats", "dumpdata", "hash" })
            m_prints |= step.is_named(name);
        if (step.is_named("evaloff") || step.is_named("evalon"))
            m_rules.expressions = step.is_named("evalon");
        else if (step.is_named("wildcardoff") || step.is_named("wildcardon"))
            m_rules.wildcards = step.is_named("wildcardon");
        else if (step.is_named("autocc") || step.is_named("noautocc"))
            m_converts = step.is_named("autocc");
        else if (step.is_named("native") || step.is_named("missingfile"))
            m_theirs_only = true;
        else if (step.is_named("iconfig"))
            m_hints = true;
        else if (step.is_named("n"))
            m_dry_run = true;
        else if (step.is_named("d") && words.size() > 1)
            m_depth = words[1];
        else if (step.is_named("label") && words.size() > 1)
            m_labels.push_back(words[1]);
        else if (writes_dng(step))
            return write_dng(std::move(words));
        else if (step.is_named("o") && words.size() > 1 && m_raw && m_depth.empty())
            if (const std::string warning = choose_depth(words); !warning.empty())
                m_result.warnings.push_back(warning);
        if ((step.is_named("autoorient") || step.is_named("auto-orient")) && !m_acted)
            m_orients = true; // each image by itself
        else if (step.is_named("reorient") && m_any_image)
            turn_upright();
        else if (step.is_named("o") && m_any_image && output_format(words) == "png")
            write_oriented(words);
        else if (step.is_named("o") && m_any_image && m_options.notes && !m_dry_run &&
                 !holds_orientation(output_format(words)))
            write_turned(words);
        else
            emit(words);
    }

    /// Words that hold expressions of ours.
    void emit_evaluated(const std::vector<std::string>& words)
    {
        if (!m_rules.expressions)
            emit({ "--evalon" });
        emit(words);
        if (!m_rules.expressions)
            emit({ "--evaloff" });
    }

    void turn_upright()
    {
        emit(orientation::ensure());
        emit_evaluated(orientation::turn_upright());
    }

    /// A PNG file, whose writer knows no orientation.
    void write_oriented(const std::vector<std::string>& words)
    {
        emit(orientation::ensure());
        emit_evaluated(orientation::mark_for_png());
        emit(words);
        m_after_output = orientation::unmark();
    }

    /// Its options are attributes of the image, for as long as it is written.
    void write_dng(std::vector<std::string> words)
    {
        m_after_output = {};
        Modifiers attributes = take_dng_options(words, m_depth);
        if (!m_options.notes)
            attributes.emplace_back("dng:quiet", "1");
        for (const auto& [name, value] : attributes) {
            emit({ "--attrib:type=string", name, value });
            m_after_output.insert(m_after_output.end(), { "--eraseattrib", name });
        }
        emit(words);
    }

    /// A file that cannot say how it is to be turned. Only oiiotool knows whether that is lost: it leaves a mark.
    void write_turned(const std::vector<std::string>& words)
    {
        const std::string mark = std::to_string(++m_jobs) + ".turned.pgm";
        m_result.notes[mark] = "'" + words[1] +
                               "' cannot hold an orientation, so the picture lies there as the camera stored it; "
                               "--autoorient before the photo or --reorient before -o turns it";
        emit(orientation::ensure());
        emit_evaluated(orientation::tell_turned(m_options.folder + "/" + mark));
        emit(words);
    }

    /// Not at once: oiiotool warns of a change behind the last output.
    void end_output(const Step& next)
    {
        if (next.oiiotool && next.oiiotool->role == Role::plain)
            return;
        emit(m_after_output);
        m_after_output.clear();
    }

    void add_image(const Step& step, std::size_t i)
    {
        const std::string name = name_read_by(step);
        note_image(name);
        if (m_orients && m_acted) { // a command may wait for the image, so nothing may come between
            emit({ "--autoorient" });
            m_orients = false;
        }
        const bool is_label = std::find(m_labels.begin(), m_labels.end(), name) != m_labels.end();
        const auto source = is_label || m_theirs_only ? std::nullopt : find_source_file(name, m_rules);
        const bool before_ours =
            i + 1 < m_steps.size() && m_steps[i + 1].srisp && m_steps[i + 1].srisp->effect == Effect::replaces;
        const bool plain = step.is_operand() || step.words[0].find(':') == std::string::npos;
        if (source && before_ours && plain && !m_changes_reading && !m_acted)
            m_direct = source; // our command reads it
        else if (source && i < m_end_of_reading && !m_own_names && !m_converts &&
                 !has_modifier(step.words[0], "autocc"))
            read_as_stored(step, *source);
        else
            emit(step.words);
        if (m_orients && !is_label)
            turn_upright();
        m_hints = false;
    }

    void read_as_stored(const Step& step, const SourceFile& source)
    {
        const bool prints = m_prints || has_modifier(step.words[0], "info");
        // The user's name on the stack for a moment could set off a command that waits for an image.
        if (prints && (m_acted || m_hints)) {
            emit(step.words);
            return;
        }
        nlohmann::json recipe = { { "format", "srisp-recipe-1" }, { "action", "read" }, { "notes", m_options.notes } };
        const std::string word = add_recipe(source, std::move(recipe), "");
        if (prints) {
            emit(step.words);
            emit({ (step.is_operand() ? "-i" : step.words[0]) + kReadQuietly, word, "--swap", "--pop" });
        } else {
            std::vector<std::string> words = step.words;
            words.back() = word;
            if (!m_dry_run && step.is_operand())
                words.insert(words.begin(), kReadNow);
            else if (!m_dry_run && words[0].find(kNow) == std::string::npos)
                words[0] += kNow;
            emit(words);
        }
    }

    /// Adds the files for the reading of a source; returns the name that stands for it.
    std::string add_recipe(const SourceFile& source, nlohmann::json recipe, const std::string& command)
    {
        const std::string number = std::to_string(++m_jobs);
        m_result.subjects[number] = { m_typed_name, source.path, command, !source.wildcard.empty() };
        recipe["source"] = source.path;
        if (m_options.allow_partial)
            recipe["allow_partial"] = true;
        const std::string name = m_options.folder + "/" + number;
        if (source.wildcard.empty()) {
            m_result.files.push_back({ number + ".srisp", std::move(recipe) });
            return name + ".srisp";
        }
        m_result.files.push_back({ number + ".json", std::move(recipe) });
        // For oiiotool to find, as it would have found the user's files. It tells why one cannot be read only of a name
        // that is on disk.
        for (const std::string& frame : source.frames)
            m_result.files.push_back({ number + "." + frame + ".srisp", { { "format", "srisp-slot-1" } } });
        return name + "." + source.wildcard + ".srisp";
    }

    /// Returns the number of the last step that was taken.
    std::size_t add_ours(std::size_t i)
    {
        const Step& step = m_steps[i];
        if (step.srisp->effect == Effect::configures) {
            if (step.is_named("quiet"))
                emit({ "-q" });
            return i;
        }
        const std::string command = std::string("--") + step.srisp->name;
        nlohmann::json job = job_of(step);
        const std::size_t last = step.srisp->effect == Effect::replaces ? join_following_steps(i, job) : i;
        if (!m_any_image)
            fail(command + ": no image before it");
        if (!m_options.typed_command.empty())
            job["command"] = m_options.typed_command;
        job["progress"] = m_options.progress;
        job["notes"] = m_options.notes;
        if (m_direct)
            read_directly(std::move(job), command);
        else if (m_dry_run)
            m_result.warnings.push_back("-n writes nothing, so " + command + " was checked but not run");
        else
            hand_over(std::move(job), *step.srisp);
        if (step.srisp->effect == Effect::replaces)
            m_raw = step.srisp->direction == std::string("reverse");
        return last;
    }

    /// Lets a job take in the steps for a sensor, and the development, that follow its own, and says what these need to
    /// know of the line. Returns the number of the last one.
    std::size_t join_following_steps(std::size_t i, nlohmann::json& job)
    {
        const bool reverse = job["direction"] == "reverse";
        for (const std::string next : { "srisp-mosaic", "srisp-noise", "srisp-develop" }) {
            const bool follows = reverse && i + 1 < m_steps.size() && m_steps[i + 1].is_named(next);
            const bool is_done = job.contains("develop") || (job.contains("noise") && next != "srisp-develop");
            if (!follows || is_done)
                continue;
            nlohmann::json other = job_of(m_steps[++i]);
            other.erase("action");
            job.update(other);
        }
        if (job.contains("mosaic") && !job.contains("levels") && writes_integers(m_steps, i + 1))
            job["levels"] = "camera";
        if (job.contains("reference"))
            m_reference = { { "reference", job["reference"] }, { "seed", job.value("seed", 0) } };
        else if (job.contains("noise"))
            job.update(m_reference); // it may be estimated
        return i;
    }

    void read_directly(nlohmann::json recipe, const std::string& command)
    {
        const std::string word = add_recipe(*m_direct, std::move(recipe), command);
        m_direct.reset();
        if (!m_dry_run)
            emit({ kReadNow });
        emit({ word });
    }

    void hand_over(nlohmann::json job, const SrispCommand& command)
    {
        const std::string number = std::to_string(++m_jobs);
        m_result.subjects[number] = { m_typed_name, "", std::string("--") + command.name,
                                      m_image_name != m_typed_name };
        job["action"] = command.action;
        if (!m_image_name.empty())
            job["name"] = m_image_name;
        m_result.files.push_back({ number + ".json", std::move(job) });
        // One name per frame: OpenImageIO caches by name.
        const std::string slot = m_options.folder + "/" + number + ".{FRAME_NUMBER}.srisp";
        if (command.effect == Effect::replaces)
            emit_evaluated({ kHandOver, slot, "--pop", kTakeBack, slot });
        else
            emit_evaluated({ kHandOver, slot });
    }

    const std::vector<Step>& m_steps;
    const RewriteOptions& m_options;
    const std::size_t m_end_of_reading;
    const bool m_own_names;
    Rewritten m_result;
    int m_jobs = 0;
    std::vector<std::string> m_labels;
    NameRules m_rules;
    bool m_changes_reading = false; ///< something changes how images are read
    bool m_converts = false;        ///< it is --autocc
    bool m_prints = false;          ///< something is printed of each image that is read
    bool m_theirs_only = false;     ///< what is in force only oiiotool's reading knows
    bool m_hints = false;           ///< for the next image's reader
    bool m_orients = false;         ///< --autoorient, which is done by commands of ours
    bool m_acted = false;           ///< a command may be waiting for the next image, or run conditionally
    bool m_any_image = false;
    std::string m_typed_name;                ///< of the last image that was read
    std::string m_image_name;                ///< the same, a frame pattern as printf has it
    std::optional<SourceFile> m_direct;      ///< is to be read by our command, which is next
    bool m_raw = false;                      ///< the last of our commands made a RAW-like image
    std::string m_depth;                     ///< of `-d`; "": not given
    std::vector<std::string> m_after_output; ///< words that take from the image on top what only the output needed
    bool m_dry_run = false;
    nlohmann::json m_reference = nlohmann::json::object(); ///< of the last --srisp-unprocess, and its seed
};

} // namespace

Rewritten rewrite(const std::vector<Step>& steps, const RewriteOptions& options)
{
    return Rewriter(steps, options).run();
}

} // namespace srisp::tool
