// SPDX-License-Identifier: Apache-2.0
#include <srisp/ocio_context.h>

#include <filesystem>
#include <string>

#include <srisp/model.h>
#include <srisp/neutral_rendition.h>
#include <srisp/ocio_transform.h>
#include <srisp/photo.h>
#include <srisp/reference.h>
#include <srisp/select.h>

#include "base/guarded.h"
#include "base/hashes.h"
#include "base/recently_kept.h"

namespace srisp {

namespace OCIO = OCIO_NAMESPACE;

namespace {

using Group = OCIO::ConstGroupTransformRcPtr;

const char kNeutral[] = "srisp_neutral", kDefaultModel[] = "default";
constexpr std::size_t kMostKept = 16; // 4 MB each

/// What our config's neutral bakes are.
Group neutral_transform(Direction direction)
{
    auto range = OCIO::RangeTransform::Create();
    range->setMinInValue(0);
    range->setMinOutValue(0);
    range->setMaxInValue(1);
    range->setMaxOutValue(1);
    auto curve = OCIO::ExponentWithLinearTransform::Create();
    curve->setGamma({ 2.4, 2.4, 2.4, 1 });
    curve->setOffset({ 0.055, 0.055, 0.055, 0 });
    curve->setDirection(direction == Direction::reverse ? OCIO::TRANSFORM_DIR_FORWARD : OCIO::TRANSFORM_DIR_INVERSE);
    auto group = OCIO::GroupTransform::Create();
    group->appendTransform(range);
    group->appendTransform(curve);
    return group;
}

/// A file as it is named, or as the context's search path finds it.
Expected<std::string> found_file(const OCIO::Context& context, const char* variable)
{
    const std::string name = context.getStringVar(variable);
    std::error_code ignored;
    if (std::filesystem::path(name).is_absolute() && std::filesystem::exists(name, ignored))
        return name; // as it is: a '$' in it is no variable
    try {
        return std::string(context.resolveFileLocation(name.c_str()));
    } catch (const OCIO::Exception& error) {
        return Error{ std::string(variable) + "='" + name + "': " + error.what() };
    }
}

Expected<Group> make(const Model& model, const Reference& reference, const std::string& source, Direction direction)
{
    const auto photo =
        source.empty() ? Expected<Thumbnail>(neutral_rendition(reference)) : load_photo_thumbnail(source);
    if (!photo)
        return Error{ "SRISP_SOURCE: " + photo.error().message };
    const auto parameters = select(model, *photo, reference.thumbnail);
    if (!parameters)
        return parameters.error();
    const auto group = make_ocio_transform(model, *parameters, direction);
    if (!group)
        return Error{ "SRISP_MODEL: " + group.error().message };
    return Group(*group);
}

Expected<Group> kept_or_made(const OCIO::Context& context, Direction direction)
{
    // Never destroyed: other threads of the host may still ask while statics end.
    static auto& kept = *new RecentlyKept<Group>(kMostKept);
    const auto reference_path = found_file(context, "SRISP_REFERENCE");
    if (!reference_path)
        return reference_path.error();
    const auto reference = load_reference_cached(*reference_path);
    if (!reference)
        return Error{ "SRISP_REFERENCE: " + reference.error().message };
    std::string source, source_hash;
    if (*context.getStringVar("SRISP_SOURCE")) {
        const auto path = found_file(context, "SRISP_SOURCE");
        const auto hash = path ? hash_of_file(*path) : path;
        if (!hash)
            return hash.error();
        source = *path;
        source_hash = *hash;
    }
    const std::string model_name = context.getStringVar("SRISP_MODEL");
    const auto model = Model::load(model_name.empty() ? kDefaultModel : model_name);
    if (!model)
        return Error{ "SRISP_MODEL: " + model.error().message };
    const std::string key = (*reference)->hash + " " + source_hash + " " + (*model)->hash() +
                            (direction == Direction::reverse ? " reverse" : " forward");
    if (Group group = kept.find(key))
        return group;
    const auto group = make(**model, **reference, source, direction);
    return group ? Expected<Group>(kept.keep(key, *group)) : group;
}

} // namespace

Expected<Group> transform_from_context(const OCIO::ConstConfigRcPtr& config, const OCIO::ConstContextRcPtr& context,
                                       Direction direction)
{
    return guarded("transform from context", {}, [&]() -> Expected<Group> {
        if (!config)
            return Error{ "transform from context: no config is given" };
        const OCIO::ConstContextRcPtr used = context ? context : config->getCurrentContext();
        const std::string reference = used->getStringVar("SRISP_REFERENCE");
        if (reference.empty())
            return Error{ "context variable SRISP_REFERENCE is not set; it is the path of the reference's RAW file" };
        return reference == kNeutral ? neutral_transform(direction) : kept_or_made(*used, direction);
    });
}

} // namespace srisp
