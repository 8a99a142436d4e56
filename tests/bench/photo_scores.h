// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <srisp/model.h>
#include <srisp/reference.h>

#include "picture.h"

/// What one photo gave with all references.
struct PhotoScores {
    std::string name;
    std::array<double, 3> rank{};      ///< correlation of log channel means, results against references
    std::vector<double> round_trip_db; ///< forward(reverse(photo)) against the photo
    std::array<double, 3> white{};     ///< mean after the round trip of pixels that are (1, 1, 1)
    double worst_white = 0;            ///< over references: largest distance of a channel's mean from the three's mean
    std::int64_t white_pixels = 0;
};

/// Where the pictures go; null: nowhere.
struct Sheets {
    Sheet *results = nullptr, *round_trips = nullptr;

    void paste(const Picture& picture, float exponent, int column, int row) const
    {
        for (Sheet* sheet : { results, round_trips })
            if (sheet)
                sheet->paste(picture, exponent, column, row);
    }
};

/// For RAW values that are looked at.
constexpr float kDisplayExponent = 1 / 2.2f;

/// Unprocesses a photo with each reference and processes it again; the pictures go to row `row`. Throws
/// std::runtime_error.
PhotoScores judge_photo(const srisp::Model& model, const std::string& path,
                        const std::vector<std::shared_ptr<const srisp::Reference>>& references, const Sheets& sheets,
                        int row);
