// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>

namespace srisp {

/// Memory for the pixels of bands, used again for the next one: memory that is fresh for each band costs more to get,
/// to fill with zeros and to give back than what is done in it. Not for use by several threads at a time.
class SpareMemory {
public:
    SpareMemory();

    /// `count` floats that hold anything. The memory comes back when the last copy of the pointer goes, also after this
    /// object has.
    std::shared_ptr<float[]> floats(std::size_t count);

private:
    struct Spares;
    std::shared_ptr<Spares> m_spares;
};

} // namespace srisp
