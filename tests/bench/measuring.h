// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <fstream>
#include <string>

/// How long the work takes.
template<class Work> double seconds(const Work& work)
{
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Lets VmHWM, the peak, start anew from what is in use now.
inline void reset_peak_memory()
{
    std::ofstream("/proc/self/clear_refs") << "5";
}

/// A field of /proc/self/status ("VmHWM:"), in MB.
inline double memory_mb(const std::string& field)
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.rfind(field, 0) == 0)
            return std::stod(line.substr(field.size() + 1)) / 1024;
    return 0;
}
