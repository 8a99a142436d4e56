// SPDX-License-Identifier: Apache-2.0
#include "train/samples/packed_images.h"

#include <map>
#include <stdexcept>

namespace srisp::train {

/// Throws, as LibTorch does, where the pack is no longer what it was when it was opened.
static std::vector<std::uint16_t> values_of(const PackedImages& images, std::size_t entry)
{
    auto values = images.image(entry);
    if (!values)
        throw std::runtime_error(values.error().message);
    return std::move(*values);
}

torch::Tensor packed_image(const PackedImages& images, std::size_t entry)
{
    auto result = torch::empty({ 3, images.size, images.size });
    const std::vector<std::uint16_t> packed = values_of(images, entry);
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

SceneSource::SceneSource(const PackedImages& images, bool open_only, bool need_white_balance) : m_images(images)
{
    std::map<int, std::vector<int>> scenes;
    for (std::size_t i = 0; i < images.entries.size(); ++i) {
        const PackEntry& entry = images.entries[i];
        const bool known = entry.white_balance[0] > 0 && entry.white_balance[2] > 0;
        if (!entry.validation && (entry.open || !open_only) && (known || !need_white_balance))
            scenes[entry.scene].push_back(static_cast<int>(i));
    }
    for (auto& [scene, entries] : scenes)
        m_scenes.push_back(std::move(entries));
}

int SceneSource::draw_within(std::size_t scene, double whole_share, Random& random) const
{
    const std::vector<int>& entries = m_scenes[scene];
    const bool whole = random.chance(whole_share);
    const auto crop = random.integer(std::max<std::int64_t>(1, entries.size() - 1));
    return whole || entries.size() == 1 ? entries.front() : entries[1 + crop];
}

int SceneSource::draw(double whole_share, Random& random) const
{
    const auto scene = random.integer(m_scenes.size());
    return draw_within(scene, whole_share, random);
}

int SceneSource::draw_other(int index, bool same_group, double whole_share, Random& random) const
{
    const auto start = random.integer(m_scenes.size());
    for (std::size_t i = 0; i < m_scenes.size(); ++i) {
        const std::size_t scene = (start + i) % m_scenes.size();
        const PackEntry& candidate = entry(m_scenes[scene].front());
        if (candidate.scene != entry(index).scene && (!same_group || candidate.group == entry(index).group))
            return draw_within(scene, whole_share, random);
    }
    return index;
}

torch::Tensor SceneSource::images(const std::vector<int>& entries, const torch::Device& device) const
{
    const std::int64_t size = m_images.size;
    const auto values = torch::empty({ static_cast<std::int64_t>(entries.size()), 3, size, size });
    float* value = values.data_ptr<float>();
    for (const int index : entries)
        for (const std::uint16_t pixel : values_of(m_images, std::size_t(index)))
            *value++ = static_cast<float>(pixel) * (1.0f / 65535);
    return values.to(device);
}

} // namespace srisp::train
