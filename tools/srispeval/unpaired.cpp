// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "../common/failure.h"
#include "protocol.h"

namespace srisp::tool {

namespace {

Expected<TestImages> load_unpaired(const ListedFile& file, const std::vector<ListedFile>& references,
                                   const EvalOptions& options)
{
    const auto photo = load_photo(file.path, 0, 0, options.size);
    if (!photo)
        return photo.error();
    TestImages result;
    for (const ListedFile& one : references) {
        const auto reference = load_reference_cached(one.path);
        if (!reference)
            return reference.error();
        TestImage image;
        image.photo = *photo;
        image.reference = pixels_of_reference(**reference);
        image.colors = colors_of((*reference)->facts, image.reference.means());
        image.score.image = file.name;
        image.score.rendering = "photo";
        image.score.camera = camera_name((*reference)->facts);
        image.score.reference = one.name;
        image.score.notes = (*reference)->notes;
        result.images.push_back(std::move(image));
    }
    return result;
}

/// So many of them, evenly spread; only those that can be read, which is tried here, once.
std::vector<ListedFile> chosen_references(const EvalOptions& options, std::vector<LeftOut>& left_out)
{
    const std::vector<ListedFile> all = list_raw_files(options.references);
    std::vector<ListedFile> usable;
    for (const ListedFile& file : all) {
        if (const auto reference = load_reference_cached(file.path))
            usable.push_back(file);
        else
            left_out.push_back({ file.name, reference.error().message });
    }
    std::vector<ListedFile> chosen;
    const std::size_t count = std::min(usable.size(), std::size_t(options.reference_count));
    for (std::size_t i = 0; i < count; ++i)
        chosen.push_back(usable[(2 * i + 1) * usable.size() / (2 * count)]);
    return chosen;
}

} // namespace

Protocol unpaired_protocol(const EvalOptions& options)
{
    Protocol protocol;
    protocol.name = "unpaired";
    protocol.has_truth = false;
    protocol.ranks = true;
    const std::vector<ListedFile> references = chosen_references(options, protocol.left_out);
    if (references.size() < 2)
        fail("--reference: " + std::to_string(references.size()) + " of the files can be references; 2 are the least" +
             (protocol.left_out.empty() ? "" : " (" + protocol.left_out.front().reason + ")"));
    protocol.text = {
        "Unpaired: photos and references that have nothing to do with each other; every photo gets each of " +
        std::to_string(references.size()) +
        " references. There is no truth, so results are held against the references: by how much "
        "their Lab histograms have in common, and by whether a brighter reference gives a brighter "
        "result (rank correlation over the references, for each photo)."
    };
    std::string state;
    std::vector<std::string> files;
    for (const ListedFile& reference : references) {
        state += reference_state(reference.path);
        files.push_back(reference.path);
    }
    protocol.images_per_task = int(references.size());
    for (const ListedFile& file : list_files(options.inputs, photo_files())) {
        EvalTask task{ file.name, reference_state(file.path) + state, files,
                       [file, references, &options](const AskForMemory&) {
                           return load_unpaired(file, references, options);
                       } };
        task.files.push_back(file.path);
        protocol.tasks.push_back(std::move(task));
    }
    return protocol;
}

} // namespace srisp::tool
