// SPDX-License-Identifier: Apache-2.0
#include "result/band_reader.h"

#include <algorithm>

#include <doctest/doctest.h>
#include <srisp/model.h>
#include <srisp/select.h>

#include "random_model.h"
#include "scratch_folder.h"

using namespace srisp;

namespace {

/// Noise in memory; counts the rows that are read.
class NoiseSource : public PixelSource {
public:
    explicit NoiseSource(const OIIO::ImageSpec& spec) : m_spec(spec)
    {
        Random random(7);
        m_values.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
        for (float& value : m_values)
            value = random.uniform(0, 1);
    }

    std::optional<OIIO::ImageSpec> find_level(int, int) override { return m_spec; }
    Status read_rows(int, int, int y0, int y1, float* rows) override
    {
        const std::size_t row = std::size_t(m_spec.width) * std::size_t(m_spec.nchannels);
        std::copy_n(m_values.data() + row * std::size_t(y0), row * std::size_t(y1 - y0), rows);
        rows_read += y1 - y0;
        return {};
    }
    const std::string& name() const override { return m_name; }
    const std::string& key() const override { return m_name; }
    int rows_read = 0;

private:
    OIIO::ImageSpec m_spec;
    std::vector<float> m_values;
    std::string m_name = "noise";
};

std::shared_ptr<const Applier> random_applier(int kernel_size)
{
    const ScratchFolder folder;
    const auto model = Model::load(random_model(kernel_size, 1).write(folder.path("random.safetensors")));
    REQUIRE_MESSAGE(model, (model ? "" : model.error().message));
    Thumbnail photo, raw;
    std::fill(photo.rgb.begin(), photo.rgb.end(), 0.5f);
    std::fill(raw.rgb.begin(), raw.rgb.end(), 0.2f);
    const auto parameters = select(**model, photo, raw);
    REQUIRE_MESSAGE(parameters, (parameters ? "" : parameters.error().message));
    const auto applier = Applier::create(**model, *parameters, Direction::reverse);
    REQUIRE(applier);
    return *applier;
}

} // namespace

TEST_CASE("a result has the same bits whole, in rows, in parts of rows, and from its end")
{
    for (const int kernel_size : { 1, 3 })
        for (const int channels : { 1, 3, 4 }) {
            CAPTURE(kernel_size);
            CAPTURE(channels);
            OIIO::ImageSpec spec(6001, 150, channels, OIIO::TypeFloat);
            NoiseSource source(spec);
            auto converter = PhotoConverter::create(spec, InputEncoding::srgb, "noise");
            REQUIRE(converter);
            const BandSettings settings{ std::make_shared<PhotoConverter>(std::move(*converter)),
                                         random_applier(kernel_size), true, false, 0 };
            const std::size_t values = std::size_t(settings.converter->output_spec().nchannels), row = 6001 * values;
            const auto read_in = [&](int rows_at_once) {
                std::vector<float> result(row * 150);
                BandReader reader(source, 0, 0, spec, settings);
                for (int y = 0; y < 150; y += rows_at_once)
                    REQUIRE(reader.read(0, 6001, y, std::min(y + rows_at_once, 150), result.data() + row * y, row));
                CHECK(reader.complete());
                CHECK(reader.counts().values == 6001 * 150 * 3);
                return result;
            };
            source.rows_read = 0;
            const std::vector<float> whole = read_in(150);
            CHECK(source.rows_read == 150);
            CHECK(read_in(67) == whole);
            CHECK(read_in(1) == whole);
            CHECK(source.rows_read == 450); // each once

            std::vector<float> parts(row * 150);
            BandReader reader(source, 0, 0, spec, settings);
            for (int y = 149; y >= 0; --y)
                for (const auto& [x0, x1] : { std::pair(0, 17), std::pair(17, 6001) })
                    REQUIRE(reader.read(x0, x1, y, y + 1, parts.data() + row * y + x0 * values, row));
            CHECK(parts == whole);
        }
}
