// SPDX-License-Identifier: Apache-2.0
#include "method.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>
#include <srisp/apply.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>

#include "../common/failure.h"
#include "base/hashes.h"
#include "rendering/rendering_steps.h"
#include "rendering/upi.h"

namespace srisp::tool {

namespace {

constexpr float kGamma = 2.2f;

std::string json_text(const Vector3& gains, const Matrix3* matrix)
{
    nlohmann::ordered_json json{ { "gamma", kGamma }, { "white_balance", gains } };
    if (matrix)
        json["color"] = *matrix;
    return json.dump();
}

class GainMatch : public Method {
public:
    Expected<MethodResult> unprocess(const Pixels& photo, const Pixels& reference, const std::string&) const override
    {
        MethodResult result{ photo, {}, {} };
        for (float& value : result.raw.rgb)
            value = std::pow(value, kGamma);
        const auto have = result.raw.means(), want = reference.means();
        constexpr double kSmallestMean = 1e-6;
        Vector3 gains; // of the forward pass, as a model's
        for (std::size_t c = 0; c < 3; ++c)
            gains[c] = float(std::max(have[c], kSmallestMean) / std::max(want[c], kSmallestMean));
        for (std::size_t i = 0; i < result.raw.rgb.size(); ++i)
            result.raw.rgb[i] = unit_clamped(result.raw.rgb[i] / gains[i % 3]);
        result.parameters = json_text(gains, nullptr);
        return result;
    }
};

class Upi : public Method {
public:
    explicit Upi(std::uint64_t seed) : m_seed(seed) {}

    Expected<MethodResult> unprocess(const Pixels& photo, const Pixels&, const std::string& key) const override
    {
        const UpiParameters parameters = draw_upi(Random(seeded_hash(m_seed, key)));
        MethodResult result{ photo, {}, json_text(parameters.gains, &parameters.to_camera) };
        for (std::size_t i = 0; i < result.raw.rgb.size(); i += 3) {
            const Vector3 v = unprocessed_by_upi(parameters, { photo.rgb[i], photo.rgb[i + 1], photo.rgb[i + 2] });
            std::copy(v.begin(), v.end(), &result.raw.rgb[i]);
        }
        return result;
    }

private:
    std::uint64_t m_seed;
};

class ModelMethod : public Method {
public:
    explicit ModelMethod(std::shared_ptr<const Model> model) : m_model(std::move(model)) {}

    Expected<MethodResult> unprocess(const Pixels& photo, const Pixels& reference, const std::string&) const override
    {
        const auto parameters = srisp::select(*m_model, make_thumbnail(photo.view()), make_thumbnail(reference.view()));
        if (!parameters)
            return parameters.error();
        const auto applier = Applier::create(*m_model, *parameters, Direction::reverse);
        if (!applier)
            return applier.error();
        MethodResult result{ Pixels(photo.width, photo.height), {}, to_json(*parameters) };
        ApplyOptions options;
        options.threads = 1;
        if (const Status done = (*applier)->run(photo.view(), result.raw.mutable_view(), options); !done)
            return done.error();
        if (parameters->brightness_sd_ev)
            result.log_deviation = *parameters->brightness_sd_ev * std::log(2.0f);
        return result;
    }

private:
    std::shared_ptr<const Model> m_model;
};

} // namespace

std::unique_ptr<Method> make_gain_match()
{
    auto method = std::make_unique<GainMatch>();
    method->name = "gain_match";
    method->origin = "photo^2.2 times one gain for each channel that gives the reference's channel means";
    return method;
}

std::unique_ptr<Method> make_upi(std::uint64_t seed)
{
    auto method = std::make_unique<Upi>(seed);
    method->name = "upi";
    method->origin = "random parameters that know neither photo nor reference (Brooks et al. 2019)";
    return method;
}

std::unique_ptr<Method> make_model_method(std::shared_ptr<const Model> model, std::string name)
{
    std::string origin = "model " + model->hash();
    const auto training = model->metadata().find("train_data");
    std::string known = training == model->metadata().end() ? "" : training->second;
    auto method = std::make_unique<ModelMethod>(std::move(model));
    method->name = std::move(name);
    method->origin = std::move(origin);
    method->training = std::move(known);
    return method;
}

Methods load_methods(const std::vector<std::string>& baselines, const std::vector<std::string>& models,
                     std::uint64_t seed)
{
    Methods methods;
    for (const std::string& name : baselines)
        methods.push_back(name == "upi" ? make_upi(seed) : make_gain_match());
    for (const std::string& path : models) {
        auto model = require(Model::load(path));
        std::string name = model->name();
        const auto is_taken = [&] {
            return std::any_of(methods.begin(), methods.end(), [&](const auto& one) { return one->name == name; });
        };
        for (int number = 2; is_taken(); ++number)
            name = model->name() + " " + std::to_string(number);
        methods.push_back(make_model_method(std::move(model), name));
    }
    return methods;
}

std::set<std::string> cameras_seen(const Methods& methods, const std::set<std::string>& cameras)
{
    std::set<std::string> seen;
    for (const auto& method : methods) {
        const std::size_t raws = method->training.find("RAW images: "); // as srisptrain writes it
        for (const std::string& camera : cameras)
            if (raws != std::string::npos && method->training.find(" " + camera + " (", raws) != std::string::npos)
                seen.insert(camera);
    }
    return seen;
}

} // namespace srisp::tool
