// SPDX-License-Identifier: Apache-2.0
#include "batch_run.h"

#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <filesystem>
#include <mutex>
#include <thread>

#include <OpenImageIO/imageio.h>
#include <srisp/model.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/own_location.h"
#include "base/hashes.h"
#include "base/input_files.h"
#include "base/progress.h"
#include "batch_plan.h"
#include "image_task.h"
#include "manifest.h"
#include "memory_gate.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

/// A hash of all that decides the bytes of a result but its photo, reference and seed.
std::string settings_hash(const BatchOptions& options)
{
    const auto model = require(Model::load(options.image.model.empty() ? "default" : options.image.model));
    ordered_json settings = { { "format", format_name(options.format) },
                              { "depth", depth_name(options.depth) },
                              { "mosaic", options.mosaic },
                              { "model", model->hash() },
                              { "image", options.image_settings } };
    if (options.image.parameters)
        settings["parameters"] = to_json(*options.image.parameters, -1);
    const std::string text = settings.dump(-1, ' ', true, ordered_json::error_handler_t::replace);
    return hash_of_bytes(text.data(), text.size());
}

std::string shard_name(const Shard& shard)
{
    return shard.count < 2 ? "all" : std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
}

std::uint64_t memory_limit(const BatchOptions& options)
{
    if (options.memory_gb > 0)
        return std::uint64_t(options.memory_gb * 1e9);
    return std::uint64_t(::sysconf(_SC_PHYS_PAGES)) * std::uint64_t(::sysconf(_SC_PAGE_SIZE)) / 4;
}

/// What making an image takes at most, by its header; 0 where that cannot be read: it will fail.
std::uint64_t memory_for(const std::string& photo)
{
    constexpr std::uint64_t kBytesPerPixel = 48; // codes, floats of bands, the result, its stored form
    std::error_code ignored;
    if (!fs::is_regular_file(photo, ignored))
        return 0;
    // A reader of films takes "pipe:0.mp4" for something else than a file.
    const auto input = OIIO::ImageInput::open(fs::absolute(photo).string());
    if (!input) {
        OIIO::geterror();
        return 0;
    }
    return std::uint64_t(input->spec().image_pixels()) * kBytesPerPixel;
}

/// Whether an error will be that of every photo that follows.
bool is_of_the_disk(const std::string& message)
{
    for (const char* reason : { kDiskFull, "Disk quota exceeded", "Read-only file system" })
        if (message.find(reason) != std::string::npos)
            return true;
    return false;
}

/// The part of a message that other photos' share: without the name.
std::string reason_of(const std::string& message)
{
    const std::size_t name = message.find("': ");
    return name == std::string::npos ? message : message.substr(name + 3, 100);
}

class BatchRun {
public:
    explicit BatchRun(const BatchOptions& options)
        : m_options(options), m_settings(settings_hash(options)), m_manifest(options.output, shard_name(options.shard)),
          m_gate(memory_limit(options))
    {
    }

    BatchSummary run()
    {
        const auto start = std::chrono::steady_clock::now();
        const std::vector<Photo> photos = list_photos(m_options.photos, m_options.match, m_options.output);
        const ReferenceSet references = ReferenceSet::read(m_options.reference);
        if (references.has_pairs() && m_options.pairing_given && m_options.pairing != Pairing::csv)
            fail_usage("the CSV file pairs photos and references itself; --pairing csv, or none");
        if (!references.has_pairs() && m_options.pairing == Pairing::csv)
            fail_usage("--pairing csv needs a CSV file with the columns photo,reference");
        for (BatchTask& task : plan_batch(photos, references, m_options)) {
            ++m_summary.planned;
            m_inputs.add("reference", task.reference);
            if (is_done(task))
                ++m_summary.done_before;
            else
                m_tasks.push_back(std::move(task));
        }
        m_summary.dry = m_options.dry_run;
        if (!m_options.dry_run) {
            make_all();
            m_manifest.write_failed(m_failed);
        }
        m_summary.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (!m_failed.empty())
            m_summary.failed_path = m_manifest.failed_path();
        if (!m_fatal.empty())
            fail(m_fatal);
        check_interrupt();
        return m_summary;
    }

private:
    const ManifestEntry* known(const BatchTask& task) const
    {
        const auto found = m_manifest.entries().find(task.output);
        return found == m_manifest.entries().end() ? nullptr : &found->second;
    }

    /// A stat, unless hashes are asked for.
    bool is_done(const BatchTask& task) const
    {
        const ManifestEntry* const entry = m_options.overwrite ? nullptr : known(task);
        if (!entry)
            return false;
        if (entry->settings != m_settings || entry->reference != task.reference)
            fail("'" + (fs::path(m_options.output) / task.output).string() +
                 "' was made with other settings or another reference; --overwrite makes it anew, and another folder "
                 "keeps "
                 "both");
        std::error_code error;
        const fs::path path = fs::path(m_options.output) / task.output;
        if (fs::file_size(path, error) != entry->bytes || error)
            return false;
        if (!m_options.check)
            return true;
        const auto hash = hash_of_file(path.string());
        return hash && *hash == entry->hash;
    }

