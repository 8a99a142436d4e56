// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <thread>

#include <srisp/apply.h>

namespace srisp {

/// What is to be computed, and from what.
struct Job {
    ImagePart source;
    Roi roi;
    MutableImageView target;

    /// Where the region's first pixel lies in the source.
    const float* first_source_pixel() const { return source.pixels.pixel(roi.x0 - source.x, roi.y0 - source.y); }
};

/// How much of several jobs is done; asks the caller's progress function from the caller's thread only.
class Progress {
public:
    Progress(const ApplyOptions& options, std::int64_t pixels)
        : m_callback(options.progress), m_total(pixels), m_thread(std::this_thread::get_id())
    {
    }

    bool cancelled() const { return m_cancelled; }
    void add(std::int64_t pixels)
    {
        const std::int64_t done = m_done += pixels;
        if (m_callback && std::this_thread::get_id() == m_thread && !m_callback(float(done) / m_total))
            m_cancelled = true;
    }

private:
    const std::function<bool(float)>& m_callback;
    std::int64_t m_total;
    std::thread::id m_thread;
    std::atomic<std::int64_t> m_done{ 0 };
    std::atomic<bool> m_cancelled{ false };
};

/// The pipeline in one direction, ready to run. Immutable.
class Pipeline {
public:
    virtual ~Pipeline() = default;

    /// Neighbours that a region needs around it.
    virtual int halo() const = 0;
    /// Source and target share no memory, or without a halo: they are the same pixels.
    virtual void run(const Job& job, int threads, Progress& progress) const = 0;
};

} // namespace srisp
