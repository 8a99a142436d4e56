// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <string>

#include "train/tensors/torch_api.h"

namespace srisp::train {

/// What one optimiser step learns from; images [N, 3, S, S] as an Unprocessor takes them.
struct Batch {
    torch::Tensor source, truth, reference;            ///< pseudo pairs PP_rand: [N, 3, S, S]
    torch::Tensor unpaired_source, unpaired_reference; ///< for PP_MT: [M, 3, S, S]; photos as they are, and RAW images
};

/// Makes batches from a training pack. A batch depends on the settings, the seed and the step alone: not on threads,
/// not on the steps before, and sample i of a batch not on the batch's size; so runs resume exactly and ranks share one
/// batch.
class Samples {
public:
    virtual ~Samples() = default;

    /// Whether there are photos for unpaired samples.
    virtual bool has_unpaired() const { return true; }

    /// Samples `first` to `first + pairs` of the pseudo pairs of a step, and likewise of the unpaired ones.
    virtual Batch batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired) = 0;
};

/// Which samples of each step's batch a process takes.
struct SampleSlice {
    int first_pair, pairs, first_unpaired, unpaired;
    std::int64_t unpaired_from; ///< the first step that has unpaired ones
};

/// The batches of one process after another. Where a GPU computes, the next batch is made in a thread meanwhile; where
/// the CPU does, both would only share the same cores.
class SampleQueue {
public:
    SampleQueue(std::shared_ptr<Samples> samples, SampleSlice slice, bool ahead)
        : m_samples(std::move(samples)), m_slice(slice), m_ahead(ahead)
    {
    }
    ~SampleQueue()
    {
        if (m_next.valid())
            m_next.wait();
    }

    /// The batch of `step`; fast where it is the one after the last call's.
    Batch batch(std::int64_t step)
    {
        if (m_next.valid() && m_next_step != step)
            m_next.wait();
        Batch batch = m_next.valid() && m_next_step == step ? m_next.get() : make(step);
        if (m_ahead) {
            m_next_step = step + 1;
            m_next = std::async(std::launch::async, [this, step] { return make(step + 1); });
        }
        return batch;
    }

private:
    Batch make(std::int64_t step)
    {
        const int unpaired = step >= m_slice.unpaired_from ? m_slice.unpaired : 0;
        return m_samples->batch(step, m_slice.first_pair, m_slice.pairs, m_slice.first_unpaired, unpaired);
    }

    std::shared_ptr<Samples> m_samples;
    SampleSlice m_slice;
    bool m_ahead;
    std::int64_t m_next_step = -1;
    std::future<Batch> m_next;
};

} // namespace srisp::train
