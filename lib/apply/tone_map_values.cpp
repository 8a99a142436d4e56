// SPDX-License-Identifier: Apache-2.0
#include <srisp/apply.h>

#include <algorithm>

#include <srisp/model.h>

#include "apply/tone_map.h"
#include "base/guarded.h"
#include "base/parallel.h"
#include "kernels/pixel_tone_map.h"

namespace srisp {

namespace {

constexpr int kBlock = 480; // pixels that a thread takes at a time

void run_block(const PixelToneMap& tone_map, const float* rgb, std::size_t count, float* out)
{
    float values[3 * (kBlock + kRowSlack)] = {};
    const Planes planes{ values, kBlock + kRowSlack };
    split_channels(rgb, planes, count);
    tone_map_pixels(tone_map, planes, planes, count);
    join_channels(planes, out, count);
}

} // namespace

Status tone_map_values(const Model& model, const Parameters& parameters, Direction direction, const float* rgb,
                       std::int64_t count, float* out)
{
    if (model.kernel_size() != 1)
        return Error{
            "model '" + model.name() + "': its tone map looks at " + std::to_string(model.kernel_size()) + " x " +
            std::to_string(model.kernel_size()) +
            " pixels, and a table holds single colours: needs a model with kernel size 1, such as 'default'"
        };
    if (Status status = check_parameters(parameters, model); !status)
        return status;
    return guarded("tone map", {}, [&]() -> Status {
        const ToneDictionary& dictionary =
            direction == Direction::reverse ? model_data(model).tone_reverse : model_data(model).tone_forward;
        const PixelToneMap tone_map = pack_pixel_tone_map(mix_layers(dictionary, parameters.tone_weights));
        const std::int64_t blocks = (count + kBlock - 1) / kBlock;
        const auto work = [&](std::int64_t block) {
            const std::int64_t first = block * kBlock;
            run_block(tone_map, rgb + 3 * first, std::min<std::int64_t>(kBlock, count - first), out + 3 * first);
        };
        parallel_tasks(blocks, 0, work);
        return {};
    });
}

} // namespace srisp
