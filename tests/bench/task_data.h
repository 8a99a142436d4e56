// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "pack/training_pack.h"
#include "train/network/unprocessor.h"
#include "train/samples/simulation.h"

/// Images for a task, and the photos that they were made of, which tell the answers: [N, 3, S, S] each.
struct TaskImages {
    torch::Tensor photos, raws;
    std::vector<int> photo; ///< which photo each image shows; those of one photo follow each other
};

/// Where a task is to be done: a camera that no model was trained with, in one light.
struct TaskTarget {
    int camera = 0;
    std::string name;
    srisp::train::SimulatedCameras::Spectrum light;
    srisp::train::CameraColor color;
};

/// Training and test images of a pack: of its training photos, whole and in parts, and of its validation photos, whole
/// and in several exposures.
class TaskData {
public:
    /// Images of `size` px; each unprocessed one gets one of `references` RAW images. Throws std::runtime_error where
    /// the pack lacks photos or cameras of either use.
    TaskData(const srisp::TrainingPack& pack, int size, int references);

    /// The target of a seed, one held-out camera after the other.
    TaskTarget target(int seed) const;

    /// Simulated RAW images of the target, with exposures and noise of their own.
    TaskImages test(int seed) const;
    /// The same of the training photos.
    TaskImages simulated(int seed) const;
    /// The same with training cameras and any light: what simulation gives to someone without the target's spectra.
    TaskImages simulated_others(int seed) const;
    /// Training photos as a method unprocesses them, each with one of the target's RAW images of another photo as
    /// reference; noise is added as for `simulated`.
    TaskImages unprocessed(int seed, srisp::train::Unprocessor& method) const;
    /// Training photos to the power of 2.2, with the same noise.
    TaskImages linearized(int seed) const;

private:
    using Captures = std::vector<srisp::train::Capture>;

    Captures captures(int seed, std::uint64_t stream, const TaskTarget& target, std::size_t count) const;
    torch::Tensor simulate(int seed, std::uint64_t stream, const torch::Tensor& photos, const Captures& captures) const;
    TaskImages noisy(int seed, const torch::Tensor& clean) const;

    srisp::train::SimulationSettings m_simulation;
    srisp::train::SimulatedCameras m_cameras;
    std::vector<std::string> m_names;
    int m_references;
    TaskImages m_training, m_test;
};
