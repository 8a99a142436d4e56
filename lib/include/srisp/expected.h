// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <utility>
#include <variant>

namespace srisp {

/// Why something failed: one line that says what, where, the value and the limit.
struct Error {
    std::string message;
};

/// A value, or the Error that prevented it. Nothing throws across a public function of this library.
template<class T> class [[nodiscard]] Expected {
public:
    Expected(T value) : m_result(std::move(value)) {}
    Expected(Error error) : m_result(std::move(error)) {}

    explicit operator bool() const { return m_result.index() == 0; }
    T& operator*() { return std::get<0>(m_result); }
    const T& operator*() const { return std::get<0>(m_result); }
    T* operator->() { return &std::get<0>(m_result); }
    const T* operator->() const { return &std::get<0>(m_result); }
    /// The reason of the failure; call it only where this is false.
    const Error& error() const { return std::get<1>(m_result); }

private:
    std::variant<T, Error> m_result;
};

/// Success, or the Error that prevented it.
class [[nodiscard]] Status {
public:
    Status() = default;
    Status(Error error) : m_error(std::move(error)), m_failed(true) {}

    explicit operator bool() const { return !m_failed; }
    /// The reason of the failure; empty on success.
    const Error& error() const { return m_error; }

private:
    Error m_error;
    bool m_failed = false;
};

} // namespace srisp