    void make_all()
    {
        // Photos at a time fill the processor; each by itself has one thread.
        OIIO::attribute("threads", 1);
        const unsigned wanted =
            m_options.threads > 0 ? unsigned(m_options.threads) : std::thread::hardware_concurrency();
        ProgressMeter meter({ "srispbatch", "photos", m_summary.planned, m_summary.done_before }, !m_options.quiet);
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < std::min<std::size_t>(std::max(wanted, 1u), m_tasks.size()); ++i)
            threads.emplace_back([&] {
                while (const BatchTask* const task = next())
                    make(*task, meter);
            });
        for (std::thread& thread : threads)
            thread.join();
    }

    const BatchTask* next()
    {
        const std::lock_guard lock(m_mutex);
        const bool stops = pending_interrupt() || !m_fatal.empty() || (m_options.fail_fast && !m_failed.empty());
        return stops || m_next == m_tasks.size() ? nullptr : &m_tasks[m_next++];
    }

    void make(const BatchTask& task, ProgressMeter& meter)
    {
        Expected<ordered_json> line = Error{ "" };
        try {
            const MemoryGate::Pass pass(m_gate, memory_for(task.photo.path));
            line = run_task(task, m_options, m_settings, known(task) != nullptr, m_inputs);
            if (line)
                m_manifest.append(*line);
        } catch (const Failure& failure) {
            line = Error{ failure.message };
            const std::lock_guard lock(m_mutex);
            m_fatal = failure.message;
        } catch (const std::exception& error) {
            line = Error{ task.photo.path + ": " + error.what() };
        }
        const std::lock_guard lock(m_mutex);
        if (line) {
            ++m_summary.made;
            m_summary.megapixels += (*line)["width"].get<double>() * (*line)["height"].get<double>() / 1e6;
        } else {
            const std::string& message = line.error().message;
            if (is_of_the_disk(message) && m_fatal.empty())
                m_fatal = message;
            else if (m_fatal.empty())
                take_failure(task, message, meter);
        }
        meter.show(m_summary.made + m_summary.failed);
    }

    void take_failure(const BatchTask& task, const std::string& message, ProgressMeter& meter)
    {
        ++m_summary.failed;
        ++m_summary.reasons[reason_of(message)];
        m_failed.push_back({ { "output", task.output },
                             { "photo", task.photo.name },
                             { "photo_path", task.photo.path },
                             { "reference", task.reference },
                             { "copy", task.copy },
                             { "error", message } });
        if (!m_options.quiet) {
            meter.wipe();
            std::fprintf(stderr, "srispbatch: %s\n", message.c_str());
        }
    }

    const BatchOptions& m_options;
    const std::string m_settings;
    Manifest m_manifest;
    MemoryGate m_gate;
    InputFiles m_inputs; ///< that no result may be written onto
    std::vector<BatchTask> m_tasks;
    std::mutex m_mutex; ///< of what follows
    std::size_t m_next = 0;
    BatchSummary m_summary;
    std::vector<ordered_json> m_failed;
    std::string m_fatal; ///< what ends the run
};

} // namespace

BatchSummary run_batch(const BatchOptions& options)
{
    // The writer of DNG files is a plugin.
    if (options.format == OutputFormat::dng)
        OIIO::attribute("plugin_searchpath", plugin_folder().string());
    return BatchRun(options).run();
}

BatchSummary verify_batch(const std::string& folder)
{
    const Manifest manifest(folder, "all");
    if (manifest.entries().empty())
        fail("folder '" + folder + "' has no manifest of srispbatch's");
    BatchSummary summary;
    ProgressMeter meter({ "srispbatch", "results compared", std::int64_t(manifest.entries().size()) }, true);
    for (const auto& [name, entry] : manifest.entries()) {
        check_interrupt();
        ++summary.planned;
        const std::string path = (fs::path(folder) / name).string();
        const auto hash = hash_of_file(path);
        if (hash && *hash == entry.hash) {
            ++summary.done_before;
        } else {
            ++summary.failed;
            meter.wipe();
            std::fprintf(stderr, "srispbatch: '%s' %s\n", path.c_str(),
                         hash ? "has not the bytes that the manifest names" : "is missing or cannot be read");
        }
        meter.show(summary.planned);
    }
    return summary;
}

std::string summary_text(const BatchSummary& summary)
{
    std::string text = std::to_string(summary.planned) + " results: " + std::to_string(summary.made) + " made, " +
                       std::to_string(summary.done_before) + " done before, " + std::to_string(summary.failed) +
                       " failed";
    if (summary.dry)
        text = std::to_string(summary.planned) + " results, of which " + std::to_string(summary.done_before) +
               " are done; nothing was made";
    if (summary.made && summary.seconds > 0) {
        char rate[80];
        std::snprintf(rate, sizeof rate, "; %.1f a second, %.1f Mpx/s", double(summary.made) / summary.seconds,
                      summary.megapixels / summary.seconds);
        text += rate;
    }
    text += "\n";
    for (const auto& [reason, count] : summary.reasons)
        text += "  " + std::to_string(count) + " × " + reason + "\n";
    if (!summary.failed_path.empty())
        text += "  listed in " + summary.failed_path + "; the same command tries them again\n";
    return text;
}

std::string summary_json(const BatchSummary& summary)
{
    const ordered_json object = { { "results", summary.planned },         { "made", summary.made },
                                  { "done_before", summary.done_before }, { "failed", summary.failed },
                                  { "reasons", summary.reasons },         { "failed_list", summary.failed_path },
                                  { "seconds", summary.seconds },         { "megapixels", summary.megapixels } };
    return object.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

} // namespace srisp::tool
