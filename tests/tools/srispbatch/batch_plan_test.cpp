// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispbatch/batch_plan.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <map>
#include <set>

#include "../failure_of.h"
#include "scratch_folder.h"

using namespace srisp::tool;

namespace {

std::vector<ListedFile> some_photos(int count)
{
    std::vector<ListedFile> photos;
    for (int i = 0; i < count; ++i)
        photos.push_back({ "/p/" + std::to_string(i) + ".jpg", std::to_string(i) + ".jpg" });
    std::sort(photos.begin(), photos.end());
    return photos;
}

std::string weights_file(const ScratchFolder& folder, const std::string& lines)
{
    return folder.file("weights.csv", "reference,weight\n" + lines);
}

/// What each result's reference and seed are.
std::map<std::string, std::string> choices(const std::vector<BatchTask>& tasks)
{
    std::map<std::string, std::string> result;
    for (const BatchTask& task : tasks)
        result[task.output] = task.reference + " " + std::to_string(task.seed);
    return result;
}

} // namespace

TEST_CASE("a photo's references and seeds are its own, whatever the rest of the set is")
{
    const ScratchFolder folder;
    const ReferenceSet references = ReferenceSet::read(weights_file(folder, "a.dng,1\nb.dng,1\nc.dng,2\n"));
    BatchOptions options;
    options.per_image = 3;
    const auto all = choices(plan_batch(some_photos(50), references, options).tasks);
    CHECK(all.size() == 150);
    for (const auto& [output, choice] : choices(plan_batch(some_photos(7), references, options).tasks))
        CHECK(all.at(output) == choice);
    std::map<std::string, std::string> sharded;
    options.shard.count = 4;
    for (options.shard.index = 0; options.shard.index < 4; ++options.shard.index) {
        const BatchPlan plan = plan_batch(some_photos(50), references, options);
        const auto part = choices(plan.tasks);
        CHECK(plan.outputs.size() == 150);
        CHECK(part.size() > 30);
        CHECK(part.size() < 48);
        sharded.insert(part.begin(), part.end());
    }
    CHECK(sharded == all);
    options.shard = {};
    options.seed = 1;
    CHECK(choices(plan_batch(some_photos(50), references, options).tasks) != all);
}

TEST_CASE("references are taken as often as their weights say")
{
    const ScratchFolder folder;
    const ReferenceSet references = ReferenceSet::read(weights_file(folder, "a.dng,1\n\"b,c.dng\",3\n"));
    int heavy = 0;
    for (const BatchTask& task : plan_batch(some_photos(4000), references, {}).tasks)
        heavy += task.reference == folder.path("b,c.dng");
    CHECK(heavy > 2900);
    CHECK(heavy < 3100);
}

TEST_CASE("round-robin takes one after the other, and all takes all")
{
    const ScratchFolder folder;
    const ReferenceSet references = ReferenceSet::read(weights_file(folder, "a.dng,1\nb.dng,1\n"));
    BatchOptions options;
    options.pairing = Pairing::round_robin;
    const auto turns = plan_batch(some_photos(4), references, options).tasks;
    for (std::size_t i = 0; i < turns.size(); ++i)
        CHECK(turns[i].reference == folder.path(i % 2 ? "b.dng" : "a.dng"));
    options.pairing = Pairing::all;
    const auto all = plan_batch(some_photos(2), references, options).tasks;
    REQUIRE(all.size() == 4);
    CHECK(all[1].output == "0_1.exr");
    CHECK(all[1].reference == folder.path("b.dng"));
}

TEST_CASE("seeds of different copies and photos differ")
{
    const ScratchFolder folder;
    const ReferenceSet references = ReferenceSet::read(weights_file(folder, "a.dng,1\n"));
    BatchOptions options;
    options.per_image = 2;
    std::set<std::uint64_t> seeds;
    for (const BatchTask& task : plan_batch(some_photos(100), references, options).tasks)
        seeds.insert(task.seed);
    CHECK(seeds.size() == 200);
}

TEST_CASE("a wrong CSV file says where")
{
    const ScratchFolder folder;
    const auto failure = [&](const std::string& text) {
        return failure_of([&] { ReferenceSet::read(folder.file("r.csv", text)); });
    };
    CHECK(failure("a,b\n").find("line 1: 'a,b' must be 'photo,reference' or 'reference,weight'") != std::string::npos);
    CHECK(failure("reference,weight\na.dng,0\n").find("line 2: weight '0' is no number above 0") != std::string::npos);
    CHECK(failure("reference,weight\na.dng\n").find("line 2: must have two fields") != std::string::npos);
    CHECK(failure("reference,weight\n\"a.dng,1\n").find("line 2: a quote does not end") != std::string::npos);
    CHECK(failure("photo,reference\n").find("names none") != std::string::npos);
}
