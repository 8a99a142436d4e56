// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <srisp/expected.h>

#include "../common/file_list.h"
#include "eval_options.h"
#include "scores.h"
#include "test_image.h"

namespace srisp::tool {

/// Called with the bytes that decoding a file will take, before they are taken; may wait.
using AskForMemory = std::function<void(std::uint64_t)>;

/// The test images of one task, and what it could not make.
struct TestImages {
    std::vector<TestImage> images;
    std::vector<LeftOut> left_out;
};

/// A piece of an evaluation that can be done by itself: one RAW file, one pair, one photo with all its references.
struct EvalTask {
    std::string name;               ///< of the file that it is about
    std::string state;              ///< of all that it reads: what was found out holds while this is the same
    std::vector<std::string> files; ///< that it reads, by their paths
    std::function<Expected<TestImages>(const AskForMemory& ask)> make; ///< threads: safe
};

/// What is tested, and how.
struct Protocol {
    std::string name;
    std::vector<std::string> text; ///< for readers, one paragraph each
    bool has_truth = true;
    bool ranks = false; ///< the images of a task are one photo with several references
    std::vector<EvalTask> tasks;
    std::vector<LeftOut> left_out; ///< before any task began
    int images_per_task = 1;       ///< at most
};

/// The paper's test: the left half of a RAW file is the reference, the top and the bottom of the right half are two
/// tests; photos are made of the RAW in several ways. Throws Failure: no files.
Protocol half_split_protocol(const EvalOptions& options);

/// Photos with RAW files that show the same, and references, by a CSV file. Throws Failure: the table is not as it
/// should be.
Protocol pairs_protocol(const EvalOptions& options);

/// Photos with references that have nothing to do with them. Throws Failure: no files.
Protocol unpaired_protocol(const EvalOptions& options);

/// RAW files and EXR images, by the endings of their names, in folders; else what the words name.
std::vector<ListedFile> list_raw_files(const std::vector<std::string>& words);

/// A reference's thumbnail in the shape of its image.
Pixels pixels_of_reference(const Reference& reference);

/// Loads a RAW file once there is memory for it.
Expected<RawPicture> load_raw_picture(const std::string& path, int longest, const AskForMemory& ask);

} // namespace srisp::tool
