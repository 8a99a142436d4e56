// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "photo/pixel_source.h"

// The hand-over: our writer keeps an image in the memory of the process (a slot) and leaves a stub file; our reader
// finds the image by the stub. srisptool makes the folder and the job files; a stub `T/1.0007.srisp` belongs to job
// `T/1.json`, frame 0007.

namespace srisp::plugin {

/// Job file and frame that a stub's path (or the temporary name that a host writes to first) stands for.
struct StubName {
    std::string job;
    std::string frame; ///< may be empty
};
StubName parse_stub_name(const std::string& path);

/// The text of a stub file, and the slot's id in one; none: the text is no stub.
std::string stub_text(const std::string& id);
std::optional<std::string> parse_stub(const std::string& text);

/// Reads from a slot while that is kept. `name`: what the image is called in messages.
std::unique_ptr<PixelSource> open_slot_source(const std::string& id, const std::string& name);

} // namespace srisp::plugin
