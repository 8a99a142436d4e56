// SPDX-License-Identifier: Apache-2.0
#include "rewriter.h"

#include <algorithm>
#include <filesystem>

#include "recipe/frame_pattern.h"

#include "../common/failure.h"
#include "output_depth.h"

namespace srisp::tool {

namespace {

// Options in force must not touch what is handed over: pixels go as they are, and come back at once. (`now`: a later
// round of a loop reuses the name.)
const char kHandOver[] = "-o:datatype=float:bits=0:autocc=0:autotrim=0:dither=0";
const char kTakeBack[] = "-i:now=1:autocc=0:info=0";
// Left to itself oiiotool reads pixels when it comes to them, in one of the threads of a loop of its own, while the
// others wait for it by spinning: that takes the cores away that apply needs.
const char kReadNow[] = "-i:now=1";

class Rewriter {
public:
    explicit Rewriter(const RewriteOptions& options) : m_options(options) {}

    Rewritten run(const std::vector<Step>& steps)
    {
        // oiiotool would record the words that it is given, which hold names of temporary files.
        m_result.words.push_back("--nosoftwareattrib");
        for (const Step& step : steps) {
            if (step.srisp)
                add_ours(step);
            else
                add_theirs(step);
            m_previous = &step;
        }
        return m_result;
    }

private:
    void emit(const std::vector<std::string>& words)
    {
        m_result.words.insert(m_result.words.end(), words.begin(), words.end());
    }

    void add_theirs(const Step& step)
    {
        std::vector<std::string> words = step.words;
        if (step.is_operand())
            note_image(words[0]);
        else
            note_command(step, words);
        emit(words);
    }

    void note_image(const std::string& name)
    {
        m_any_image = true;
        m_image_name = m_wildcards ? frame_pattern_of_image(name) : name;
    }

    void note_command(const Step& step, std::vector<std::string>& words)
    {
        const Role role = step.oiiotool ? step.oiiotool->role : Role::acts;
        m_sticky |= role == Role::sticky;
        m_acted |= role == Role::acts;
        if (role == Role::reads || role == Role::creates)
            note_image(role == Role::reads && words.size() > 1 ? words[1] : "");
        if (step.is_named("evaloff") || step.is_named("evalon"))
            m_evaluates = step.is_named("evalon");
        else if (step.is_named("wildcardoff") || step.is_named("wildcardon"))
            m_wildcards = step.is_named("wildcardon");
        else if (step.is_named("n"))
            m_dry_run = true;
        else if (step.is_named("d"))
            m_depth_given = true;
        else if (step.is_named("label") && words.size() > 1)
            m_labels.push_back(words[1]);
        else if (step.is_named("o") && words.size() > 1 && m_raw && !m_depth_given)
            if (const std::string warning = choose_depth(words); !warning.empty())
                m_result.warnings.push_back(warning);
    }

    void add_ours(const Step& step)
    {
        if (step.srisp->effect == Effect::configures) {
            if (step.is_named("quiet"))
                emit({ "-q" });
            return;
        }
        const std::string command = std::string("--") + step.srisp->name;
        nlohmann::json job = job_of(step);
        if (!m_any_image)
            fail(command + ": no image before it");
        if (!m_options.typed_command.empty())
            job["command"] = m_options.typed_command;
        job["progress"] = m_options.progress;
        job["notes"] = m_options.notes;
        const std::string name = std::to_string(++m_jobs);
        if (step.srisp->effect == Effect::replaces && may_read_directly())
            read_directly(name, std::move(job));
        else if (m_dry_run)
            m_result.warnings.push_back("-n writes nothing, so " + command + " was checked but not run");
        else
            hand_over(name, std::move(job), *step.srisp);
        if (step.srisp->effect == Effect::replaces)
            m_raw = step.srisp->direction == std::string("reverse");
    }

    /// Whether the step before is a file's name and nothing else, which oiiotool would read as the plugin reads it.
    bool may_read_directly() const
    {
        if (!m_previous || m_sticky || m_acted)
            return false;
        const bool named = m_previous->oiiotool && m_previous->oiiotool->role == Role::reads &&
                           m_previous->words.size() == 2 && m_previous->words[0].find(':') == std::string::npos;
        if (!m_previous->is_operand() && !named)
            return false;
        const std::string& name = m_previous->words.back();
        const bool is_label = std::find(m_labels.begin(), m_labels.end(), name) != m_labels.end();
        std::error_code error;
        return !is_label && name.find_first_of("#@%{}?") == std::string::npos &&
               std::filesystem::path(name).extension() != ".srisp" && std::filesystem::is_regular_file(name, error);
    }

    void read_directly(const std::string& name, nlohmann::json recipe)
    {
        recipe["source"] = std::filesystem::absolute(m_previous->words.back()).string();
        m_result.words.back() = m_options.folder + "/" + name + ".srisp";
        if (!m_dry_run) {
            const auto read = m_result.words.end() - 1;
            if (m_previous->is_operand())
                m_result.words.insert(read, kReadNow);
            else
                *(read - 1) = kReadNow;
        }
        m_result.files.push_back({ name + ".srisp", std::move(recipe) });
    }

    void hand_over(const std::string& name, nlohmann::json job, const SrispCommand& command)
    {
        job["action"] = command.action;
        if (!m_image_name.empty())
            job["name"] = m_image_name;
        m_result.files.push_back({ name + ".json", std::move(job) });
        // One name per frame: OpenImageIO caches by name.
        const std::string slot = m_options.folder + "/" + name + ".{FRAME_NUMBER}.srisp";
        if (!m_evaluates)
            emit({ "--evalon" });
        emit({ kHandOver, slot });
        if (command.effect == Effect::replaces)
            emit({ "--pop", kTakeBack, slot });
        if (!m_evaluates)
            emit({ "--evaloff" });
    }

    const RewriteOptions& m_options;
    Rewritten m_result;
    const Step* m_previous = nullptr;
    int m_jobs = 0;
    std::vector<std::string> m_labels;
    bool m_evaluates = true;
    bool m_wildcards = true;
    bool m_sticky = false; ///< something changes how images are read
    bool m_acted = false;  ///< a command may be waiting for the next image, or run conditionally
    bool m_any_image = false;
    std::string m_image_name; ///< of the last image that was read
    bool m_raw = false;       ///< the last of our commands made a RAW-like image
    bool m_depth_given = false;
    bool m_dry_run = false;
};

} // namespace

Rewritten rewrite(const std::vector<Step>& steps, const RewriteOptions& options)
{
    return Rewriter(options).run(steps);
}

} // namespace srisp::tool
