// SPDX-License-Identifier: Apache-2.0
#include "bake.h"

#include <cstdio>
#include <filesystem>
#include <future>
#include <memory>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/require.h"
#include "base/output_file.h"
#include "cube_file.h"
#include "ocio/src/clf_text.h"
#include "ocio/src/ocio_group.h"
#include "ocio/src/pipeline_operators.h"

namespace srisp::tool {

namespace {

std::string size_text(const ErrorSize& error)
{
    char text[80];
    std::snprintf(text, sizeof text, "largest %.2g, mean %.2g", error.largest, error.mean());
    return text;
}

std::string absolute_path(const std::string& path)
{
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error).lexically_normal();
    return error ? path : absolute.string();
}

std::string title(const Choice& choice, Direction direction)
{
    const std::string& name = choice.pointwise.parameters.reference_name;
    return std::string("srisp ") + direction_name(direction) + (name.empty() ? "" : " as " + name);
}

/// One for the pointwise pipeline and, where it was measured, one for the full one.
std::vector<std::string> error_sentences(const BakeErrors& errors, const Choice& choice, Direction direction)
{
    std::string pointwise = "Error against the pointwise pipeline: over a grid of colours " + size_text(errors.grid);
    if (errors.photo)
        pointwise += "; over " + choice.photo->name + " " + size_text(*errors.photo);
    std::vector<std::string> sentences = { pointwise + "." };
    if (errors.full)
        sentences.push_back("Difference to the full pipeline (model " + choice.full->model->name() + ") over " +
                            choice.photo->name + ": " + size_text(*errors.full) +
                            (direction == Direction::reverse ? "." : ", each from its own RAW-like image."));
    return sentences;
}

std::vector<std::string> descriptions(const Options& options, const Choice& choice, Direction direction,
                                      const std::vector<std::string>& sentences)
{
    const Parameters& parameters = choice.pointwise.parameters;
    std::vector<std::string> lines = {
        direction == Direction::reverse
            ? "Display-encoded sRGB to RAW-like linear camera RGB; synthetic, a guess and not sensor data."
            : "RAW-like linear camera RGB to display-encoded sRGB; the way back of the other direction."
    };
    if (!options.reference.empty())
        lines.push_back(reference_line(absolute_path(options.reference)));
    lines.push_back("Parameters: " + to_json(parameters, -1));
    lines.insert(lines.end(), sentences.begin(), sentences.end());
    return lines;
}

/// Everything about one file but writing it.
struct Baked {
    BakeReport report;
    std::string text;
};

BakeReport measured(const OutputName& name, const OCIO_NAMESPACE::ConstTransformRcPtr& transform, const Choice& choice)
{
    const BakeErrors errors = measure_errors(transform, choice, name.direction);
    return { name, 0, errors, error_sentences(errors, choice, name.direction) };
}

Baked bake_clf(const OutputName& name, const Options& options, const Choice& choice)
{
    const auto operators = require(
        pipeline_operators(*choice.pointwise.model, choice.pointwise.parameters, name.direction, options.lut_size));
    check_interrupt();
    Baked baked{ measured(name, ocio_group(operators), choice), {} };
    const ClfLabel label{ "srisp-" + std::string(direction_name(name.direction)), title(choice, name.direction),
                          descriptions(options, choice, name.direction, baked.report.sentences) };
    baked.text = clf_text(operators, label);
    return baked;
}

Baked bake_cube(const OutputName& name, const Options& options, const Choice& choice)
{
    const CubeTable table(choice.pointwise, name.direction, options.lut_size);
    check_interrupt();
    Baked baked{ measured(name, table.transform(), choice), {} };
    baked.text = table.text(title(choice, name.direction),
                            descriptions(options, choice, name.direction, baked.report.sentences));
    return baked;
}

/// All files are there under their temporary names before the first gets its own.
void write_files(std::vector<Baked>& files)
{
    std::vector<std::unique_ptr<OutputFile>> outputs;
    for (Baked& file : files) {
        outputs.push_back(std::make_unique<OutputFile>(file.report.name.path));
        outputs.back()->write(file.text);
        file.report.bytes = file.text.size();
        if (!outputs.back()->good())
            break;
        check_interrupt();
    }
    // What failed says why; finishing it removes it, and the others go unfinished.
    if (!outputs.back()->good())
        fail("output " + outputs.back()->finish().error().message);
    for (const auto& output : outputs)
        if (const Status status = output->finish(); !status)
            fail("output " + status.error().message);
}

} // namespace

BakeSummary bake(const Options& options)
{
    const std::vector<OutputName> names =
        output_names(options.reference, options.output, options.direction, options.cube);
    const Choice choice = make_choice(options);
    if (!options.reference.empty() && options.output.empty())
        for (const OutputName& name : names)
            if (!name.cube)
                refuse_bake_of_another(name.path, absolute_path(options.reference));
    BakeSummary summary{ choice.photo ? choice.photo->name : "", choice.full ? choice.full->model->name() : "", {} };
    std::vector<std::future<Baked>> bakes;
    for (const OutputName& name : names)
        bakes.push_back(std::async(std::launch::async, name.cube ? bake_cube : bake_clf, std::cref(name),
                                   std::cref(options), std::cref(choice)));
    std::vector<Baked> files;
    for (std::future<Baked>& each : bakes)
        files.push_back(each.get());
    check_interrupt();
    write_files(files);
    for (Baked& file : files)
        summary.files.push_back(std::move(file.report));
    return summary;
}

} // namespace srisp::tool
