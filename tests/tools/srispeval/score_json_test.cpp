// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srispeval/score_json.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "../../../tools/srispeval/score_csv.h"
#include "scratch_folder.h"
#include "some_scores.h"

using namespace srisp::tool;

namespace {

Evaluation some_evaluation()
{
    Evaluation evaluation;
    evaluation.protocol = "half-split";
    evaluation.methods = { "first", "second" };
    evaluation.images = { some_score("a,\"b\".dng", "X", 30.5, 35), some_score("c.dng", "X\xff", 20, 26) };
    return evaluation;
}

std::string read_error(const std::string& text)
{
    const ScratchFolder folder;
    const auto read = read_evaluation(folder.file("a.json", text));
    return read ? "" : read.error().message;
}

} // namespace

TEST_CASE("scores come back from JSON as they were")
{
    const ScratchFolder folder;
    const Evaluation before = some_evaluation();
    const auto after = read_evaluation(folder.file("a.json", to_json(before)));
    REQUIRE(after);
    CHECK(after->methods == before.methods);
    REQUIRE(after->images.size() == 2);
    const ImageScore &a = before.images[0], &b = after->images[0];
    CHECK(b.image == a.image);
    CHECK(b.part == a.part);
    CHECK(b.width == a.width);
    CHECK(b.truth_chromaticity == a.truth_chromaticity);
    CHECK(!b.reference_chromaticity);
    CHECK(b.notes == a.notes);
    const MethodScore &x = a.methods.at("first"), &y = b.methods.at("first");
    CHECK(y.values.at(key::kPsnr).value() == x.values.at(key::kPsnr).value());
    CHECK(y.values.at(key::kAngle).weight == 1000);
    CHECK(y.values.at(key::kHighlights).weight == 0);
    CHECK(y.error_by_level[3].sum == doctest::Approx(-0.5));
    CHECK(y.parameters == R"({"gamma":2.2})");
}

TEST_CASE("files that hold no scores are refused with what is wrong")
{
    CHECK(read_error("{").find("not JSON") != std::string::npos);
    CHECK(read_error("[]").find("is no file of scores") != std::string::npos);
    CHECK(read_error(R"({"format":"srisp-scores-1"})").find("has no 'images'") != std::string::npos);
    CHECK(read_error(R"({"format":"srisp-scores-1","methods":[],"images":[1]})").find("an image is no object") !=
          std::string::npos);
    CHECK(read_error(R"({"format":"srisp-scores-1","methods":[],"images":[{"image":1}]})").find("no text 'image'") !=
          std::string::npos);
    const std::string sizes = R"({"format":"srisp-scores-1","methods":[],"images":[{"image":"a","part":"",)"
                              R"("rendering":"","camera":"","reference":"","methods":{},"height":)";
    for (const char* height : { "1e300", "-1", "null", "4294967296" })
        CHECK(read_error(sizes + height + "}]}").find("'height' is no count of pixels") != std::string::npos);
    CHECK(read_error(sizes + "12}]}").empty());
    CHECK(!read_evaluation("/nowhere.json"));
}

TEST_CASE("CSV has a line for each image and method, and quotes what needs it")
{
    const std::string csv = to_csv(some_evaluation());
    CHECK(csv.find("image,part,rendering,camera,reference,method,psnr_db,ssim,angle_degrees") == 0);
    CHECK(csv.find("\"a,\"\"b\"\".dng\",top,fixed,X,left half,first,30.5,,3,") != std::string::npos);
    CHECK(std::count(csv.begin(), csv.end(), '\n') == 5);
}
