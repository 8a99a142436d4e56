// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "apply/job.h"
#include "apply/tone_map.h"
#include "kernels/color_blocks.h"

namespace srisp {

/// The pipeline of a model whose tone map looks at neighbours: tile by tile, row by row.
class TiledPipeline : public Pipeline {
public:
    TiledPipeline(Direction direction, const ColorBlocks& blocks, std::unique_ptr<const ToneMap> tone_map)
        : m_direction(direction), m_blocks(blocks), m_tone_map(std::move(tone_map))
    {
    }

    int halo() const override { return m_tone_map->halo(); }
    void run(const Job& job, int threads, Progress& progress) const override;

private:
    void run_tile(ToneMapRunner& runner, const Job& job, Roi tile) const;

    Direction m_direction;
    ColorBlocks m_blocks;
    std::unique_ptr<const ToneMap> m_tone_map;
};

} // namespace srisp
