// SPDX-License-Identifier: Apache-2.0
#include "choice.h"

#include <future>

#include <srisp/neutral_rendition.h>
#include <srisp/select.h>

#include "../common/failure.h"
#include "../common/interrupt.h"
#include "../common/require.h"
#include "base/file_bytes.h"

namespace srisp::tool {

namespace {

constexpr std::size_t kLargestParameters = 1 << 20;
const char kFullModel[] = "default";

std::shared_ptr<const Model> pointwise_model(const std::string& name)
{
    auto model = require(Model::load(name));
    if (model->kernel_size() != 1)
        fail("model '" + name + "' looks at " + std::to_string(model->kernel_size()) + " x " +
             std::to_string(model->kernel_size()) +
             " pixels, and a colour transform sees one: needs a pointwise model (kernel size 1; 'pointwise' is one)");
    return model;
}

Parameters given_parameters(const std::string& path, const Model& model)
{
    auto text = read_head(path, kLargestParameters);
    if (!text)
        fail("parameters '" + path + "': " + text.error().message);
    const Parameters parameters = require(parameters_from_json(*text, "'" + path + "'"));
    if (const Status fits = check_parameters(parameters, model); !fits)
        fail("parameters '" + path + "': " + fits.error().message +
             " (srisptool PHOTO --srisp-params:model=pointwise REFERENCE prints such)");
    return parameters;
}

Parameters chosen_parameters(const Model& model, const Thumbnail& photo, const Reference& reference)
{
    Parameters parameters = require(select(model, photo, reference.thumbnail));
    parameters.reference_name = reference.name;
    parameters.reference_hash = reference.hash;
    return parameters;
}

} // namespace

Choice make_choice(const Options& options)
{
    Choice choice;
    choice.pointwise.model = pointwise_model(options.model);
    if (!options.parameters.empty())
        choice.pointwise.parameters = given_parameters(options.parameters, *choice.pointwise.model);
    auto reference = std::async(std::launch::async, [&] {
        return options.reference.empty() ? Expected<std::shared_ptr<const Reference>>(nullptr)
                                         : load_reference(options.reference);
    });
    if (!options.source.empty())
        choice.photo = read_photo_sample(options.source);
    choice.reference = require(reference.get());
    check_interrupt();
    if (!choice.reference)
        return choice;
    if (!choice.photo) {
        choice.photo = sample_of_thumbnail(neutral_rendition(*choice.reference), "the reference's neutral rendition");
        choice.photo_is_rendition = true;
    }
    auto full = std::async(std::launch::async, [&]() -> std::optional<Chosen> {
        const auto model = Model::load(kFullModel);
        if (!model || (*model)->kernel_size() == 1)
            return {};
        return Chosen{ *model, chosen_parameters(**model, choice.photo->thumbnail, *choice.reference) };
    });
    if (options.parameters.empty())
        choice.pointwise.parameters =
            chosen_parameters(*choice.pointwise.model, choice.photo->thumbnail, *choice.reference);
    choice.full = full.get();
    return choice;
}

} // namespace srisp::tool
