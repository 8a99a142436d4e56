// SPDX-License-Identifier: Apache-2.0
// OpenColorIO's pixels against the library's.
#include <doctest/doctest.h>
#include <srisp/ocio_transform.h>

#include "image_compare.h"
#include "ocio/ocio_pixels.h"

using namespace srisp;

namespace {

// Photos are to be within 2e-3, ramps within 1e-3; a grid holds colours that no photo has. (Measured: 5.2e-4, 4e-6, and
// near white 4.1e-4.)
constexpr double kGridLimit = 1e-3, kGridMean = 2e-5, kNearWhiteLimit = 5e-4;

double mean_difference(const Colors& a, const Colors& b)
{
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        sum += std::abs(double(a[i]) - b[i]);
    return sum / a.size();
}

/// The sample's parameters, and edited ones in which each kind of gain occurs.
std::vector<Parameters> parameter_sets(const Model& model)
{
    std::vector<Parameters> sets(8, sample_parameters(model));
    sets[1].gain = 0.6f;
    sets[1].white_balance = { 1.9f, 1, 1.5f };
    sets[2].gain = 3;
    sets[2].white_balance = { 0.7f, 1, 2.4f };
    sets[3].gain = 0.9f;
    sets[3].white_balance = { 0.8f, 1, 0.6f };
    sets[4].gain = 1.5f;
    sets[4].white_balance = { 1, 1, 1 };
    sets[4].color = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    sets[5].gain = 0.15f;
    sets[5].white_balance = { 2.2f, 1, 1.6f };
    sets[6].gain = 0.999f;
    sets[6].white_balance = { 1, 1.05f, 1.9f };
    sets[7].gain = 0.999999f;
    sets[7].white_balance = { 1.9f, 1, 1.5f };
    return sets;
}

} // namespace

TEST_CASE("the transform gives the library's pixels over a dense grid and near white, in both directions")
{
    const auto model = default_model();
    const Colors grid = dense_grid(48), white = near_white(20000);
    for (const Parameters& parameters : parameter_sets(*model))
        for (const Direction direction : { Direction::reverse, Direction::forward }) {
            const auto transform = require(make_ocio_transform(*model, parameters, direction));
            const auto compared = [&](const Colors& in, Difference& difference) {
                const Colors actual = through_ocio(transform, in);
                const Colors expected = through_library(*model, parameters, direction, in);
                difference = compare(actual, expected);
                return mean_difference(actual, expected);
            };
            Difference over_grid, over_white;
            const double grid_mean = compared(grid, over_grid);
            compared(white, over_white);
            INFO((direction == Direction::reverse ? "reverse" : "forward"), ", gain ", parameters.gain,
                 ", white balance ", parameters.white_balance[0], " ", parameters.white_balance[2],
                 "; grid: ", over_grid.text, ", mean ", grid_mean, "; near white: ", over_white.text);
            CHECK(over_grid.largest <= kGridLimit);
            CHECK(grid_mean <= kGridMean);
            CHECK(over_white.largest <= kNearWhiteLimit);
        }
}

TEST_CASE("a CLF file is the same transform, and says what its label says")
{
    const auto model = default_model();
    const Parameters parameters = sample_parameters(*model);
    const ScratchFolder folder;
    const ClfLabel label{ "id", "name <&> \"größe\"", { "first", "second & third\n" } };
    for (const Direction direction : { Direction::reverse, Direction::forward }) {
        const std::string path = folder.path(direction == Direction::reverse ? "r.clf" : "f.clf");
        write_file(path, require(make_clf(*model, parameters, direction, label, 33)));
        const auto file = OCIO::FileTransform::Create();
        file->setSrc(path.c_str());
        const Colors colors = near_white(3000), grid = dense_grid(20);
        const auto transform = require(make_ocio_transform(*model, parameters, direction, 33));
        for (const Colors& in : { colors, grid }) {
            const Difference difference = compare(through_ocio(file, in), through_ocio(transform, in));
            INFO(difference.text);
            CHECK(difference.largest <= 2e-6);
        }
        const auto group = OCIO::Config::CreateRaw()->getProcessor(file)->createGroupTransform();
        const OCIO::FormatMetadata& said = group->getFormatMetadata();
        CHECK(std::string(said.getID()) == label.id);
        CHECK(std::string(said.getName()) == label.name);
        REQUIRE(said.getNumChildrenElements() == 2);
        CHECK(std::string(said.getChildElement(1).getElementValue()) == "second & third?");
    }
}

TEST_CASE("more points make smaller errors")
{
    const auto model = default_model();
    const Parameters parameters = sample_parameters(*model);
    const Colors grid = dense_grid(30), expected = through_library(*model, parameters, Direction::reverse, grid);
    double last = 1;
    for (const int size : { 9, 17, 33, 65 }) {
        const auto transform = require(make_ocio_transform(*model, parameters, Direction::reverse, size));
        const double mean = mean_difference(through_ocio(transform, grid), expected);
        INFO(size, " points: ", mean);
        CHECK(mean < 0.6 * last);
        last = mean;
    }
}

TEST_CASE("models that look at neighbours, parameters of others, and sizes that no host takes are refused")
{
    const auto model = default_model();
    const Parameters parameters = sample_parameters(*model);
    const auto message = [](auto result) { return result ? std::string() : result.error().message; };
    for (const int size : { 4, 130, -1 })
        CHECK(message(make_ocio_transform(*model, parameters, Direction::reverse, size)) ==
              "LUT size " + std::to_string(size) + " must be within 5 … 129");
    const auto spatial = require(Model::load(std::string(SRISP_SOURCE_DIR) + "/configs/models/spatial.safetensors"));
    CHECK(message(make_ocio_transform(*spatial, sample_parameters(*spatial), Direction::reverse)) ==
          "model 'spatial': its tone map looks at 3 x 3 pixels, and a table holds single colours: needs a model "
          "with kernel size 1, such as 'default'");
    CHECK(message(make_clf(*model, sample_parameters(*spatial), Direction::forward, {})).find("spatial") !=
          std::string::npos);
}

TEST_CASE("process undoes unprocess in OpenColorIO as well as in the library")
{
    const auto model = default_model();
    const Parameters parameters = sample_parameters(*model);
    const Colors grid = dense_grid(40);
    const Colors raw = through_ocio(require(make_ocio_transform(*model, parameters, Direction::reverse)), grid);
    const Colors back = through_ocio(require(make_ocio_transform(*model, parameters, Direction::forward)), raw);
    const Colors library = through_library(*model, parameters, Direction::forward,
                                           through_library(*model, parameters, Direction::reverse, grid));
    const double ocio_error = mean_difference(back, grid), library_error = mean_difference(library, grid);
    INFO("mean error of the round trip: OpenColorIO ", ocio_error, ", library ", library_error);
    CHECK(ocio_error <= library_error + 1e-4);
    CHECK(mean_difference(back, library) <= 1e-4);
}
