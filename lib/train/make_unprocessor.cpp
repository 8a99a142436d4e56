// SPDX-License-Identifier: Apache-2.0
#include "gain_match.h"
#include "network.h"
#include "unet.h"
#include "upi.h"

namespace srisp::train {

std::shared_ptr<Unprocessor> make_unprocessor(const ModelSettings& settings, std::uint64_t seed)
{
    if (settings.method == "gain_match")
        return std::make_shared<GainMatch>();
    if (settings.method == "upi")
        return std::make_shared<Upi>(seed);
    if (settings.method == "unet")
        return std::make_shared<UNet>(settings.unet_channels, seed);
    return std::make_shared<Network>(settings, seed);
}

} // namespace srisp::train
