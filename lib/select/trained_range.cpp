// SPDX-License-Identifier: Apache-2.0
#include "select/trained_range.h"

#include <algorithm>

#include "base/printed.h"

namespace srisp {

namespace {

std::string text_of(float value)
{
    return printed("%.3g", double(value));
}

std::string text_of(const std::array<float, 3>& values)
{
    return text_of(values[0]) + ", " + text_of(values[1]) + ", " + text_of(values[2]);
}

} // namespace

void keep_in_trained_range(float& gain, std::vector<std::string>* notes)
{
    const float kept = std::clamp(gain, kLeastGain, kLargestGain);
    if (kept != gain && notes)
        notes->push_back("the chosen gain " + text_of(gain) + " lies outside what the model was trained for (" +
                         text_of(kLeastGain) + " to " + text_of(kLargestGain) + "); " + text_of(kept) + " was taken");
    gain = kept;
}

void keep_in_trained_range(std::array<float, 3>& white_balance, std::vector<std::string>* notes)
{
    const float most = kLargestBalance * *std::min_element(white_balance.begin(), white_balance.end());
    std::array<float, 3> kept = white_balance;
    for (float& gain : kept)
        gain = std::min(gain, most);
    if (kept != white_balance && notes)
        notes->push_back("the chosen white balance " + text_of(white_balance) +
                         " lies outside what the model was trained for (at most " + text_of(kLargestBalance) +
                         " to 1); " + text_of(kept) + " was taken");
    white_balance = kept;
}

} // namespace srisp
