// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include <srisp/reference.h>

namespace srisp::python {

/// The library's references never change; pybind11 knows no pointers to what is const.
class LoadedReference {
public:
    explicit LoadedReference(std::shared_ptr<const Reference> reference) : m_reference(std::move(reference)) {}

    const Reference& get() const { return *m_reference; }
    const std::shared_ptr<const Reference>& shared() const { return m_reference; }

private:
    std::shared_ptr<const Reference> m_reference;
};

} // namespace srisp::python
