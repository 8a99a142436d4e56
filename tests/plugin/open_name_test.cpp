// SPDX-License-Identifier: Apache-2.0
#include "open_name.h"

#include <sys/stat.h>

#include <set>

#include "test_images.h"

using namespace srisp;
using namespace srisp::plugin;

TEST_CASE("a name is ours by its form alone")
{
    for (const char* other : { "photo.jpg", "photo.srisp.jpg", "srisp", ".srisp", "photo.jpg?reference=a.srispx" })
        CHECK(!parse_name(other));
    const auto parts = parse_name("dir/photo.jpg.SRISP?reference=a.dng&seed=3");
    REQUIRE(parts);
    CHECK(parts->source == "dir/photo.jpg");
    CHECK(parts->file == "dir/photo.jpg.SRISP");
    CHECK(parts->query == "reference=a.dng&seed=3");
    const auto plain = parse_name("shot.srisp");
    REQUIRE(plain);
    CHECK(plain->source == "shot");
    CHECK(plain->query.empty());
}

TEST_CASE("a query sets what it names, percent codes decoded")
{
    Recipe recipe;
    REQUIRE(apply_query(recipe, "reference=my%20dir/a%26b%3D1%25.dng&model=spatial&seed=12&input=linear&"
                                "direction=forward&lazy=1"));
    CHECK(recipe.references == std::vector<std::string>{ "my dir/a&b=1%.dng" });
    CHECK(recipe.model == "spatial");
    CHECK(recipe.seed == 12);
    CHECK(recipe.input == InputEncoding::linear);
    CHECK(recipe.direction == Direction::forward);
    CHECK(recipe.lazy);
}

TEST_CASE("what a query cannot say is an error that lists the near ones")
{
    const auto refused = [](const std::string& query) {
        Recipe recipe;
        const Status status = apply_query(recipe, query);
        REQUIRE(!status);
        return status.error().message;
    };
    CHECK(refused("refrence=a.dng") == "unknown option 'refrence'; did you mean 'reference'?");
    CHECK(has(refused("reference=100%zz.dng"), "'%zz' in the query is not a percent code (write %25 for %)"));
    CHECK(has(refused("reference=a%2"), "not a percent code"));
    CHECK(has(refused("reference"), "is not key=value"));
    CHECK(has(refused("input=sgrb"), "unknown input 'sgrb'"));
    CHECK(refused("precision=fats") == "unknown precision 'fats'; did you mean 'fast'?");
    CHECK(has(refused("direction=back"), "unknown direction 'back'"));
    CHECK(has(refused("seed=-1"), "seed '-1' is not a whole number"));
    CHECK(refused("seed=18446744073709551616") ==
          "seed '18446744073709551616' is not a whole number from 0 to 18446744073709551615");
    CHECK(has(refused("seed="), "seed '' is not a whole number"));
    CHECK(refused("lazy=yes") == "lazy 'yes' is neither 0 nor 1");
    CHECK(has(refused("hold=1"), "unknown option 'hold'"));
    CHECK(has(refused("params=/nowhere/p.json"), "parameters '/nowhere/p.json': No such file"));
}

TEST_CASE("hints of a host set the same, unknown ones are errors, others are none of ours")
{
    Recipe recipe;
    OIIO::ImageSpec config;
    config.attribute("oiio:UnassociatedAlpha", 1);
    config.attribute("srisp:reference", "a b.dng");
    config.attribute("srisp:seed", 7);
    REQUIRE(apply_hints(recipe, config));
    CHECK(recipe.references == std::vector<std::string>{ "a b.dng" });
    CHECK(recipe.seed == 7);
    config.attribute("srisp:modle", "default");
    const Status status = apply_hints(recipe, config);
    REQUIRE(!status);
    CHECK(has(status.error().message, "'srisp:modle': unknown option 'modle'; did you mean 'model'?"));
}

