// SPDX-License-Identifier: Apache-2.0
#include <chrono>
#include <cstdio>
#include <string>
#include <thread>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/reference.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "bake.h"
#include "base/recently_kept.h"
#include "config_fragment.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Tells when one of some files was changed, replaced, removed or came back.
class FileWatch {
public:
    FileWatch(std::string reference, std::vector<std::string> others);

    /// True once for each change, when the files were the same for two calls in a row: what is still being written is
    /// waited for.
    bool changed();

private:
    std::string state() const;

    std::string m_reference;
    std::vector<std::string> m_others;
    std::string m_reported, m_last;
};

FileWatch::FileWatch(std::string reference, std::vector<std::string> others)
    : m_reference(std::move(reference)), m_others(std::move(others)), m_reported(state()), m_last(m_reported)
{
}

std::string FileWatch::state() const
{
    std::string text = m_reference.empty() ? "" : reference_state(m_reference) + "\n";
    for (const std::string& path : m_others)
        text += file_state(path) + "\n";
    return text;
}

bool FileWatch::changed()
{
    const std::string now = state();
    const bool steady = now == m_last;
    m_last = now;
    if (!steady || now == m_reported)
        return false;
    m_reported = now;
    return true;
}

constexpr auto kLookEvery = std::chrono::milliseconds(250);

void bake_once(const BakeOptions& options)
{
    const BakeSummary summary = bake(options);
    for (const std::string& note : summary.notes)
        if (!options.quiet)
            std::fprintf(stderr, "srispbake: note: %s\n", note.c_str());
    if (!options.quiet)
        std::fputs((options.json ? summary_json(summary) : summary_text(summary)).c_str(), stdout);
    std::fflush(stdout);
}

/// What fails while watching is said, and watching goes on: files come and go while others work on them.
[[noreturn]] void watch(const BakeOptions& options)
{
    std::vector<std::string> paths;
    for (const std::string& path : { options.source, options.parameters })
        if (!path.empty())
            paths.push_back(path);
    if (const auto model = Model::load(options.model))
        paths.push_back((*model)->path());
    FileWatch files(options.reference, paths);
    for (bool due = true;; due = files.changed()) {
        try {
            if (due)
                bake_once(options);
        } catch (const Failure& failure) {
            std::fprintf(stderr, "srispbake: %s\n", failure.message.c_str());
        }
        check_interrupt();
        std::this_thread::sleep_for(kLookEvery);
        check_interrupt();
    }
}

int run(const BakeOptions& options)
{
    check_options(options);
    if (!options.fragment.empty()) {
        const FragmentReport report = add_fragment(options.fragment, options.output, options.linear_srgb);
        if (!options.quiet)
            std::fputs(fragment_text(report).c_str(), stdout);
        return 0;
    }
    OIIO::attribute("threads", options.threads);
    watch_interrupts();
    if (const std::string warning = name_warning(options.reference); !warning.empty())
        std::fprintf(stderr, "srispbake: %s\n", warning.c_str());
    if (options.watch)
        watch(options);
    bake_once(options);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    return run_tool("srispbake", [&] {
        BakeOptions options;
        CLI::App app;
        describe_options(app, options);
        return parse_options(app, options, "srispbake", kHelp, argc, argv) ? run(options) : 0;
    });
}
