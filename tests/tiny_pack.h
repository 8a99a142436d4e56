// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include <nlohmann/json.hpp>

/// A training pack of two photos (the first with one crop), one RAW image, two cameras and two lights, all of
/// kSmallestPackImage pixels, made in `folder`. Pixel i of the part is 7 i modulo 65536.
void write_tiny_pack(const std::string& folder);

/// The whole of a file.
std::string bytes_of(const std::string& path);
void write_bytes(const std::string& path, const std::string& bytes);

/// Changes pack.json.
void edit_index(const std::string& folder, const std::function<void(nlohmann::json&)>& edit);

/// Changes a file of the pack ("photos", "raws", "cameras"), and makes size and hash in pack.json agree with it.
void edit_part(const std::string& folder, const std::string& part, const std::function<void(std::string&)>& edit);

/// The message of opening the pack; "" if it opens.
std::string open_error(const std::string& folder);
