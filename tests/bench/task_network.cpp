// SPDX-License-Identifier: Apache-2.0
#include "task_network.h"

#include "train/learning/optimizer.h"
#include "train/network/pipeline.h"
#include "train/tensors/random.h"

using namespace srisp::train;

namespace {

constexpr int kCell = 8, kTurns = 4, kColors = 4;
constexpr double kGrey = 0.06; // largest difference between the display values of what is called grey

struct Convolution {
    int inputs, outputs, stride;
};
constexpr Convolution kConvolutions[] = { { 3, 24, 2 }, { 24, 48, 2 }, { 48, 96, 2 }, { 96, 96, 1 } };

/// The name of each cell's mean colour: 0 grey, 1 warm, 2 green, 3 blue. [N, 3, H, W] → [N, H / 8, W / 8]
torch::Tensor color_names(const torch::Tensor& photos)
{
    const auto cells = torch::avg_pool2d(photos, kCell);
    const auto red = cells.select(1, 0), green = cells.select(1, 1), blue = cells.select(1, 2);
    const auto yellow = (red + green) / 2;
    const auto name = torch::where(blue > yellow, 3, torch::where(green > red, 2, 1));
    return torch::where(cells.amax(1) - cells.amin(1) < kGrey, 0, name);
}

/// What a network sees of an image.
struct View {
    std::int64_t image, top, left;
    int turns;
    bool mirrored;
};

torch::Tensor seen(const torch::Tensor& images, const View& view, int size)
{
    auto part = images[view.image].slice(1, view.top, view.top + size).slice(2, view.left, view.left + size);
    if (view.mirrored)
        part = part.flip(2);
    return torch::rot90(part, view.turns, { 1, 2 });
}

struct Question {
    torch::Tensor raws, turns, colors;
};

Question question(const TaskImages& images, const std::vector<View>& views, int size)
{
    std::vector<torch::Tensor> raws, photos;
    std::vector<std::int64_t> turns;
    for (const View& view : views) {
        raws.push_back(seen(images.raws, view, size));
        photos.push_back(seen(images.photos, view, size));
        turns.push_back(view.turns);
    }
    return { torch::stack(raws), torch::tensor(turns), color_names(torch::stack(photos)) };
}

std::vector<View> random_views(const TaskTraining& settings, const TaskImages& images, int seed, int step)
{
    std::vector<View> views;
    const std::int64_t margin = images.raws.size(2) - settings.size + 1;
    for (int i = 0; i < settings.batch; ++i) {
        Random random(seed, step, i);
        const std::int64_t image = random.integer(images.raws.size(0)), top = random.integer(margin);
        const std::int64_t left = random.integer(margin), turns = random.integer(kTurns);
        views.push_back({ image, top, left, static_cast<int>(turns), random.chance(0.5) });
    }
    return views;
}

/// Adds which of the answers [N, …] to questions about one photo were right.
void count(Answers& answers, const torch::Tensor& logits, const torch::Tensor& truth)
{
    answers.right.back() += (logits.argmax(1) == truth).sum().item<double>();
    answers.asked.back() += static_cast<double>(truth.numel());
}

} // namespace

TaskNetwork::TaskNetwork(int size, std::uint64_t seed)
{
    InitialWeights initial(seed);
    std::int64_t features = 0;
    for (const Convolution& c : kConvolutions) {
        m_convolutions.push_back(register_module("convolution_" + std::to_string(m_convolutions.size()),
                                                 std::make_shared<Layer>(initial.he({ c.outputs, c.inputs, 3, 3 }))));
        features = c.outputs;
    }
    const std::int64_t cells = size / kCell;
    m_turns = register_module("turns", std::make_shared<Layer>(initial.affine({ kTurns, features * cells * cells })));
    m_colors = register_module("colors", std::make_shared<Layer>(initial.affine({ kColors, features, 1, 1 })));
}

TaskNetwork::Logits TaskNetwork::forward(const torch::Tensor& raws) const
{
    torch::Tensor x = perceptual(raws);
    for (std::size_t i = 0; i < m_convolutions.size(); ++i)
        x = torch::relu(
            torch::conv2d(x, m_convolutions[i]->weight, m_convolutions[i]->bias, kConvolutions[i].stride, 1));
    return { m_turns->affine(x.flatten(1)), torch::conv2d(x, m_colors->weight, m_colors->bias) };
}

std::shared_ptr<TaskNetwork> train_network(const TaskTraining& settings, const TaskImages& images, int seed,
                                           const std::function<void(int step, double loss)>& progress)
{
    auto network = std::make_shared<TaskNetwork>(settings.size, seed);
    ParameterVector parameters(*network);
    OptimizerSettings optimizer;
    optimizer.rate = settings.rate;
    optimizer.weight_decay = settings.weight_decay;
    Adam adam(optimizer, parameters, torch::zeros_like(parameters.values()), parameters.mask_of(weights_of(*network)));
    for (int step = 0; step < settings.steps; ++step) {
        const Question asked = question(images, random_views(settings, images, seed, step), settings.size);
        parameters.gradients().zero_();
        const TaskNetwork::Logits logits = network->forward(asked.raws);
        const auto loss = torch::cross_entropy_loss(logits.turns, asked.turns) +
                          torch::cross_entropy_loss(logits.colors, asked.colors);
        loss.backward();
        adam.update(step, rate_factor(optimizer, step, settings.steps), adam.gradient_norm());
        progress(step, loss.item<double>());
    }
    return network;
}

TaskAnswers ask(const TaskNetwork& network, const TaskTraining& settings, const TaskImages& images)
{
    const torch::NoGradGuard no_gradient;
    TaskAnswers answers;
    const std::int64_t margin = (images.raws.size(2) - settings.size) / 2;
    for (std::size_t first = 0, end = 0; first < images.photo.size(); first = end) {
        std::vector<View> views;
        for (; end < images.photo.size() && images.photo[end] == images.photo[first]; ++end)
            for (int turns = 0; turns < kTurns; ++turns)
                views.push_back({ static_cast<std::int64_t>(end), margin, margin, turns, false });
        const Question asked = question(images, views, settings.size);
        const TaskNetwork::Logits logits = network.forward(asked.raws);
        for (Answers* kind : { &answers.up, &answers.colors }) {
            kind->right.push_back(0);
            kind->asked.push_back(0);
        }
        count(answers.up, logits.turns, asked.turns);
        count(answers.colors, logits.colors, asked.colors);
    }
    return answers;
}

std::vector<double> color_shares(const TaskImages& images)
{
    const auto names = color_names(images.photos);
    std::vector<double> shares;
    for (int name = 0; name < kColors; ++name)
        shares.push_back((names == name).to(torch::kFloat32).mean().item<double>());
    return shares;
}
