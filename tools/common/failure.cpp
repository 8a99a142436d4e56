// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "interrupt.h"

namespace srisp::tool {

int run_tool(const char* name, const std::function<int()>& body)
{
    try {
        return body();
    } catch (const Interrupted& interrupted) {
        die_of(interrupted);
    } catch (const Failure& failure) {
        std::fprintf(stderr, "%s: %s\n", name, failure.message.c_str());
        return failure.exit_code;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "%s: not enough memory\n", name);
        return kExitFailed;
    } catch (const std::exception& error) {
        const std::string text = error.what();
        std::fprintf(stderr, "%s: %s\n", name, text.substr(0, text.find('\n')).c_str());
        return kExitFailed;
    }
}

} // namespace srisp::tool
