// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "task_data.h"
#include "train/network/layers.h"

/// Answers of one kind: how many of them were right.
struct Answers {
    std::vector<double> right, asked; ///< by photo
};

/// The two tasks. Which way is up: one of four turns of the image. Colours: grey, warm, green or blue, for each cell of
/// 8 × 8 px, as the photo shows it.
struct TaskAnswers {
    Answers up, colors;
};

/// A small network that does both: four convolutions, and a linear layer for each task. It takes linear RAW images,
/// which it brings to the power of 1/2.2.
class TaskNetwork : public torch::nn::Module {
public:
    /// For images of `size` px, a multiple of 8.
    TaskNetwork(int size, std::uint64_t seed);

    struct Logits {
        torch::Tensor turns;  ///< [N, 4]
        torch::Tensor colors; ///< [N, 4, S / 8, S / 8]
    };
    Logits forward(const torch::Tensor& raws) const;

private:
    std::vector<std::shared_ptr<srisp::train::Layer>> m_convolutions;
    std::shared_ptr<srisp::train::Layer> m_turns, m_colors;
};

struct TaskTraining {
    int size = 48, steps = 2000, batch = 32;
    double rate = 3e-3, weight_decay = 0.05;
};

/// Learns from parts of `size` px of the images, mirrored and turned at random. `progress` gets each step's loss.
std::shared_ptr<TaskNetwork> train_network(const TaskTraining& settings, const TaskImages& images, int seed,
                                           const std::function<void(int step, double loss)>& progress);

/// The middle of each image, turned all four ways.
TaskAnswers ask(const TaskNetwork& network, const TaskTraining& settings, const TaskImages& images);

/// Of an image's cells, the share that has each colour.
std::vector<double> color_shares(const TaskImages& images);
