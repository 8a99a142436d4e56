// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "../scores.h"

namespace srisp::tool {

/// The report's title, as HTML.
std::string report_title(const Evaluation& evaluation);

/// What the evaluation found, in sentences made of its numbers, with warnings: HTML paragraphs.
std::string answer_html(const Evaluation& evaluation);

/// How it was measured, with which settings, and what was left out: HTML sections.
std::string protocol_html(const Evaluation& evaluation);

/// "fixed rendering"; for "photo", which is none, "photos as given". As HTML.
std::string rendering_title(const std::string& rendering);

} // namespace srisp::tool
