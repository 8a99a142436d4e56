// SPDX-License-Identifier: Apache-2.0
#include "batch_run.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <thread>

#include <OpenImageIO/imageio.h>
#include <srisp/reference.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/own_location.h"
#include "base/hashes.h"
#include "base/input_files.h"
#include "batch_report.h"
#include "file_copies.h"
#include "image_maker.h"
#include "manifest.h"
#include "settings.h"

namespace srisp::tool {

namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

std::string shard_name(const Shard& shard)
{
    return shard.count < 2 ? "all" : std::to_string(shard.index) + "-of-" + std::to_string(shard.count);
}

/// Whether an error will be that of every photo that follows.
bool is_of_the_disk(const std::string& message)
{
    for (const char* reason : { kDiskFull, "Disk quota exceeded", "Read-only file system" })
        if (message.find(reason) != std::string::npos)
            return true;
    return false;
}

/// The part of a message that other photos' share: what follows the file's name.
std::string reason_of(const std::string& message)
{
    constexpr std::size_t kLongest = 100;
    const std::size_t name = message.find('\''), end = message.find('\'', name + 1);
    if (name == std::string::npos || end == std::string::npos)
        return message.substr(0, kLongest);
    const std::size_t reason = message.find_first_not_of(": ", end + 1);
    return message.substr(std::min(reason, message.size()), kLongest);
}

/// What the set is to have, checked.
BatchPlan plan_of(const BatchOptions& options, std::int64_t& photo_count)
{
    const std::vector<ListedFile> photos = list_files(options.photos, photo_files(), options.match, options.output);
    photo_count = std::int64_t(photos.size());
    const ReferenceSet references = ReferenceSet::read(options.reference);
    if (references.has_pairs() && options.pairing_given && options.pairing != Pairing::csv)
        fail_usage("the CSV file pairs photos and references itself; --pairing csv, or none");
    if (!references.has_pairs() && options.pairing == Pairing::csv)
        fail_usage("--pairing csv needs a CSV file with the columns photo,reference");
    return plan_batch(photos, references, options);
}

class BatchRun {
public:
    explicit BatchRun(const BatchOptions& options)
        : m_options(options), m_settings(settings_text(options)), m_settings_hash(settings_hash(m_settings)),
          m_manifest(options.output, shard_name(options.shard)), m_maker(options, m_settings_hash),
          m_report(options.json, options.quiet)
    {
    }

    std::int64_t run()
    {
        plan();
        if (m_options.dry_run) {
            forecast();
            return m_summary.failed;
        }
        const auto start = Clock::now();
        m_manifest.begin();
        m_manifest.write_settings(m_settings_hash, m_settings);
        if (m_options.shard.index == 0) {
            m_manifest.write_plan(m_outputs);
            if (!m_options.copy.empty())
                m_summary.copied = copy_files(m_options, { m_outputs.begin(), m_outputs.end() });
        }
        m_report.started(m_summary);
        make_all();
        m_manifest.write_failed(m_failed);
        m_summary.seconds = std::chrono::duration<double>(Clock::now() - start).count();
        if (!m_failed.empty())
            m_summary.failed_path = m_manifest.failed_path();
        if (!m_fatal.empty())
            fail(m_fatal);
        check_interrupt();
        m_report.finished(m_summary);
        return m_summary.failed;
    }

private:
    /// Finds out what is to be done.
    void plan()
    {
        BatchPlan plan = plan_of(m_options, m_photo_count);
        m_outputs = std::move(plan.outputs);
        std::set<std::string> references;
        for (BatchTask& task : plan.tasks) {
            ++m_summary.planned;
            if (references.insert(task.reference).second)
                m_inputs.add("reference", task.reference);
            if (is_done(task))
                ++m_summary.done_before;
            else
                m_tasks.push_back(std::move(task));
        }
    }

    std::string path_of(const BatchTask& task) const { return (fs::path(m_options.output) / task.output).string(); }

    const ManifestEntry* known(const BatchTask& task) const
    {
        const auto found = m_manifest.entries().find(task.output);
        return found == m_manifest.entries().end() ? nullptr : &found->second;
    }

    /// A stat, unless hashes are asked for.
    bool is_done(const BatchTask& task)
    {
        const ManifestEntry* const entry = m_options.overwrite ? nullptr : known(task);
        if (!entry)
            return false;
        if (entry->settings != m_settings_hash || entry->reference != task.reference)
            fail("'" + path_of(task) +
                 "' was made with other settings or another reference; --overwrite makes it anew, and another folder "
                 "keeps both");
        std::error_code error;
        if (fs::file_size(path_of(task), error) != entry->bytes || error)
            return false;
        if (!m_options.check)
            return true;
        check_interrupt();
        const auto hash = hash_of_file(path_of(task)), photo_hash = hash_of_file(task.photo.path);
        return hash && photo_hash && *hash == entry->hash && *photo_hash == entry->photo_hash &&
               hash_of_reference(task.reference) == entry->reference_hash;
    }

    std::string hash_of_reference(const std::string& path)
    {
        const auto [found, is_new] = m_reference_hashes.emplace(path, "");
        if (is_new)
            if (const auto reference = load_reference_cached(path))
                found->second = (*reference)->hash;
        return found->second;
    }

