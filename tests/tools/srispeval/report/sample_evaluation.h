// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../../../../tools/srispeval/report/report_page.h"

// An evaluation as it might be, made of a formula: for tests of the report. Names in it are hostile.

constexpr char kHostileName[] = "<script>alert(1)</script>.dng";
constexpr char kHostileCamera[] = "Bad \"Cam\" & 'Co' </table>";
constexpr char kInvalidName[] = "caf\xe9/\xff\xfe\x07.dng"; // no UTF-8, and a bell

/// `count` images in two renderings (one where there is no truth).
srisp::tool::Evaluation sample_evaluation(bool has_truth, int count);
