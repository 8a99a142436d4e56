// SPDX-License-Identifier: Apache-2.0
#include "packed_images.h"

namespace srisp::train {

torch::Tensor packed_image(const PackedImages& images, std::size_t entry)
{
    auto result = torch::empty({ 3, images.size, images.size });
    const std::uint16_t* packed = images.image(entry);
    float* value = result.data_ptr<float>();
    for (std::int64_t i = 0; i < result.numel(); ++i)
        value[i] = static_cast<float>(packed[i]) / 65535.0f;
    return result;
}

std::vector<std::size_t> whole_images(const PackedImages& images, bool validation_only)
{
    std::vector<std::size_t> whole;
    for (std::size_t i = 0; i < images.entries.size(); ++i) {
        const PackEntry& entry = images.entries[i];
        const bool first_of_scene = i == 0 || images.entries[i - 1].scene != entry.scene;
        if (first_of_scene && (entry.validation || !validation_only))
            whole.push_back(i);
    }
    return whole;
}

} // namespace srisp::train
