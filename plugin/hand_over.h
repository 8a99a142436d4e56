// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <OpenImageIO/imageio.h>
#include <srisp/expected.h>

#include "photo/pixel_source.h"

// The hand-over: our writer keeps an image in the memory of the process and leaves a stub file; our reader finds the
// image by the stub. srisptool makes the folder and the job files; a stub `T/1.0007.srisp` belongs to job `T/1.json`,
// frame 0007.

namespace srisp {

/// One image as our writer got it.
struct SlotLevel {
    OIIO::ImageSpec spec;      ///< float
    std::vector<float> pixels; ///< all channels of the data window
};
struct Slot {
    std::vector<std::vector<SlotLevel>> subimages; ///< MIP levels of each
    std::string job;                               ///< path of the job file
    std::string frame;                             ///< frame number as in the stub's name; may be empty
};

/// Job file and frame that a stub's path (or the temporary name that a host writes to first) stands for.
void parse_stub_name(const std::string& path, std::string& job, std::string& frame);

/// Keeps a slot and returns its id. The previous slot of the same job is freed, though readers of it may be open: hosts
/// keep many open, and a shot would fill the memory.
std::string keep_slot(std::shared_ptr<const Slot> slot);
/// Null: no such slot in this process.
std::shared_ptr<const Slot> find_slot(const std::string& id);

/// The text of a stub file, and the slot's id in one; false: the text is no stub.
std::string stub_text(const std::string& id);
bool parse_stub(const std::string& text, std::string& id);

/// Reads from a slot while that is kept. `name`: what the image is called in messages.
std::unique_ptr<PixelSource> open_slot_source(const std::string& id, const std::string& name);

} // namespace srisp
