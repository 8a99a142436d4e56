// SPDX-License-Identifier: Apache-2.0
#include "base/spare_memory.h"

#include <algorithm>
#include <array>
#include <utility>

namespace srisp {

namespace {

struct Block {
    std::unique_ptr<float[]> floats;
    std::size_t count = 0;
};

} // namespace

struct SpareMemory::Spares {
    // What one band needs. Who holds more at a time gets fresh memory for it.
    std::array<Block, 4> blocks;

    Block take(std::size_t count)
    {
        for (Block& block : blocks)
            if (block.floats && block.count >= count && block.count / 2 <= count)
                return std::exchange(block, {});
        return { std::unique_ptr<float[]>(new float[count]), count };
    }
    void give_back(Block block) noexcept
    {
        // In an empty place, or in that of the smallest: sizes differ where images do.
        const auto place = std::min_element(blocks.begin(), blocks.end(),
                                            [](const Block& a, const Block& b) { return a.count < b.count; });
        if (place->count <= block.count)
            *place = std::move(block);
    }
};

SpareMemory::SpareMemory() : m_spares(std::make_shared<Spares>()) {}

std::shared_ptr<float[]> SpareMemory::floats(std::size_t count)
{
    Block block = m_spares->take(count);
    float* const floats = block.floats.get();
    // The block travels in the deleter, and lets go of its memory there.
    const auto owner = std::make_shared<Block>(std::move(block));
    return std::shared_ptr<float[]>(floats,
                                    [owner, spares = m_spares](float*) { spares->give_back(std::move(*owner)); });
}

} // namespace srisp