TEST_CASE("references with odd names stand in queries and hints, alone and beside others")
{
    const ScratchFolder folder;
    std::vector<std::string> all;
    std::string list;
    for (const char* name : { "a;b.exr", "b.exr", "x*.exr", "y[1].exr" }) {
        all.push_back(write_reference(folder, name));
        list += (list.empty() ? "" : ";") + all.back();
    }
    Recipe by_query, by_hint;
    REQUIRE(apply_query(by_query, "reference=" + list));
    CHECK(by_query.references == all);
    OIIO::ImageSpec config;
    config.attribute("srisp:reference", list);
    REQUIRE(apply_hints(by_hint, config));
    CHECK(by_hint.references == all);

    const std::string photo = write_photo(folder);
    std::set<std::string> taken;
    for (int seed = 0; seed < 40; ++seed) {
        SrispInput input;
        const std::string name = photo + ".srisp?seed=" + std::to_string(seed) + "&reference=" + list;
        taken.insert(open_ours(input, name).get_string_attribute("unprocess:reference"));
    }
    CHECK(taken == std::set<std::string>{ "a;b.exr", "b.exr", "x*.exr", "y[1].exr" });
}

TEST_CASE("a file on disk must hold a recipe or a stub to be ours")
{
    const ScratchFolder folder;
    CHECK(!is_our_name(folder.file("notes.srisp", "dear diary")));
    CHECK(is_our_name(folder.file("good.srisp", "{\"format\": \"srisp-recipe-1\"}")));
    CHECK(is_our_name(folder.path("photo.jpg.srisp?reference=a")));
    CHECK(!is_our_name(folder.file("photo.jpg")));
}

TEST_CASE("a recipe that says nothing to choose by is refused on opening")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder);
    CHECK(has(refusal_of(photo + ".srisp"), "names no reference (a RAW file) and no parameters"));
}

TEST_CASE("parameters that name no model are refused where none is given, in both directions")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder), parameters = folder.file("p.json", to_json(Parameters()));
    CHECK(has(refusal_of(photo + ".srisp?direction=forward&params=" + parameters),
              "the parameters name no model, so it must be given (model=)"));
    CHECK(has(refusal_of(photo + ".srisp?direction=forward&model=default&params=" + parameters),
              "parameters were chosen with model ''"));
    CHECK(has(refusal_of(photo + ".srisp?params=" + parameters), "parameters were chosen with model ''"));
}

TEST_CASE("what a message shows of a query is valid UTF-8")
{
    Recipe recipe;
    CHECK(has(apply_query(recipe, "reference=%ü日").error().message, "'%ü日' in the query is not a percent code"));
    CHECK(has(apply_query(recipe, "reference=%\xff\xfe").error().message, "'%\\xff\\xfe' in the query"));
    CHECK(refusal_of("gr\xfcn.png.srisp?reference=a.exr") == "photo 'gr\\xfcn.png': does not exist");
    const ScratchFolder folder;
    const std::string query = write_photo(folder) + ".srisp?";
    CHECK(has(refusal_of(query + "reference=a.exr&model=%FF%e6%97"), "unknown model '\\xff\\xe6\\x97'"));
    CHECK(has(refusal_of(query + "reference=%e6%97.dng"), "reference '\\xe6\\x97.dng': No such file"));
}

TEST_CASE("a recipe or parameters that are no regular file, and URLs, are refused at once")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder), reference = write_reference(folder), fifo = folder.path("f.srisp");
    REQUIRE(::mkfifo(fifo.c_str(), 0600) == 0);
    CHECK(refusal_of(fifo) == "recipe '" + fifo + "': is not a regular file");
    CHECK(has(refusal_of(photo + ".srisp?params=" + fifo), "is not a regular file"));
    CHECK(has(refusal_of(photo + ".srisp?params=/dev/zero"), "is not a regular file"));
    CHECK(has(refusal_of(photo + ".srisp?reference=" + fifo), "is not a regular file"));
    CHECK(has(refusal_of(photo + ".srisp?reference=" + reference + "&model=./" + fifo), "No such file"));
    CHECK(has(refusal_of(fifo + ".srisp?reference=" + reference), "a recipe cannot be made from a recipe"));
    CHECK(refusal_of("http://127.0.0.1:9/a.mp4.srisp?reference=" + reference) ==
          "photo 'http://127.0.0.1:9/a.mp4': is a URL; only files are read");
    CHECK(has(refusal_of(photo + ".srisp?reference=http://127.0.0.1:9/a.dng"), "is a URL; only files are read"));
    const std::string recipe = folder.file("u.srisp", R"({"format":"srisp-recipe-1","reference":"reference.exr",)"
                                                      R"("source":"http://127.0.0.1:9/a.mp4"})");
    CHECK(has(refusal_of(recipe), "'http://127.0.0.1:9/a.mp4' is a URL; only files are read"));
}
