// SPDX-License-Identifier: Apache-2.0
#include "failure.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <string>

#include "base/guarded.h"

#include "interrupt.h"

namespace srisp::tool {

static struct sigaction g_file_limit = {};

void ignore_file_limit_signal()
{
    struct sigaction ignore = {};
    ignore.sa_handler = SIG_IGN;
    sigaction(SIGXFSZ, &ignore, &g_file_limit);
}

void restore_file_limit_signal()
{
    sigaction(SIGXFSZ, &g_file_limit, nullptr);
}

int run_tool(const char* name, const std::function<int()>& body)
{
    ignore_file_limit_signal();
    try {
        return body();
    } catch (const Interrupted& interrupted) {
        die_of(interrupted);
    } catch (const Failure& failure) {
        std::fprintf(stderr, "%s: %s\n", name, failure.message.c_str());
        return failure.exit_code;
    } catch (const std::exception& error) {
        const std::string text = thrown_text(error);
        std::fprintf(stderr, "%s: %s\n", name, text.substr(0, text.find('\n')).c_str());
        return kExitFailed;
    }
}

} // namespace srisp::tool
