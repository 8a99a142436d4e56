// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace srisp {

/// What training showed the model, so what it can choose with sense; a photo unlike any (16 x 16 pixels of a game) can
/// lead it elsewhere.
///
/// Gain: training exposes by 0.5 to 32 [train/samples/random_isp.cpp: render_random up to 25, render_fixed 0.95 /
/// 0.03], and its tone curves make dark pictures darker than that by up to five times. Of 1,400 choices for photos and
/// RAW files that people took, all lie between 0.11 and 18.
constexpr float kLeastGain = 0.1f, kLargestGain = 32;

/// White balance, the largest gain over the smallest: 5.3 for the measured cameras from 2300 K to 25000 K; lights with
/// ripple, wrong balances and scenes of one colour add to it. The same choices reach 4.3.
constexpr float kLargestBalance = 8;

/// Moves a gain that lies outside to the nearest value inside, and adds a sentence on it to `notes` (may be null).
void keep_in_trained_range(float& gain, std::vector<std::string>* notes);

/// The same for a white balance: gains that are too large for the smallest one become smaller.
void keep_in_trained_range(std::array<float, 3>& white_balance, std::vector<std::string>* notes);

} // namespace srisp
