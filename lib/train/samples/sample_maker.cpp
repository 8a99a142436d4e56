// SPDX-License-Identifier: Apache-2.0
#include "train/samples/sample_maker.h"

#include <array>
#include <cmath>

#include "train/tensors/color.h"

namespace srisp::train {

namespace {

/// Purposes of random numbers within a sample.
enum Purpose {
    kGeometry,
    kSource,
    kScene,
    kOtherScene,
    kCapture,
    kSimulation,
    kOtherSimulation,
    kExposure,
    kMatrices,
    kIsp,
    kRendering,
    kPhoto
};

using Indices = std::vector<std::int64_t>;

template<class Value> std::vector<Value> selected(const std::vector<Value>& values, const Indices& which)
{
    std::vector<Value> result;
    for (const auto i : which)
        result.push_back(values[i]);
    return result;
}

Indices where(const std::vector<bool>& mask, bool value)
{
    Indices result;
    for (std::size_t i = 0; i < mask.size(); ++i)
        if (mask[i] == value)
            result.push_back(static_cast<std::int64_t>(i));
    return result;
}

torch::Tensor index_tensor(const Indices& which, const torch::Device& device)
{
    return torch::tensor(which, torch::kLong).to(device);
}

enum Rendering { kFixed, kCamera, kRandom, kRenderings };

/// `random` is what remains for the rendering afterwards.
Rendering draw_rendering(const DataSettings& settings, Random& random)
{
    const double number = random.uniform();
    if (number < settings.fixed_share)
        return kFixed;
    return number < settings.fixed_share + settings.camera_share ? kCamera : kRandom;
}

/// Gains [N, 3, 1, 1] that turn the light of RAW `entries` into that of `others`.
torch::Tensor relighting(const SceneSource& source, const std::vector<int>& entries, const std::vector<int>& others)
{
    auto gains = torch::ones({ static_cast<std::int64_t>(entries.size()), 3, 1, 1 });
    for (std::size_t i = 0; i < entries.size(); ++i)
        for (const int c : { 0, 2 })
            gains[i][c] = source.entry(entries[i]).white_balance[c] / source.entry(others[i]).white_balance[c];
    return gains;
}

} // namespace

struct SampleMaker::Exposures {
    torch::Tensor raw, reference_raw;
    torch::Tensor white_balance; ///< [N, 3]
    torch::Tensor color;         ///< [N, 3, 3], the camera's own matrix; for real RAW without one, another camera's
    torch::Tensor others;        ///< [N, K, 3, 3], other cameras' matrices
};

SampleMaker::SampleMaker(const DataSettings& settings, const SampleSources& sources, std::uint64_t seed,
                         const torch::Device& device)
    : m_settings(settings), m_sources(sources), m_seed(seed), m_device(device),
      m_photos(m_sources.photos, settings.open_only, false), m_raws(m_sources.raws, settings.open_only, true),
      m_cameras(m_sources.cameras)
{
}

Status SampleMaker::check() const
{
    const std::string whose = m_settings.open_only ? " for training that are open (open_only is on)" : " for training";
    if (m_settings.raw_share < 1 && m_photos.empty())
        return Error{ "the pack has no photos" + whose };
    if (m_settings.raw_share > 0 && m_raws.empty())
        return Error{ "raw_share is " + std::to_string(m_settings.raw_share) + ", and the pack has no RAW images" +
                      whose + " whose white balance is known" };
    if (m_settings.fixed_share + m_settings.camera_share > 1)
        return Error{ "fixed_share and camera_share are " + std::to_string(m_settings.fixed_share) + " and " +
                      std::to_string(m_settings.camera_share) + ", at most 1 together" };
    if (m_settings.raw_share < 1 && !m_cameras.has(false))
        return Error{ "the pack has no simulated camera for training" };
    return {};
}

SampleMaker::Exposures SampleMaker::simulated(const Randoms& randoms, const std::vector<bool>& other_scene) const
{
    std::vector<Capture> captures;
    std::vector<int> entries;
    for (const Random& random : randoms) {
        captures.push_back(draw_capture(m_settings.simulation, m_cameras, false, random.fork(kCapture)));
        Random scene = random.fork(kScene), rendering = random.fork(kRendering), exposure = random.fork(kExposure);
        // Those others make up for a wrong exposure; a camera does not, and most photos that are kept have a right one.
        if (draw_rendering(m_settings, rendering) == kCamera)
            captures.back().exposure =
                exposure.log_uniform(m_settings.camera.lowest_exposure, m_settings.camera.highest_exposure);
        entries.push_back(m_photos.draw(m_settings.whole_share, scene));
    }
    const auto simulation = fork(randoms, kSimulation);
    const auto scenes = camera_scenes(m_settings.simulation, m_photos.images(entries, m_device), captures, simulation);
    const auto factors = exposure_factors(m_settings.simulation, scenes, captures);
    Exposures result;
    result.raw = result.reference_raw = expose(scenes, factors, captures, simulation);

    const Indices with_other = where(other_scene, true);
    if (!with_other.empty()) {
        std::vector<int> others;
        for (const auto i : with_other) {
            Random scene = randoms[i].fork(kOtherScene);
            others.push_back(m_photos.draw_other(entries[i], false, m_settings.whole_share, scene));
        }
        const auto same = selected(captures, with_other);
        const auto other_simulation = fork(selected(randoms, with_other), kOtherSimulation);
        const auto index = index_tensor(with_other, m_device);
        const auto other_scenes =
            camera_scenes(m_settings.simulation, m_photos.images(others, m_device), same, other_simulation);
        const auto other_raw = expose(other_scenes, factors.index_select(0, index), same, other_simulation);
        result.reference_raw = result.raw.index_copy(0, index, other_raw);
    }
    auto matrix_randoms = fork(randoms, kMatrices);
    result.white_balance = white_balances(captures);
    result.color = color_matrices(captures);
    result.others = other_color_matrices(m_cameras, captures, m_settings.isp.mixed_matrices, matrix_randoms);
    return result;
}

SampleMaker::Exposures SampleMaker::real(const Randoms& randoms, const std::vector<bool>& other_scene) const
{
    std::vector<Capture> captures; // for the light that other cameras' matrices are taken in
    std::vector<int> entries, others;
    std::vector<float> factors;
    const auto count = static_cast<std::int64_t>(randoms.size());
    auto balances = torch::empty({ count, 3 });
    for (std::int64_t i = 0; i < count; ++i) {
        if (m_cameras.has(false)) {
            captures.push_back(draw_capture(m_settings.simulation, m_cameras, false, randoms[i].fork(kCapture)));
            captures.back().camera = -1;
        }
        Random scene = randoms[i].fork(kScene), other = randoms[i].fork(kOtherScene);
        entries.push_back(m_raws.draw(m_settings.whole_share, scene));
        others.push_back(other_scene[i] ? m_raws.draw_other(entries[i], true, m_settings.whole_share, other)
                                        : entries[i]);
        Random exposure = randoms[i].fork(kExposure);
        factors.push_back(
            static_cast<float>(exposure.log_uniform(m_settings.lowest_raw_exposure, m_settings.highest_raw_exposure)));
        const auto& gains = m_raws.entry(entries[i]).white_balance;
        std::copy(gains.begin(), gains.end(), balances[i].data_ptr<float>());
    }
    const auto factor = torch::tensor(factors).view({ count, 1, 1, 1 }).to(m_device);
    Exposures result;
    result.raw = (m_raws.images(entries, m_device) * factor).clamp(0, 1);
    const auto relight = relighting(m_raws, others, entries).to(m_device);
    result.reference_raw = (m_raws.images(others, m_device) * (factor * relight)).clamp(0, 1);
    auto matrix_randoms = fork(randoms, kMatrices);
    result.white_balance = balances;
    result.others = captures.empty()
                        ? dnd_color_matrices(m_settings.isp.mixed_matrices, matrix_randoms)
                        : other_color_matrices(m_cameras, captures, m_settings.isp.mixed_matrices, matrix_randoms);
    result.color = result.others.select(1, 0).clone();
    for (std::int64_t i = 0; i < count; ++i)
        if (const auto& known = m_raws.entry(entries[i]).color; known != std::array<float, 9>{})
            std::copy(known.begin(), known.end(), result.color[i].data_ptr<float>());
    return result;
}

SampleMaker::Exposures SampleMaker::expose_scenes(const Randoms& randoms, const std::vector<bool>& other_scene) const
{
    std::vector<bool> from_raw;
    for (const Random& random : randoms) {
        Random source = random.fork(kSource);
        from_raw.push_back(source.chance(m_settings.raw_share));
    }
    const Indices photos = where(from_raw, false), raws = where(from_raw, true);
    if (raws.empty())
        return simulated(randoms, other_scene);
    if (photos.empty())
        return real(randoms, other_scene);
    const Exposures first = simulated(selected(randoms, photos), selected(other_scene, photos));
    const Exposures second = real(selected(randoms, raws), selected(other_scene, raws));
    // Where each sample went in the concatenation.
    Indices place(randoms.size());
    for (std::size_t i = 0; i < photos.size(); ++i)
        place[photos[i]] = i;
    for (std::size_t i = 0; i < raws.size(); ++i)
        place[raws[i]] = photos.size() + i;
    const auto merge = [&](const torch::Tensor& a, const torch::Tensor& b) {
        return torch::cat({ a, b }).index_select(0, index_tensor(place, a.device()));
    };
    return { merge(first.raw, second.raw), merge(first.reference_raw, second.reference_raw),
             merge(first.white_balance, second.white_balance), merge(first.color, second.color),
             merge(first.others, second.others) };
}

torch::Tensor SampleMaker::render(const Exposures& exposures, const Randoms& randoms) const
{
    std::array<Indices, kRenderings> chosen;
    auto choices = fork(randoms, kRendering);
    for (std::size_t i = 0; i < choices.size(); ++i)
        chosen[draw_rendering(m_settings, choices[i])].push_back(static_cast<std::int64_t>(i));
    auto rendered = torch::empty_like(exposures.raw);
    for (int kind = 0; kind < kRenderings; ++kind) {
        if (chosen[kind].empty())
            continue;
        const auto index = index_tensor(chosen[kind], m_device);
        const auto pick = [&index](const torch::Tensor& values) {
            return values.index_select(0, index.to(values.device()));
        };
        auto isp_randoms = fork(selected(randoms, chosen[kind]), kIsp);
        auto some_choices = selected(choices, chosen[kind]);
        const auto raw = pick(exposures.raw), balance = pick(exposures.white_balance);
        const auto color = pick(exposures.color), others = pick(exposures.others);
        torch::Tensor photos;
        if (kind == kFixed) {
            const auto target = per_image(some_choices, m_device, [&](Random& draw) {
                return draw.uniform(m_settings.lowest_fixed_target, m_settings.highest_fixed_target);
            });
            photos = render_fixed(raw, balance, color, target);
        } else if (kind == kCamera) {
            const auto gains = per_image(some_choices, m_device,
                                         [&](Random& draw) { return draw_camera_gain(m_settings.camera, draw); });
            photos = render_camera(m_settings.camera, raw, balance, color, others, gains, isp_randoms);
        } else {
            photos = render_random(m_settings.isp, raw, balance, others, isp_randoms);
        }
        rendered.index_copy_(0, index, photos);
    }
    return rendered;
}

SampleMaker::Scenes SampleMaker::scenes(std::int64_t step, int first, int count) const
{
    Randoms randoms;
    std::vector<SampleGeometry> geometry;
    std::vector<bool> other_scene;
    for (int i = first; i < first + count; ++i) {
        randoms.emplace_back(m_seed, std::uint64_t(step) * 2, i);
        geometry.push_back(draw_geometry(m_settings, randoms.back().fork(kGeometry)));
        other_scene.push_back(geometry.back().kind == SampleGeometry::Reference::other_scene);
    }
    const Exposures exposures = expose_scenes(randoms, other_scene);
    return { exposures.raw, exposures.reference_raw, render(exposures, randoms), std::move(geometry) };
}

Batch SampleMaker::batch(std::int64_t step, int first_pair, int pairs, int first_unpaired, int unpaired)
{
    const torch::NoGradGuard no_gradients;
    const int size = m_settings.image_size;
    Batch batch;
    if (pairs > 0) {
        const Scenes all = scenes(step, first_pair, pairs);
        batch.source = cut(all.rendered, all.geometry, &SampleGeometry::source, &SampleGeometry::source_detail, size);
        batch.truth = cut(all.raw, all.geometry, &SampleGeometry::source, &SampleGeometry::source_detail, size);
        batch.reference =
            cut(all.reference_raw, all.geometry, &SampleGeometry::reference, &SampleGeometry::reference_detail, size);
    }
    if (unpaired > 0) {
        TORCH_CHECK(has_unpaired(), "unpaired samples need photos, and the pack has none for training");
        Randoms randoms;
        std::vector<SampleGeometry> geometry;
        std::vector<int> photos;
        for (int i = first_unpaired; i < first_unpaired + unpaired; ++i) {
            randoms.emplace_back(m_seed, std::uint64_t(step) * 2 + 1, i);
            Random crops = randoms.back().fork(kGeometry), scene = randoms.back().fork(kPhoto);
            geometry.push_back(draw_geometry(m_settings, crops));
            geometry.back().source = draw_crop(m_settings, crops);
            geometry.back().reference = draw_crop(m_settings, crops);
            photos.push_back(m_photos.draw(m_settings.whole_share, scene));
        }
        const Exposures exposures = expose_scenes(randoms, std::vector<bool>(randoms.size()));
        batch.unpaired_source = cut(m_photos.images(photos, m_device), geometry, &SampleGeometry::source,
                                    &SampleGeometry::source_detail, size);
        batch.unpaired_reference =
            cut(exposures.raw, geometry, &SampleGeometry::reference, &SampleGeometry::reference_detail, size);
    }
    return batch;
}

Expected<std::unique_ptr<Samples>> make_samples(const DataSettings& settings, const SampleSources& sources,
                                                std::uint64_t seed, const torch::Device& device)
{
    auto maker = std::make_unique<SampleMaker>(settings, sources, seed, device);
    if (Status status = maker->check(); !status)
        return status.error();
    return std::unique_ptr<Samples>(std::move(maker));
}

Expected<std::unique_ptr<Samples>> make_samples(const DataSettings& settings, std::shared_ptr<const TrainingPack> pack,
                                                std::uint64_t seed, const torch::Device& device)
{
    return make_samples(settings, SampleSources{ pack->photos(), pack->raws(), pack->cameras(), pack }, seed, device);
}

} // namespace srisp::train
