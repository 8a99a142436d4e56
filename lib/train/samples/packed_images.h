// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "pack/training_pack.h"
#include "train/tensors/random.h"

namespace srisp::train {

/// One image of a pack as float32 [3, S, S] in [0, 1].
torch::Tensor packed_image(const PackedImages& images, std::size_t entry);

/// The entries that are whole photos or RAW images, not crops of those; the ones marked for validation or all.
std::vector<std::size_t> whole_images(const PackedImages& images, bool validation_only);

/// The images of a pack that training may use, by scene.
class SceneSource {
public:
    /// Entries that are not for validation and, with `open_only`, open. `images` must outlive this.
    SceneSource(const PackedImages& images, bool open_only, bool need_white_balance);

    bool empty() const { return m_scenes.empty(); }
    /// An entry of a random scene: with probability `whole_share`, or where there is no other, the whole image.
    int draw(double whole_share, Random& random) const;
    /// The same of another scene of the same group than that of `entry`, the same scene where there is no other.
    int draw_other(int entry, bool same_group, double whole_share, Random& random) const;

    const PackEntry& entry(int index) const { return m_images.entries[index]; }
    /// Entries as images [N, 3, size, size] in [0, 1].
    torch::Tensor images(const std::vector<int>& entries, const torch::Device& device) const;

private:
    int draw_within(std::size_t scene, double whole_share, Random& random) const;

    const PackedImages& m_images;
    std::vector<std::vector<int>> m_scenes; ///< entries of each scene, the whole image first
};

} // namespace srisp::train
