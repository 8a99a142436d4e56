// SPDX-License-Identifier: Apache-2.0
#include "task_runner.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <optional>
#include <thread>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/machine_share.h"
#include "../common/memory_gate.h"
#include "base/progress.h"

namespace srisp::tool {

namespace {

/// Runs tasks on several threads, each result into the journal.
class Runner {
public:
    Runner(const EvalOptions& options, const Protocol& protocol, const Methods& methods, int picture_size,
           Journal& journal)
        : m_options(options), m_protocol(protocol), m_methods(methods), m_pictures{ picture_size }, m_journal(journal),
          m_gate(memory_limit(options.memory_gb)), m_meter(work(protocol, journal), !options.quiet)
    {
        for (const EvalTask& task : protocol.tasks)
            if (!journal.tasks().count(key_of(task)))
                m_waiting.push_back(&task);
        m_done = protocol.tasks.size() - m_waiting.size();
    }

    /// Of which files nothing could be tested.
    std::vector<LeftOut> run()
    {
        const std::size_t count = std::min<std::size_t>(images_at_a_time(m_options.threads), m_waiting.size());
        std::vector<std::thread> threads;
        for (std::size_t i = 0; i < count; ++i)
            threads.emplace_back([this] { work_on(); });
        for (std::thread& thread : threads)
            thread.join();
        m_meter.wipe();
        if (m_failure)
            throw *m_failure;
        return std::move(m_failed);
    }

private:
    static WorkCount work(const Protocol& protocol, const Journal& journal)
    {
        return { "srispeval", protocol.has_truth ? "RAW files" : "photos", std::int64_t(protocol.tasks.size()),
                 std::int64_t(std::min(journal.tasks().size(), protocol.tasks.size())) };
    }

    void work_on()
    {
        for (std::size_t i = m_next++; i < m_waiting.size() && !pending_interrupt(); i = m_next++) {
            const EvalTask& task = *m_waiting[i];
            std::vector<EvaluatedImage> images;
            std::vector<LeftOut> left_out;
            try {
                evaluate(task, images, left_out);
            } catch (const Failure& failure) {
                left_out.push_back({ task.name, failure.message });
            } catch (const std::exception& error) {
                left_out.push_back({ task.name, error.what() });
            }
            const std::lock_guard lock(m_mutex);
            // What a signal cut short is no result.
            if (m_failure || (pending_interrupt() && !left_out.empty()))
                return;
            try {
                if (images.empty())
                    m_failed.insert(m_failed.end(), left_out.begin(), left_out.end());
                else
                    m_journal.append(key_of(task), images, left_out);
            } catch (const Failure& failure) {
                m_failure = failure;
                m_next = m_waiting.size();
            }
            m_meter.show(std::int64_t(++m_done));
        }
    }

    void evaluate(const EvalTask& task, std::vector<EvaluatedImage>& images, std::vector<LeftOut>& left_out)
    {
        std::optional<MemoryGate::Pass> pass;
        auto made = task.make([&](std::uint64_t bytes) { pass.emplace(m_gate, bytes); });
        if (!made) {
            left_out.push_back({ task.name, made.error().message });
            return;
        }
        pass.reset();
        left_out = std::move(made->left_out);
        for (const TestImage& image : made->images) {
            auto evaluated = evaluate_image(image, m_methods, { m_options.edits, m_options.seed }, m_pictures);
            if (!evaluated) {
                left_out.push_back(
                    { task.name, image.score.rendering + " " + image.score.part + ": " + evaluated.error().message });
                continue;
            }
            images.push_back(std::move(*evaluated));
        }
        if (m_protocol.ranks)
            add_rank_correlations(images, m_methods);
    }

    const EvalOptions& m_options;
    const Protocol& m_protocol;
    const Methods& m_methods;
    const PictureSettings m_pictures;
    Journal& m_journal;
    MemoryGate m_gate;
    std::vector<const EvalTask*> m_waiting;
    std::atomic<std::size_t> m_next{ 0 };

    std::mutex m_mutex; ///< of what follows
    ProgressMeter m_meter;
    std::size_t m_done = 0;
    std::vector<LeftOut> m_failed;
    std::optional<Failure> m_failure;
};

} // namespace

std::string key_of(const EvalTask& task)
{
    return task.name + "\n" + task.state;
}

std::vector<LeftOut> run_tasks(const EvalOptions& options, const Protocol& protocol, const Methods& methods,
                               int picture_size, Journal& journal)
{
    return Runner(options, protocol, methods, picture_size, journal).run();
}

} // namespace srisp::tool
