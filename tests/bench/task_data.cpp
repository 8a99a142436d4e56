// SPDX-License-Identifier: Apache-2.0
#include "task_data.h"

#include <algorithm>
#include <stdexcept>

#include "train/samples/packed_images.h"
#include "train/tensors/random.h"
#include "train/tensors/resize.h"

using namespace srisp::train;

namespace {

/// What random numbers are drawn for.
enum Stream : std::uint64_t { kLight = 1, kTest, kTraining, kReferences, kReferencePhotos, kReferenceOfImage };

constexpr int kTestExposures = 4;           // of each test photo
constexpr std::int64_t kImagesAtOnce = 256; // keeps what lies between photo and RAW small

Randoms randoms_of(int seed, std::uint64_t stream, std::int64_t first, std::int64_t end)
{
    Randoms randoms;
    for (std::int64_t i = first; i < end; ++i)
        randoms.push_back(Random(seed, stream, i).fork(1)); // apart from the captures' numbers
    return randoms;
}

std::vector<std::size_t> training_entries(const srisp::PackedImages& images)
{
    std::vector<std::size_t> entries;
    for (std::size_t i = 0; i < images.entries.size(); ++i)
        if (!images.entries[i].validation)
            entries.push_back(i);
    return entries;
}

/// Each photo several times.
std::vector<std::size_t> test_entries(const srisp::PackedImages& images)
{
    std::vector<std::size_t> entries;
    for (const std::size_t i : whole_images(images, true))
        entries.insert(entries.end(), kTestExposures, i);
    return entries;
}

/// The photos of these entries, without RAW images.
TaskImages photos_of(const srisp::PackedImages& images, const std::vector<std::size_t>& entries, int size)
{
    TaskImages result;
    std::vector<torch::Tensor> chosen;
    for (const std::size_t i : entries) {
        result.photo.push_back(images.entries[i].scene);
        chosen.push_back(area_resize(packed_image(images, i).unsqueeze(0), size, size));
    }
    if (!chosen.empty())
        result.photos = torch::cat(chosen);
    return result;
}

/// Images in parts, one after the other.
template<class Make> torch::Tensor in_parts(std::int64_t count, const Make& make)
{
    std::vector<torch::Tensor> parts;
    for (std::int64_t first = 0; first < count; first += kImagesAtOnce)
        parts.push_back(make(first, std::min(first + kImagesAtOnce, count)));
    return torch::cat(parts);
}

} // namespace

TaskData::TaskData(const srisp::TrainingPack& pack, int size, int references)
    : m_cameras(pack.cameras()), m_names(pack.cameras().names), m_references(references),
      m_training(photos_of(pack.photos(), training_entries(pack.photos()), size)),
      m_test(photos_of(pack.photos(), test_entries(pack.photos()), size))
{
    m_simulation.lowest_unevenness = m_simulation.highest_unevenness = 0; // as srispeval's test images
    if (m_training.photo.empty() || m_test.photo.empty() || !m_cameras.has(true) || !m_cameras.has(false))
        throw std::runtime_error("the pack needs photos and cameras for training and for validation");
}

TaskTarget TaskData::target(int seed) const
{
    std::vector<int> held_out;
    for (int camera = 0; camera < m_cameras.count(); ++camera)
        if (m_cameras.validation()[camera])
            held_out.push_back(camera);
    TaskTarget target;
    target.camera = held_out[seed % held_out.size()];
    target.name = m_names[target.camera];
    Random random(seed, kLight);
    target.light = m_cameras.draw_light(m_simulation.light, random);
    target.color = camera_color(m_cameras.to_camera(target.camera, target.light));
    return target;
}

TaskData::Captures TaskData::captures(int seed, std::uint64_t stream, const TaskTarget& target, std::size_t count) const
{
    Captures captures;
    for (std::size_t i = 0; i < count; ++i) {
        captures.push_back(draw_capture(m_simulation, m_cameras, true, Random(seed, stream, i)));
        captures.back().camera = target.camera;
        captures.back().lights = { target.light };
        captures.back().color = target.color;
    }
    return captures;
}

torch::Tensor TaskData::simulate(int seed, std::uint64_t stream, const torch::Tensor& photos,
                                 const Captures& captures) const
{
    return in_parts(photos.size(0), [&](std::int64_t first, std::int64_t end) {
        return srisp::train::simulate(m_simulation, photos.slice(0, first, end).clone(),
                                      { captures.begin() + first, captures.begin() + end },
                                      randoms_of(seed, stream, first, end));
    });
}

TaskImages TaskData::test(int seed) const
{
    TaskImages result = m_test;
    result.raws = simulate(seed, kTest, m_test.photos, captures(seed, kTest, target(seed), m_test.photo.size()));
    return result;
}

TaskImages TaskData::simulated(int seed) const
{
    TaskImages result = m_training;
    result.raws =
        simulate(seed, kTraining, m_training.photos, captures(seed, kTraining, target(seed), m_training.photo.size()));
    return result;
}

TaskImages TaskData::simulated_others(int seed) const
{
    TaskImages result = m_training;
    Captures others;
    for (std::size_t i = 0; i < m_training.photo.size(); ++i)
        others.push_back(draw_capture(m_simulation, m_cameras, false, Random(seed, kTraining, i)));
    result.raws = simulate(seed, kTraining, m_training.photos, others);
    return result;
}

TaskImages TaskData::unprocessed(int seed, Unprocessor& method) const
{
    std::vector<std::int64_t> shown; // by the references, of the training images
    Random random(seed, kReferencePhotos);
    for (int i = 0; i < m_references; ++i)
        shown.push_back(random.integer(m_training.photo.size()));
    const torch::Tensor references =
        simulate(seed, kReferences, m_training.photos.index_select(0, torch::tensor(shown)),
                 captures(seed, kReferences, target(seed), shown.size()));
    std::vector<std::int64_t> reference_of;
    for (std::size_t i = 0; i < m_training.photo.size(); ++i) {
        std::int64_t reference = Random(seed, kReferenceOfImage, i).integer(shown.size());
        for (int tries = 0; m_training.photo[shown[reference]] == m_training.photo[i] && tries < m_references; ++tries)
            reference = (reference + 1) % m_references; // another photo's
        reference_of.push_back(reference);
    }
    method.eval();
    return noisy(
        seed, batched_reverse(method, m_training.photos, references.index_select(0, torch::tensor(reference_of)), 0));
}

TaskImages TaskData::linearized(int seed) const
{
    return noisy(seed, m_training.photos.pow(2.2));
}

TaskImages TaskData::noisy(int seed, const torch::Tensor& clean) const
{
    const Captures all = captures(seed, kTraining, target(seed), m_training.photo.size());
    TaskImages result = m_training;
    result.raws = in_parts(clean.size(0), [&](std::int64_t first, std::int64_t end) {
        return expose(clean.slice(0, first, end), torch::ones({ end - first, 1, 1, 1 }),
                      { all.begin() + first, all.begin() + end }, randoms_of(seed, kTraining, first, end));
    });
    return result;
}
