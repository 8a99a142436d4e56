// SPDX-License-Identifier: Apache-2.0
#include "train/samples/sample_maker.h"

#include <ATen/Parallel.h>
#include <doctest/doctest.h>

#include "lib/train/small_pack.h"

using namespace srisp::train;

namespace {

struct SmallPack {
    SmallImages photos{ 12, 2, 9, 48, 1 }, raws{ 6, 0, 6, 48, 2 };
    SampleSources sources{ photos.images, raws.images, small_cameras(), nullptr };
};

DataSettings with_everything()
{
    DataSettings settings;
    settings.image_size = 32;
    settings.raw_share = 0.3;
    settings.blurred = 0.5;
    settings.smallest_detail = 12;
    settings.simulation.mixed_light = 0.5;
    settings.simulation.photo.histogram = 0.5;
    settings.simulation.photo.flattening = 0.5;
    settings.fixed_share = settings.camera_share = 0.3;
    settings.isp.local_contrast = settings.isp.channel_curves = 0.5;
    return settings;
}

std::unique_ptr<Samples> made(const DataSettings& settings, const SampleSources& sources, std::uint64_t seed)
{
    srisp::Expected<std::unique_ptr<Samples>> samples = make_samples(settings, sources, seed);
    REQUIRE(samples);
    return std::move(*samples);
}

bool equal(const Batch& a, const Batch& b)
{
    return torch::equal(a.source, b.source) && torch::equal(a.truth, b.truth) &&
           torch::equal(a.reference, b.reference) && torch::equal(a.unpaired_source, b.unpaired_source) &&
           torch::equal(a.unpaired_reference, b.unpaired_reference);
}

Batch joined(const Batch& a, const Batch& b)
{
    return { torch::cat({ a.source, b.source }), torch::cat({ a.truth, b.truth }),
             torch::cat({ a.reference, b.reference }), torch::cat({ a.unpaired_source, b.unpaired_source }),
             torch::cat({ a.unpaired_reference, b.unpaired_reference }) };
}

} // namespace

TEST_CASE("a batch is the same bits whenever it is asked for, and its halves are those of the whole")
{
    const SmallPack pack;
    const auto samples = made(with_everything(), pack.sources, 5), again = made(with_everything(), pack.sources, 5);
    const Batch whole = samples->batch(7, 0, 12, 0, 6);
    samples->batch(8, 0, 3, 0, 1);
    CHECK(equal(samples->batch(7, 0, 12, 0, 6), whole));
    CHECK(equal(joined(again->batch(7, 0, 5, 0, 2), again->batch(7, 5, 7, 2, 4)), whole));
    CHECK_FALSE(torch::equal(samples->batch(8, 0, 12, 0, 6).source, whole.source));
    CHECK_FALSE(torch::equal(made(with_everything(), pack.sources, 6)->batch(7, 0, 12, 0, 6).source, whole.source));
    for (int i = 1; i < 12; ++i)
        CHECK_FALSE(torch::equal(whole.source[i], whole.source[0]));
}

TEST_CASE("batches do not depend on the number of threads")
{
    const SmallPack pack;
    const auto samples = made(with_everything(), pack.sources, 5);
    const int threads = at::get_num_threads();
    at::set_num_threads(1);
    const Batch one = samples->batch(3, 0, 9, 0, 4);
    at::set_num_threads(3);
    const Batch three = samples->batch(3, 0, 9, 0, 4);
    at::set_num_threads(threads);
    CHECK(equal(one, three));
}

TEST_CASE("sources and truths are crops of a scene that was rendered whole")
{
    const SmallPack pack;
    DataSettings settings;
    settings.image_size = 32;
    settings.flip = settings.rotate = false;
    SampleMaker maker(settings, pack.sources, 5, torch::kCPU);
    const auto scenes = maker.scenes(2, 0, 30);
    const Batch batch = maker.batch(2, 0, 30, 0, 0);
    CHECK(scenes.raw.sizes() == at::IntArrayRef({ 30, 3, 48, 48 }));
    CHECK_FALSE(batch.unpaired_source.defined());
    std::vector<Window> sources, references;
    int split = 0, other = 0;
    for (const SampleGeometry& geometry : scenes.geometry) {
        sources.push_back(geometry.source);
        references.push_back(geometry.reference);
        split += geometry.kind == SampleGeometry::Reference::half_split;
        other += geometry.kind == SampleGeometry::Reference::other_scene;
    }
    CHECK(torch::equal(area_crop(scenes.rendered, sources, 32, 32), batch.source));
    CHECK(torch::equal(area_crop(scenes.raw, sources, 32, 32), batch.truth));
    CHECK(torch::equal(area_crop(scenes.reference_raw, references, 32, 32), batch.reference));
    REQUIRE(split > 0);
    REQUIRE(other > 0);
    for (int i = 0; i < 30; ++i) {
        const bool same = torch::equal(scenes.raw[i], scenes.reference_raw[i]);
        CHECK(same == (scenes.geometry[i].kind != SampleGeometry::Reference::other_scene));
    }
}

