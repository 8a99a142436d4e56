// SPDX-License-Identifier: Apache-2.0
// Manifests of srispbatch: the file of one shard, as written and merged.
#include "tools/srispbatch/manifest.h"

#include <filesystem>
#include <fstream>

#include "fuzz_target.h"
#include "scratch_folder.h"
#include "tools/common/failure.h"

using namespace srisp;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    static const ScratchFolder scratch;
    const std::string folder = tool::manifest_folder(scratch.path());
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    std::ofstream(folder + "/one.jsonl", std::ios::binary) << fuzz::text_of(data, size);
    try {
        const std::size_t count = tool::Manifest(scratch.path(), "one").entries().size();
        fuzz::must_hold(tool::merge_manifests(scratch.path()) == count, "merging keeps each result");
        const tool::Manifest merged(scratch.path(), "all");
        fuzz::must_hold(merged.entries().size() == count, "what was merged can be read");
    } catch (const tool::Failure& failure) {
        fuzz::check_message(failure.message);
    }
    return 0;
}
