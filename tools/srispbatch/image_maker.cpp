// SPDX-License-Identifier: Apache-2.0
#include "image_maker.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <thread>

#include "../common/interrupt.h"
#include "../common/temporary_folder.h"

namespace srisp::tool {

using nlohmann::ordered_json;

ImageMaker::ImageMaker(const BatchOptions& options, const std::string& settings)
    : m_options(options), m_settings(settings), m_gate(memory_limit(options.memory_gb)),
      m_references(most_references(options.memory_gb, 1))
{
    prepare_making(options.format, most_references(options.memory_gb, 1));
}

ImageMaker::Seat::Seat(ImageMaker& maker)
    : m_maker(maker), m_worker(maker.m_options.arguments, maker.m_options.time_limit)
{
    const std::lock_guard lock(m_maker.m_mutex);
    m_maker.m_seats.insert(this);
}

ImageMaker::Seat::~Seat()
{
    const std::lock_guard lock(m_maker.m_mutex);
    m_maker.m_seats.erase(this);
}

Expected<ordered_json> ImageMaker::Seat::make(const BatchTask& task, const std::string& path, bool may_replace)
{
    std::optional<MemoryGate::Pass> pass;
    const AskForMemory ask = [&](std::uint64_t bytes) { pass.emplace(m_maker.m_gate, bytes); };
    if (!m_maker.m_options.isolate)
        return run_task(task, path, m_maker.m_options, m_maker.m_settings, may_replace, ask);
    static_cast<void>(m_worker.start()); // while the reference is decoded; `run` says why it cannot
    const auto reference = m_maker.m_references.get(task.reference);
    return m_worker.run(task, path, reference ? reference->name() : "", m_maker.m_settings, may_replace, ask);
}

SampledCost ImageMaker::sample(const std::vector<BatchTask>& tasks)
{
    const unsigned threads = images_at_a_time(m_options.threads);
    const std::size_t count = std::min<std::size_t>(tasks.size(), std::max(16u, 4 * threads));
    const TemporaryFolder folder;
    std::mutex mutex;
    SampledCost cost;
    double ms = 0;
    std::atomic<std::size_t> next{ 0 };
    std::vector<std::thread> workers;
    for (unsigned i = 0; i < threads; ++i)
        workers.emplace_back([&] {
            const auto seat = this->seat();
            for (std::size_t k = next++; k < count && !pending_interrupt(); k = next++) {
                const BatchTask& task = tasks[k * tasks.size() / count];
                const auto line = seat->make(
                    task, (folder.path() / (std::to_string(k) + "." + format_name(m_options.format))).string(), false);
                const std::lock_guard lock(mutex);
                if (line) {
                    ++cost.made;
                    ms += (*line)["ms"].get<double>();
                    cost.bytes += (*line)["bytes"].get<double>();
                } else {
                    cost.errors.push_back(line.error().message);
                }
            }
        });
    for (std::thread& worker : workers)
        worker.join();
    check_interrupt();
    if (cost.made) {
        cost.bytes /= cost.made;
        cost.seconds = ms / 1e3 / cost.made / threads;
    }
    return cost;
}

bool ImageMaker::give_up()
{
    const std::lock_guard lock(m_mutex);
    for (Seat* const seat : m_seats)
        seat->m_worker.kill();
    return m_options.isolate;
}

} // namespace srisp::tool
