// SPDX-License-Identifier: Apache-2.0
// How long oneDNN takes for the four layers of the spatial tone map alone: what srispbench compares apply with.
#include <cstdio>
#include <exception>
#include <unordered_map>
#include <vector>

#include <CLI/CLI.hpp>
#include <oneapi/dnnl/dnnl.hpp>

#include "measuring.h"

namespace {

// Its activations stay in the last level of cache. No halo: that is work which apply has and this has not.
constexpr int kTile = 128;
constexpr int kChannels[] = { 3, 32, 32, 32, 3 };

using Format = dnnl::memory::format_tag;

dnnl::memory::desc described(const dnnl::memory::dims& shape, Format format)
{
    return { shape, dnnl::memory::data_type::f32, format };
}

/// 3×3, with a ReLU behind all layers but the last, in the layouts that oneDNN wants for itself.
dnnl::convolution_forward::primitive_desc layer(const dnnl::engine& engine, int index)
{
    const int inputs = kChannels[index], outputs = kChannels[index + 1];
    const dnnl::convolution_forward::desc description(
        dnnl::prop_kind::forward_inference, dnnl::algorithm::convolution_auto,
        described({ 1, inputs, kTile, kTile }, Format::any), described({ outputs, inputs, 3, 3 }, Format::any),
        described({ outputs }, Format::x), described({ 1, outputs, kTile, kTile }, Format::any), { 1, 1 }, { 1, 1 },
        { 1, 1 });
    dnnl::primitive_attr attributes;
    if (index < 3) {
        dnnl::post_ops relu;
        relu.append_eltwise(1.0f, dnnl::algorithm::eltwise_relu, 0, 0);
        attributes.set_post_ops(relu);
    }
    return { description, attributes, engine };
}

/// Interleaved pixels in, interleaved pixels out, as apply has them.
class Tile {
public:
    Tile() : m_stream(m_engine)
    {
        dnnl::memory pixels = filled(described({ 1, 3, kTile, kTile }, Format::nhwc));
        for (int i = 0; i < 4; ++i) {
            const auto convolution = layer(m_engine, i);
            pixels = in_layout(pixels, convolution.src_desc());
            const dnnl::memory output(convolution.dst_desc(), m_engine);
            m_steps.push_back({ dnnl::convolution_forward(convolution),
                                { { DNNL_ARG_SRC, pixels },
                                  { DNNL_ARG_WEIGHTS, filled(convolution.weights_desc()) },
                                  { DNNL_ARG_BIAS, filled(convolution.bias_desc()) },
                                  { DNNL_ARG_DST, output } } });
            pixels = output;
        }
        in_layout(pixels, described({ 1, 3, kTile, kTile }, Format::nhwc));
    }

    void run()
    {
        for (Step& step : m_steps)
            step.primitive.execute(m_stream, step.arguments);
        m_stream.wait();
    }

private:
    struct Step {
        dnnl::primitive primitive;
        std::unordered_map<int, dnnl::memory> arguments;
    };

    dnnl::memory filled(const dnnl::memory::desc& description) const
    {
        const dnnl::memory memory(description, m_engine);
        float* const values = static_cast<float*>(memory.get_data_handle());
        for (std::size_t i = 0; i < description.get_size() / sizeof(float); ++i)
            values[i] = float(i % 7) * 0.01f;
        return memory;
    }

    dnnl::memory in_layout(const dnnl::memory& memory, const dnnl::memory::desc& wanted)
    {
        if (memory.get_desc() == wanted)
            return memory;
        const dnnl::memory moved(wanted, m_engine);
        m_steps.push_back({ dnnl::reorder(memory, moved), { { DNNL_ARG_FROM, memory }, { DNNL_ARG_TO, moved } } });
        return moved;
    }

    dnnl::engine m_engine{ dnnl::engine::kind::cpu, 0 };
    dnnl::stream m_stream;
    std::vector<Step> m_steps;
};

} // namespace

int main(int argc, char** argv)
{
    double megapixels = 6;
    CLI::App app{ "Prints the nanoseconds per pixel that oneDNN takes for the four layers of the spatial tone map.\n"
                  "Threads: OMP_NUM_THREADS." };
    app.add_option("--megapixels", megapixels)->capture_default_str()->check(CLI::Range(0.01, 100.0));
    CLI11_PARSE(app, argc, argv);
    try {
        Tile tile;
        tile.run();
        const int tiles = static_cast<int>(megapixels * 1e6 / (kTile * kTile)) + 1;
        const double time = seconds([&] {
            for (int i = 0; i < tiles; ++i)
                tile.run();
        });
        std::printf("%.1f\n", time * 1e9 / (double(tiles) * kTile * kTile));
    } catch (const std::exception& error) {
        std::fprintf(stderr, "dnnlbench: %s\n", error.what());
        return 1;
    }
    return 0;
}