TEST_CASE("references come from another scene, a half or another crop in the shares that are asked for")
{
    DataSettings settings;
    int kinds[3] = {}, turns[4] = {}, mirrored = 0;
    double smallest = 1;
    for (int i = 0; i < 2000; ++i) {
        const SampleGeometry geometry = draw_geometry(settings, Random(1, 0, i));
        ++kinds[static_cast<int>(geometry.kind)];
        ++turns[geometry.quarter_turns];
        mirrored += geometry.mirrored;
        const Window &s = geometry.source, &r = geometry.reference;
        for (const Window& window : { s, r }) {
            CHECK(window.left >= 0);
            CHECK(window.top >= 0);
            CHECK(window.right <= 1 + 1e-12);
            CHECK(window.bottom <= 1 + 1e-12);
        }
        if (geometry.kind == SampleGeometry::Reference::half_split) {
            CHECK((s.right - s.left) * (s.bottom - s.top) == doctest::Approx(0.25));
            CHECK((r.right - r.left) * (r.bottom - r.top) == doctest::Approx(0.5));
            const bool apart = s.right <= r.left || r.right <= s.left || s.bottom <= r.top || r.bottom <= s.top;
            CHECK(apart);
        } else {
            smallest = std::min({ smallest, s.right - s.left, s.bottom - s.top, r.right - r.left });
        }
        CHECK(geometry.source_detail == 0);
    }
    CHECK(std::abs(kinds[0] / 2000.0 - 0.25) < 0.04);
    CHECK(std::abs(kinds[1] / 2000.0 - 0.40) < 0.045);
    CHECK(smallest > 0.4);
    CHECK(smallest < 0.41);
    CHECK(std::abs(mirrored / 2000.0 - 0.5) < 0.045);
    for (const int count : turns)
        CHECK(std::abs(count / 2000.0 - 0.25) < 0.04);
}

TEST_CASE("source, truth and reference of a sample are turned alike")
{
    SmallPack pack;
    // A picture that grows to the right: its turns and mirrors tell from gradients.
    for (std::size_t i = 0; i < pack.photos.pixels.size(); ++i)
        pack.photos.pixels[i] = static_cast<std::uint16_t>(8000 + 1000 * (i % 48));
    DataSettings settings;
    settings.image_size = 32;
    settings.other_scene = settings.half_split = 0;
    settings.smallest_crop = 1;
    settings.simulation.highest_unevenness = 0;
    const Batch batch = made(settings, pack.sources, 5)->batch(0, 0, 16, 0, 0);
    const auto direction = [](const torch::Tensor& image) {
        const double across = (image.slice(3, 16) - image.slice(3, 0, 16)).mean().item<double>();
        const double down = (image.slice(2, 16) - image.slice(2, 0, 16)).mean().item<double>();
        return std::abs(across) > std::abs(down) ? (across > 0 ? 0 : 1) : (down > 0 ? 2 : 3);
    };
    bool seen[4] = {};
    for (int i = 0; i < 16; ++i) {
        const int source = direction(batch.source.slice(0, i, i + 1));
        CHECK(direction(batch.truth.slice(0, i, i + 1)) == source);
        CHECK(direction(batch.reference.slice(0, i, i + 1)) == source);
        seen[source] = true;
    }
    CHECK(seen[0] + seen[1] + seen[2] + seen[3] >= 3);
}

TEST_CASE("only images for training are used, open ones if so asked, whole ones as often as asked")
{
    SmallImages images(10, 3, 6, 32, 1);
    images.images.entries[0].validation = true;
    for (int i = 1; i < 4; ++i)
        images.images.entries[i].validation = true;
    const SceneSource open(images.images, true, false), all(images.images, false, false);
    Random random(1);
    int wholes = 0;
    bool not_open = false;
    for (int i = 0; i < 1000; ++i) {
        const int entry = open.draw(0.3, random);
        CHECK(images.images.entries[entry].open);
        CHECK_FALSE(images.images.entries[entry].validation);
        wholes += entry % 4 == 0;
        not_open = not_open || !images.images.entries[all.draw(0.3, random)].open;
        CHECK(images.images.entries[open.draw_other(entry, true, 0.5, random)].scene !=
              images.images.entries[entry].scene);
    }
    CHECK(std::abs(wholes / 1000.0 - 0.3) < 0.06);
    CHECK(not_open);
    for (srisp::PackEntry& entry : images.images.entries)
        entry.white_balance = {};
    CHECK(SceneSource(images.images, true, true).empty());
}

