// SPDX-License-Identifier: Apache-2.0
#include "anchor_pairs.h"

#include <algorithm>

#include "anchor_network.h"
#include "image_means.h"
#include "image_statistics.h"

namespace srisp::train {

namespace {

constexpr int kBatch = 64; // one step's

} // namespace

AnchorPairs::AnchorPairs(int wanted, bool for_network)
    : m_inputs(torch::empty({ wanted, for_network ? kAnchorInputs : kAnchorStatistics })),
      m_means(torch::empty({ wanted, 3, 3 }))
{
}

void AnchorPairs::make_more(Samples& samples)
{
    const torch::NoGradGuard no_gradient;
    const int count = std::min(kBatch, wanted() - m_made);
    const Batch batch = samples.batch(m_made / kBatch, 0, count, 0, 0);
    const torch::Tensor source = linear_source(batch.source);
    const torch::Tensor statistics = torch::cat({ image_statistics(source), image_statistics(batch.reference) }, 1);
    const bool for_network = m_inputs.size(1) == kAnchorInputs;
    m_inputs.slice(0, m_made, m_made + count)
        .copy_(for_network ? anchor_inputs(statistics, source, batch.reference) : statistics);
    m_means.slice(0, m_made, m_made + count).copy_(means_of(batch.truth));
    m_made += count;
}

bool AnchorPairs::take(const torch::Tensor& inputs, const torch::Tensor& means)
{
    const std::int64_t count = inputs.size(0);
    const bool whole_steps = count % kBatch == 0 || count == wanted();
    if (count > wanted() || !whole_steps || inputs.sizes() != m_inputs.slice(0, 0, count).sizes() ||
        means.sizes() != m_means.slice(0, 0, count).sizes())
        return false;
    m_inputs.slice(0, 0, count).copy_(inputs);
    m_means.slice(0, 0, count).copy_(means);
    m_made = static_cast<int>(count);
    return true;
}

} // namespace srisp::train
