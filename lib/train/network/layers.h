// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <vector>

#include "train/tensors/torch_api.h"

namespace srisp::train {

/// Where learning starts; normal numbers from a generator that the model's seed set.
class InitialWeights {
public:
    explicit InitialWeights(std::uint64_t seed) : m_generator(at::detail::createCPUGenerator(seed)) {}

    torch::Tensor normal(torch::IntArrayRef shape, double deviation)
    {
        return torch::empty(shape).normal_(0, deviation, m_generator);
    }

    /// For a layer [O, I, …] that a ReLU follows (He et al. 2015).
    torch::Tensor he(torch::IntArrayRef shape) { return normal(shape, std::sqrt(2.0 / inputs(shape))); }

    /// For an affine layer: the variance of LibTorch's own default.
    torch::Tensor affine(torch::IntArrayRef shape) { return normal(shape, std::sqrt(1 / (3.0 * inputs(shape)))); }

private:
    static double inputs(torch::IntArrayRef shape)
    {
        double count = 1;
        for (std::size_t i = 1; i < shape.size(); ++i)
            count *= static_cast<double>(shape[i]);
        return count;
    }

    at::Generator m_generator;
};

/// A layer with weight and bias, registered under these names; bias starts at 0.
struct Layer : torch::nn::Module {
    /// One bias per output, or of another shape; an undefined weight leaves the bias alone.
    explicit Layer(const torch::Tensor& initial_weight);
    Layer(const torch::Tensor& initial_weight, torch::IntArrayRef bias_shape);
    /// weight · x + bias, x: [N, inputs].
    torch::Tensor affine(const torch::Tensor& x) const { return torch::addmm(bias, x, weight.t()); }
    torch::Tensor weight, bias;
};

/// 3×3 convolutions of stride 2, zeros around, ReLU on all but the last, then the mean: [N, C, H, W] → [N, features].
/// (h_x, h_r, h_i of method 2.)
class FeatureEncoder : public torch::nn::Module {
public:
    /// `channels`: of the input and after each layer.
    FeatureEncoder(const std::vector<std::int64_t>& channels, InitialWeights& initial);
    torch::Tensor forward(torch::Tensor x) const;

private:
    std::vector<std::shared_ptr<Layer>> m_layers;
};

enum class Selection {
    dynamic,      ///< softmax(H · (P · g_xr + g_i)) [P 3.1]
    intermediate, ///< softmax(H · g_i): the images' own features play no part
    fixed         ///< softmax(bias of H): the same for all images
};

/// Chooses the weights of one block's dictionaries (tone: one per layer). Its parameters are named as in the model
/// file; in the simpler selections those that play no part are absent.
class BlockSelector : public torch::nn::Module {
public:
    BlockSelector(Selection selection, int input_channels, int dictionaries, int atoms, InitialWeights& initial);

    /// Weights [N, atoms] of each dictionary for N images. `fused`: g_xr, [N, 128]; `input` makes the block's encoder
    /// input and is not called where images play no part.
    std::vector<torch::Tensor> weights(std::int64_t images, const torch::Tensor& fused,
                                       const std::function<torch::Tensor()>& input) const;

    /// What a fixed selection learns.
    std::vector<torch::Tensor> fixed_parameters() const;

private:
    Selection m_selection;
    std::shared_ptr<FeatureEncoder> m_encoder;
    std::vector<std::shared_ptr<Layer>> m_project, m_head; ///< a fixed selection's heads have no weight
};

} // namespace srisp::train