TEST_CASE("real RAW images keep their truth up to exposure, and their references from other scenes are in their light")
{
    SmallPack pack;
    for (std::size_t i = 0; i < pack.raws.images.entries.size(); ++i)
        pack.raws.images.entries[i].white_balance = { 1.5f + 0.2f * i, 1.0f, 2.0f - 0.1f * i };
    for (std::uint16_t& value : pack.raws.pixels)
        value = static_cast<std::uint16_t>(4000 + value / 16);
    pack.sources.raws = pack.raws.images;
    DataSettings settings;
    settings.raw_share = 1;
    settings.other_scene = 1;
    settings.fixed_share = 1;
    SampleMaker maker(settings, pack.sources, 5, torch::kCPU);
    const auto scenes = maker.scenes(0, 0, 8);
    CHECK(torch::isfinite(scenes.rendered).all().item<bool>());
    const SceneSource source(pack.raws.images, true, true);
    for (int n = 0; n < 8; ++n) {
        bool found = false;
        for (int entry = 0; entry < 6; ++entry) {
            const auto ratio = scenes.raw[n] / source.images({ entry }, torch::kCPU)[0];
            if ((ratio.max() - ratio.min()).item<double>() > 1e-4)
                continue;
            found = true;
            // The reference balanced by the scene's own gains is some other scene balanced by its own.
            bool relit = false;
            for (int other = 0; other < 6; ++other) {
                auto light = torch::ones({ 3, 1, 1 });
                for (int c = 0; c < 3; ++c)
                    light[c] = source.entry(entry).white_balance[c] / source.entry(other).white_balance[c];
                const auto back = scenes.reference_raw[n] * light / source.images({ other }, torch::kCPU)[0];
                relit = relit || (other != entry && (back - ratio.mean()).abs().max().item<double>() < 1e-3);
            }
            CHECK(relit);
        }
        CHECK(found);
    }
}

TEST_CASE("what is rendered as cameras do has a range of exposures of its own")
{
    const SmallPack pack;
    DataSettings settings;
    settings.image_size = 32;
    settings.simulation.lowest_exposure = settings.simulation.highest_exposure = 0.02;
    settings.camera.lowest_exposure = settings.camera.highest_exposure = 1;
    settings.simulation.exposure_of = "percentile";
    const auto brightest = [&](double camera_share) {
        settings.camera_share = camera_share;
        const SampleMaker maker(settings, pack.sources, 5, torch::kCPU);
        return maker.scenes(1, 0, 8).raw.select(1, 1).flatten(1).quantile(0.97, 1);
    };
    CHECK(brightest(0).max().item<float>() < 0.05);
    CHECK(brightest(1).min().item<float>() > 0.5);
    const auto some = brightest(0.5) > 0.4;
    CHECK(some.any().item<bool>());
    CHECK_FALSE(some.all().item<bool>());
}

TEST_CASE("samples that cannot be made are refused in words")
{
    const SmallPack pack;
    DataSettings settings;
    SampleSources sources = pack.sources;
    sources.photos = {};
    CHECK(make_samples(settings, sources, 1).error().message ==
          "the pack has no photos for training that are open (open_only is on)");
    settings.open_only = false;
    CHECK(make_samples(settings, sources, 1).error().message == "the pack has no photos for training");
    sources = pack.sources;
    sources.raws = {};
    settings.raw_share = 0.5;
    CHECK(make_samples(settings, sources, 1).error().message ==
          "raw_share is 0.500000, and the pack has no RAW images for training whose white balance is known");
    sources = pack.sources;
    sources.cameras = {};
    CHECK(make_samples(settings, sources, 1).error().message == "the pack has no simulated camera for training");
}

TEST_CASE("samples say whether there are photos for the unpaired ones")
{
    const SmallPack pack;
    DataSettings settings;
    settings.raw_share = 1;
    CHECK(made(settings, pack.sources, 1)->has_unpaired());
    SampleSources sources = pack.sources;
    sources.photos = {};
    CHECK_FALSE(made(settings, sources, 1)->has_unpaired());
}

TEST_CASE("real RAW images alone are enough: other cameras' matrices are then published ones")
{
    const SmallPack pack;
    SampleSources sources = pack.sources;
    sources.photos = {};
    sources.cameras = {};
    DataSettings settings;
    settings.raw_share = 1;
    settings.open_only = false;
    settings.image_size = 32;
    const auto samples = made(settings, sources, 1);
    const Batch batch = samples->batch(0, 0, 6, 0, 0);
    CHECK(batch.source.sizes() == at::IntArrayRef({ 6, 3, 32, 32 }));
    for (const torch::Tensor& images : { batch.source, batch.truth, batch.reference }) {
        CHECK(images.isfinite().all().item<bool>());
        CHECK(images.amin().item<float>() >= 0);
        CHECK(images.amax().item<float>() <= 1);
        CHECK(images.std().item<float>() > 0.01);
    }
    CHECK(torch::equal(samples->batch(0, 2, 4, 0, 0).source, batch.source.slice(0, 2, 6)));
    CHECK_FALSE(torch::equal(samples->batch(1, 0, 6, 0, 0).source, batch.source));
}
