// SPDX-License-Identifier: Apache-2.0
// Runs the fuzz targets on files: fuzz_replay SEEDS runs each target on all of the folder SEEDS/TARGET;
// fuzz_replay TARGET FILE… one of them on these files.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "target_table.h"

namespace fs = std::filesystem;
using srisp::fuzz::Target;

namespace {

std::vector<std::string> files_of(const fs::path& folder)
{
    std::vector<std::string> files;
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder, error))
        files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    return files;
}

/// False where there is nothing to run.
bool run(const Target& target, const std::vector<std::string>& files)
{
    for (const std::string& file : files) {
        std::ifstream in(file, std::ios::binary);
        const std::vector<char> bytes{ std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>() };
        std::printf("%s: %s\n", target.name.c_str(), file.c_str());
        std::fflush(stdout); // so that a crash names its file
        // An allocation of the exact size, so that a sanitizer sees every read beyond it.
        const std::vector<std::uint8_t> exact(bytes.begin(), bytes.end());
        target.run(exact.data(), exact.size());
    }
    if (files.empty())
        std::fprintf(stderr, "%s: no seeds\n", target.name.c_str());
    return !files.empty();
}

} // namespace

int main(int argc, char** argv)
{
    if (argc < 2) {
        std::fprintf(stderr, "usage: fuzz_replay SEEDS | TARGET FILE...\n");
        return 2;
    }
    bool found = false, complete = true;
    for (const Target& target : srisp::fuzz::targets()) {
        if (argc > 2 && target.name != argv[1])
            continue;
        found = true;
        complete &= run(target, argc > 2 ? std::vector<std::string>(argv + 2, argv + argc)
                                         : files_of(fs::path(argv[1]) / target.name));
    }
    return found && complete ? 0 : 1;
}