    /// Fills the processor with photos, until all are made, one is enough to stop, or a signal comes.
    void make_all()
    {
        const std::size_t count = std::min<std::size_t>(images_at_a_time(m_options.threads), m_tasks.size());
        std::vector<std::thread> threads;
        m_working = count;
        for (std::size_t i = 0; i < count; ++i)
            threads.emplace_back([this] {
                {
                    const auto seat = m_maker.seat();
                    while (const BatchTask* const task = next())
                        make(*task, *seat);
                }
                const std::lock_guard lock(m_mutex);
                --m_working;
                m_finished.notify_all();
            });
        wait();
        for (std::thread& thread : threads)
            thread.join();
    }

    /// For all threads, or after a signal a second longer at most.
    void wait()
    {
        using namespace std::chrono_literals;
        std::unique_lock lock(m_mutex);
        const auto done = [&] { return m_working == 0; };
        while (!m_finished.wait_for(lock, 50ms, done))
            if (pending_interrupt())
                break;
        if (m_finished.wait_for(lock, 1s, done))
            return;
        m_given_up = true;
        if (!m_maker.give_up()) {
            // What these threads compute has no file yet.
            m_manifest.write_failed(m_failed);
            die_of({ pending_interrupt() });
        }
        m_finished.wait(lock, done);
    }

    const BatchTask* next()
    {
        const std::lock_guard lock(m_mutex);
        const bool stops = pending_interrupt() || !m_fatal.empty() || (m_options.fail_fast && !m_failed.empty());
        return stops || m_next == m_tasks.size() ? nullptr : &m_tasks[m_next++];
    }

    void make(const BatchTask& task, ImageMaker::Seat& seat)
    {
        Expected<ordered_json> line = Error{ "" };
        std::string fatal;
        try {
            for (int tries = 0; tries <= m_options.retry && !line; ++tries) {
                InputFiles photo;
                photo.add("photo", task.photo.path);
                Status free = photo.check_output(path_of(task));
                if (free)
                    free = m_inputs.check_output(path_of(task));
                line = free ? seat.make(task, path_of(task), m_options.overwrite || known(task))
                            : Expected<ordered_json>(free.error());
                if (!free || (!line && (is_of_the_disk(line.error().message) || pending_interrupt())))
                    break;
            }
            if (line)
                m_manifest.append(*line);
        } catch (const Failure& failure) {
            fatal = failure.message;
        } catch (const std::exception& error) {
            line = Error{ task.photo.path + ": " + error.what() };
        }
        const std::lock_guard lock(m_mutex);
        if (fatal.empty() && !line && is_of_the_disk(line.error().message))
            fatal = line.error().message;
        if (!fatal.empty()) {
            if (m_fatal.empty())
                m_fatal = fatal;
        } else if (line) {
            ++m_summary.made;
            m_summary.megapixels += (*line)["width"].get<double>() * (*line)["height"].get<double>() / 1e6;
            m_report.made(m_summary);
        } else if (m_fatal.empty() && !m_given_up) {
            take_failure(task, line.error().message);
        }
    }

    void take_failure(const BatchTask& task, const std::string& message)
    {
        ++m_summary.failed;
        ++m_summary.reasons[reason_of(message)];
        m_failed.push_back({ { "output", task.output },
                             { "photo", task.photo.name },
                             { "photo_path", task.photo.path },
                             { "reference", task.reference },
                             { "copy", task.copy },
                             { "error", message } });
        m_report.failed(m_summary, m_failed.back());
    }

    /// How long the rest will take and how large it will be, from some of it.
    void forecast()
    {
        BatchForecast forecast;
        const SampledCost cost = m_maker.sample(m_tasks);
        for (const std::string& error : cost.errors)
            ++m_summary.reasons[reason_of(error)];
        forecast.summary = m_summary;
        forecast.photos = m_photo_count;
        forecast.sampled = cost.made;
        forecast.seconds = cost.seconds * double(m_tasks.size());
        forecast.bytes = cost.bytes * double(m_tasks.size());
        if (m_options.photos_per_shard > 0) {
            constexpr std::int64_t kMostTasks = 1000; // Slurm's MaxArraySize is 1001 unless a site says otherwise
            const std::int64_t each =
                std::max((m_photo_count + kMostTasks - 1) / kMostTasks, m_options.photos_per_shard);
            forecast.shards = std::max<std::int64_t>((m_photo_count + each - 1) / each, 1);
            forecast.photos_per_shard = each;
        }
        m_report.forecast(forecast);
    }

    const BatchOptions& m_options;
    const std::string m_settings, m_settings_hash;
    Manifest m_manifest;
    ImageMaker m_maker;
    InputFiles m_inputs; ///< that no result may be written onto
    std::int64_t m_photo_count = 0;
    std::vector<std::string> m_outputs; ///< of all shards
    std::vector<BatchTask> m_tasks;     ///< of this shard those that are not done
    std::map<std::string, std::string> m_reference_hashes;

    std::mutex m_mutex; ///< of what follows
    std::condition_variable m_finished;
    std::size_t m_working = 0; ///< threads
    std::size_t m_next = 0;
    BatchReport m_report;
    BatchSummary m_summary;
    std::vector<ordered_json> m_failed;
    std::string m_fatal;     ///< what ends the run
    bool m_given_up = false; ///< what was under way when a signal came
};

} // namespace

std::int64_t run_batch(const BatchOptions& options)
{
    return BatchRun(options).run();
}

} // namespace srisp::tool
