// SPDX-License-Identifier: Apache-2.0
#include "query.h"

#include "job_actions.h"
#include "open_name.h"
#include "test_images.h"

using namespace srisp;

TEST_CASE("a name is ours by its form alone")
{
    QueryName parts;
    CHECK(!parse_name("photo.jpg", parts));
    CHECK(!parse_name("photo.srisp.jpg", parts));
    CHECK(!parse_name("srisp", parts));
    CHECK(!parse_name(".srisp", parts));
    CHECK(!parse_name("photo.jpg?reference=a.srispx", parts));
    REQUIRE(parse_name("dir/photo.jpg.SRISP?reference=a.dng&seed=3", parts));
    CHECK(parts.source == "dir/photo.jpg");
    CHECK(parts.file == "dir/photo.jpg.SRISP");
    CHECK(parts.query == "reference=a.dng&seed=3");
    QueryName plain;
    REQUIRE(parse_name("shot.srisp", plain));
    CHECK(plain.source == "shot");
    CHECK(plain.query.empty());
}

TEST_CASE("a query sets what it names, percent codes decoded")
{
    Recipe recipe;
    REQUIRE(apply_query(recipe, "reference=my%20dir/a%26b%3D1%25.dng&model=pointwise&seed=12&input=linear&"
                                "direction=forward&lazy=1"));
    CHECK(recipe.reference == "my dir/a&b=1%.dng");
    CHECK(recipe.model == "pointwise");
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
    CHECK(has(refused("reference=100%zz.dng"), "'%zz' in the query is no percent code (write %25 for %)"));
    CHECK(has(refused("reference=a%2"), "no percent code"));
    CHECK(has(refused("reference"), "is not key=value"));
    CHECK(has(refused("input=sgrb"), "unknown input 'sgrb'"));
    CHECK(refused("precision=fats") == "unknown precision 'fats'; did you mean 'fast'?");
    CHECK(has(refused("direction=back"), "unknown direction 'back'"));
    CHECK(has(refused("seed=-1"), "seed '-1' is not a whole number"));
    CHECK(has(refused("seed=99999999999999999999"), "is not a whole number"));
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
    CHECK(recipe.reference == "a b.dng");
    CHECK(recipe.seed == 7);
    config.attribute("srisp:modle", "default");
    const Status status = apply_hints(recipe, config);
    REQUIRE(!status);
    CHECK(has(status.error().message, "'srisp:modle': unknown option 'modle'; did you mean 'model'?"));
}

TEST_CASE("a file on disk must hold a recipe or a stub to be ours")
{
    const ScratchFolder folder;
    CHECK(!is_our_name(folder.file("notes.srisp", "dear diary")));
    CHECK(is_our_name(folder.file("good.srisp", "{\"format\": \"srisp-recipe-1\"}")));
    CHECK(is_our_name(folder.path("photo.jpg.srisp?reference=a")));
    CHECK(!is_our_name(folder.file("photo.jpg")));
}

TEST_CASE("frame numbers replace # and %d in file names")
{
    CHECK(with_frame("p.####.json", "0007") == "p.0007.json");
    CHECK(with_frame("p.#.json", "0012") == "p.12.json");
    CHECK(with_frame("p%04d.json", "7") == "p0007.json");
    CHECK(with_frame("p%d.json", "0007") == "p7.json");
    CHECK(with_frame("p.####.json", "-3") == "p.-003.json");
    CHECK(with_frame("p.####.json", "0") == "p.0000.json");
    CHECK(with_frame("p.json", "7") == "p.json");
    CHECK(with_frame("p.#.json", "") == "p.#.json");
}

TEST_CASE("a recipe that says nothing to choose by is refused on opening")
{
    const ScratchFolder folder;
    const std::string photo = write_photo(folder);
    CHECK(has(refusal_of(photo + ".srisp"), "names no reference (a RAW file) and no parameters"));
}
