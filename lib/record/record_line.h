// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include <srisp/options.h>

namespace srisp {

/// What one result says of itself in its ImageDescription.
struct RecordLine {
    Direction direction = Direction::reverse;
    std::string parameters;  ///< JSON object as srisp::to_json writes; empty: not known yet
    std::string description; ///< the source's own ImageDescription
};

/// The plain mark that an image is synthetic.
const char* synthetic_mark(Direction direction);

/// One line of JSON, ASCII.
std::string format_record(const RecordLine& record);

/// Finds such a line in a text that may hold more (programs append checksums). False: there is none, or it is damaged.
bool find_record(const std::string& text, RecordLine& record);

} // namespace srisp
