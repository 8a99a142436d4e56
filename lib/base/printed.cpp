// SPDX-License-Identifier: Apache-2.0
#include "base/printed.h"

#include <clocale>
#include <cstdarg>
#include <cstdio>

namespace srisp {

namespace {

/// The calling thread's, as long as it lives.
class CLocale {
public:
    CLocale() : m_before(uselocale(c_locale())) {}
    ~CLocale() { uselocale(m_before); }
    CLocale(const CLocale&) = delete;
    CLocale& operator=(const CLocale&) = delete;

private:
    static locale_t c_locale()
    {
        static const locale_t locale = newlocale(LC_ALL_MASK, "C", locale_t(0));
        return locale;
    }

    locale_t m_before;
};

} // namespace

std::string printed(const char* format, ...)
{
    const CLocale c_locale;
    std::va_list arguments;
    va_start(arguments, format);
    std::va_list again;
    va_copy(again, arguments);
    const int length = std::vsnprintf(nullptr, 0, format, arguments);
    va_end(arguments);
    std::string text(length > 0 ? std::size_t(length) : 0, '\0');
    std::vsnprintf(text.data(), text.size() + 1, format, again);
    va_end(again);
    return text;
}

} // namespace srisp
