// SPDX-License-Identifier: Apache-2.0
#include "bake.h"

#include <filesystem>
#include <future>
#include <memory>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "bake_choice.h"
#include "bake_options.h"
#include "base/input_files.h"
#include "base/output_file.h"
#include "base/printed.h"
#include "base/shown_text.h"
#include "ocio/src/operators.h"

namespace srisp::tool {

namespace OCIO = OCIO_NAMESPACE;

namespace {

std::string one_line(const std::string& name)
{
    std::string text = valid_utf8(name);
    for (char& c : text)
        if (static_cast<unsigned char>(c) < 0x20 || c == '"')
            c = ' ';
    return text;
}

/// One table of `size`³ colours over [0,1]³ for the whole pipeline, for programs that know nothing else.
class CubeTable {
public:
    /// Throws Failure.
    CubeTable(const BakeChoice& choice, Direction direction, int size);

    /// What such a program does with it, tetrahedral.
    OCIO::ConstTransformRcPtr transform() const;
    /// A .cube file; each line of `comments` becomes a comment. [Adobe Cube LUT 1.0]
    std::string text(const std::string& title, const std::vector<std::string>& comments) const;

private:
    int m_size;
    std::vector<float> m_rgb; ///< red runs fastest
};

CubeTable::CubeTable(const BakeChoice& choice, Direction direction, int size) : m_size(size)
{
    for (int b = 0; b < size; ++b)
        for (int g = 0; g < size; ++g)
            for (int r = 0; r < size; ++r)
                for (const int i : { r, g, b })
                    m_rgb.push_back(float(i) / float(size - 1));
    const MutableImageView colors{ m_rgb.data(), size * size, size, 3, std::ptrdiff_t(3) * size * size };
    require(require(Applier::create(*choice.model, choice.parameters, direction))->run(colors, colors));
}

OCIO::ConstTransformRcPtr CubeTable::transform() const
{
    auto lut = OCIO::Lut3DTransform::Create(m_size);
    lut->setInterpolation(OCIO::INTERP_TETRAHEDRAL);
    const float* rgb = m_rgb.data();
    for (int b = 0; b < m_size; ++b)
        for (int g = 0; g < m_size; ++g)
            for (int r = 0; r < m_size; ++r, rgb += 3)
                lut->setValue(r, g, b, rgb[0], rgb[1], rgb[2]);
    return lut;
}

std::string CubeTable::text(const std::string& title, const std::vector<std::string>& comments) const
{
    std::string text;
    for (const std::string& comment : comments)
        text += "# " + one_line(comment) + "\n";
    text += "TITLE \"" + one_line(title) + "\"\nLUT_3D_SIZE " + std::to_string(m_size) + "\n";
    for (std::size_t i = 0; i < m_rgb.size(); i += 3)
        text += printed("%.7g %.7g %.7g\n", double(m_rgb[i]), double(m_rgb[i + 1]), double(m_rgb[i + 2]));
    return text;
}

/// Of what is no development.
Direction direction_of(BakeKind kind)
{
    return kind == BakeKind::process ? Direction::forward : Direction::reverse;
}

std::string absolute_path(const std::string& path)
{
    std::error_code error;
    const std::filesystem::path absolute = std::filesystem::absolute(path, error).lexically_normal();
    return error ? path : absolute.string();
}

std::string title(const BakeChoice& choice, BakeKind kind)
{
    const std::string& name = choice.parameters.reference_name;
    return std::string("srisp ") + kind_name(kind) + (name.empty() ? "" : " as " + name);
}

std::vector<std::string> descriptions(const BakeOptions& options, const BakeChoice& choice, BakeKind kind,
                                      const std::string& errors)
{
    static const char* const kWhat[] = {
        "Display-encoded sRGB to RAW-like linear camera RGB; synthetic, a guess and not sensor data.",
        "RAW-like linear camera RGB to display-encoded sRGB; the way back of the other direction.",
        "Linear camera RGB of the reference's camera to ACES2065-1; exact. Its inverse is the way back."
    };
    std::vector<std::string> lines = { kWhat[int(kind)] };
    if (!options.reference.empty())
        lines.push_back(reference_line(absolute_path(options.reference)));
    lines.push_back("Parameters: " + to_json(choice.parameters, -1));
    if (kind == BakeKind::develop)
        lines.push_back("Development: " + to_json(choice.development));
    lines.push_back(errors);
    return lines;
}

/// Everything about one file but writing it.
struct Baked {
    BakeReport report;
    std::string text;
};

BakeReport measured(const OutputName& name, const OCIO::ConstTransformRcPtr& transform, const BakeChoice& choice)
{
    const BakeErrors errors = measure_errors(transform, choice, name.kind);
    return { name, 0, errors, error_sentence(errors, choice) };
}

Baked bake_clf(const OutputName& name, const BakeOptions& options, const BakeChoice& choice)
{
    const auto operators =
        name.kind == BakeKind::develop
            ? development_operators(choice.development)
            : require(pipeline_operators(*choice.model, choice.parameters, direction_of(name.kind), options.lut_size));
    check_interrupt();
    Baked baked{ measured(name, ocio_group(operators), choice), {} };
    const ClfLabel label{ "srisp-" + std::string(kind_name(name.kind)), title(choice, name.kind),
                          descriptions(options, choice, name.kind, baked.report.sentence) };
    baked.text = clf_text(operators, label);
    return baked;
}

Baked bake_cube(const OutputName& name, const BakeOptions& options, const BakeChoice& choice)
{
    const CubeTable table(choice, direction_of(name.kind), options.lut_size);
    check_interrupt();
    Baked baked{ measured(name, table.transform(), choice), {} };
    baked.text = table.text(title(choice, name.kind), descriptions(options, choice, name.kind, baked.report.sentence));
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
    check_interrupt(); // one ends the waiting for a pipe's reader
    // What failed says why; finishing it removes it, and the others go unfinished.
    if (!outputs.back()->good())
        fail("output " + outputs.back()->finish().error().message);
    for (const auto& output : outputs)
        if (const Status status = output->finish(); !status)
            fail("output " + status.error().message);
}

/// Before any work. Throws Failure.
void refuse_inputs_as_outputs(const BakeOptions& options, const std::vector<OutputName>& names)
{
    InputFiles inputs;
    for (const std::string& file : reference_files(options.reference))
        inputs.add(file == options.reference ? "reference" : "description of the reference", file);
    inputs.add("photo", options.source);
    inputs.add("parameter file", options.parameters);
    if (const auto model = Model::load(options.model))
        inputs.add("model", (*model)->path());
    for (const OutputName& name : names)
        require(inputs.check_output(name.path));
}

/// Each with the name of the file that it is about.
std::vector<std::string> notes_of(const BakeChoice& choice, const BakeOptions& options)
{
    std::vector<std::string> notes;
    if (choice.photo)
        for (const std::string& note : choice.photo->notes)
            notes.push_back("photo '" + options.source + "': " + note);
    for (const std::string& note : choice.notes)
        notes.push_back(
            (options.reference.empty() ? "parameters '" + options.parameters : "reference '" + options.reference) +
            "': " + note);
    return notes;
}

} // namespace

BakeSummary bake(const BakeOptions& options)
{
    const std::vector<OutputName> names =
        output_names(options.reference, options.output, options.direction, options.cube);
    refuse_inputs_as_outputs(options, names);
    const BakeChoice choice = make_choice(options);
    if (!options.reference.empty() && options.output.empty())
        for (const OutputName& name : names)
            if (!name.cube)
                refuse_bake_of_another(name.path, absolute_path(options.reference));
    BakeSummary summary{ choice.photo ? choice.photo->name : "", {}, notes_of(choice, options) };
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
