// SPDX-License-Identifier: Apache-2.0
#include "network.h"

namespace srisp::train {

std::shared_ptr<Unprocessor> make_unprocessor(const ModelSettings& settings, std::uint64_t seed)
{
    return std::make_shared<Network>(settings, seed);
}

} // namespace srisp::train
