// SPDX-License-Identifier: Apache-2.0
#include "../../../../tools/srispeval/report/report_page.h"

#include <doctest/doctest.h>

#include "../../../../tools/srispeval/metric_table.h"
#include "sample_evaluation.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// Bytes that stand for pictures: nothing here looks at them.
ImagePictures plain_pictures(const Evaluation& evaluation)
{
    ImagePictures pictures;
    pictures.width = 3;
    pictures.height = 2;
    pictures.photo = "photo";
    if (evaluation.has_truth)
        pictures.truth = "truth";
    for (const std::string& method : evaluation.methods)
        pictures.results[method] = "result";
    return pictures;
}

std::string page_of(const Evaluation& evaluation, const std::vector<std::size_t>& shown)
{
    MemorySink sink;
    CHECK(write_report(
        evaluation, shown, [&](std::size_t) { return plain_pictures(evaluation); }, sink));
    return sink.bytes();
}

std::size_t count_of(const std::string& text, const std::string& part)
{
    std::size_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
        ++count;
    return count;
}

bool has(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

/// A disk that is full after so many bytes.
class FullSink : public ByteSink {
public:
    using ByteSink::write;
    void write(const void*, std::size_t bytes) override { m_left -= m_left < bytes ? m_left : bytes; }
    bool good() const override { return m_left > 0; }

private:
    std::size_t m_left = 300000;
};

} // namespace

TEST_CASE("hostile names are text, and the page runs its own three scripts only")
{
    const std::string page = page_of(sample_evaluation(true, 20), { 1, 3, 0 });
    CHECK(count_of(page, "<script>") == 3);
    CHECK(count_of(page, "</script>") == 3);
    CHECK(count_of(page, "'sha256-") == 3);
    CHECK(has(page, "&lt;script&gt;alert(1)&lt;/script&gt;.dng"));
    CHECK_FALSE(has(page, "<img src=x"));
    CHECK_FALSE(has(page, "<b>bold"));
    CHECK(has(page, "caf\\xe9/\\xff\\xfe\\x07.dng"));
    CHECK_FALSE(has(page, "\xff"));
}

TEST_CASE("the page asks for nothing")
{
    const std::string page = page_of(sample_evaluation(true, 20), { 1, 3 });
    for (const char* word : { "http:", "https:", "@import", "<link", "src=\"//", "fetch(" })
        CHECK_FALSE(has(page, word));
    CHECK(has(page, "default-src 'none'"));
}

TEST_CASE("pictures are asked for once each, in order, and only one image's are held")
{
    const Evaluation evaluation = sample_evaluation(true, 20);
    std::vector<std::size_t> asked;
    MemorySink sink;
    const std::vector<std::size_t> shown{ 7, 2, 19, 0 };
    CHECK(write_report(
        evaluation, shown,
        [&](std::size_t index) -> Expected<ImagePictures> {
            asked.push_back(index);
            if (index == 2)
                return Error{ "file 'x<y' has vanished" };
            return plain_pictures(evaluation);
        },
        sink));
    CHECK(asked == shown);
    CHECK(has(sink.bytes(), "Its pictures cannot be shown: file &#39;x&lt;y&#39; has vanished"));
    CHECK(sink.bytes().find("id=\"picture-7\"") < sink.bytes().find("id=\"picture-19\""));
}

TEST_CASE("a picture's data is in the page once, and the rest of an image is small")
{
    const Evaluation evaluation = sample_evaluation(true, 60);
    std::vector<std::size_t> shown, few{ 0 };
    for (std::size_t i = 0; i < 50; ++i)
        shown.push_back(i);
    const std::string page = page_of(evaluation, shown);
    CHECK(count_of(page, "base64,") == 50 * (2 + evaluation.methods.size()));
    CHECK((page.size() - page_of(evaluation, few).size()) / 49 < 12000);
}

TEST_CASE("the worst ten have a heading of their own where there are more")
{
    const Evaluation evaluation = sample_evaluation(true, 20);
    std::vector<std::size_t> shown{ 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10 };
    CHECK(has(page_of(evaluation, shown), "The worst ten"));
    CHECK(has(page_of(evaluation, shown), "Further images"));
    shown.pop_back();
    CHECK_FALSE(has(page_of(evaluation, shown), "Further images"));
}

TEST_CASE("the answer is made of the numbers")
{
    Evaluation evaluation = sample_evaluation(true, 20);
    evaluation.groups.resize(1);
    GroupSummary& group = evaluation.groups[0];
    group.methods.resize(2);
    group.images = 120;
    group.cameras = 9;
    group.methods[1].over_baseline[key::kPsnr] = { 5.61, 5.1, 6.2 };
    group.methods[0].values[key::kAngle] = { 4, 3, 5 };
    group.methods[1].values[key::kAngle] = { 1.68, 1, 2 };
    CHECK(has(page_of(evaluation, {}),
              "<strong>default</strong> is +5.61\u00a0dB (95\u00a0% interval +5.10 to +6.20) over "
              "gain_match in PSNR, at 0.42 of its colour angle, on 120 images of 9 cameras."));
    group.methods[1].over_baseline[key::kPsnr] = { 0.1, -0.1, 0.3 };
    CHECK(has(page_of(evaluation, {}), "<strong>default</strong> and gain_match cannot be told apart by PSNR"));
    CHECK(has(page_of(evaluation, {}), "within the noise"));
    CHECK_FALSE(has(page_of(evaluation, {}), "Not complete"));
    evaluation.complete = false;
    CHECK(has(page_of(evaluation, {}), "Not complete"));
}

TEST_CASE("no number is printed as nan, and what has no truth has no truth's pictures")
{
    const std::string page = page_of(sample_evaluation(false, 12), { 0, 1 });
    CHECK_FALSE(has(page, ">nan"));
    CHECK_FALSE(has(page, "nan "));
    CHECK_FALSE(has(page, "data-kind=\"truth\""));
    CHECK_FALSE(has(page, "Error by brightness"));
    CHECK(has(page, "rank, R"));
    CHECK(has(page, "photos as given"));
}

TEST_CASE("an evaluation of nothing is a page, too")
{
    Evaluation evaluation;
    evaluation.protocol = "pairs";
    CHECK(has(page_of(evaluation, {}), "No image could be tested"));
    evaluation.methods = { "only" };
    evaluation.images.resize(1);
    evaluation.groups = { { "fixed", "", 1, 1, 1, { { "only", {}, {}, {}, {}, {} } } } };
    CHECK(has(page_of(evaluation, { 0 }), "</html>"));
}

TEST_CASE("a full disk is an error, and pictures are no longer asked for")
{
    const Evaluation evaluation = sample_evaluation(true, 60);
    std::vector<std::size_t> shown;
    for (std::size_t i = 0; i < 60; ++i)
        shown.push_back(i);
    int asked = 0;
    FullSink sink;
    const Status status = write_report(
        evaluation, shown,
        [&](std::size_t) {
            ++asked;
            return plain_pictures(evaluation);
        },
        sink);
    CHECK_FALSE(status);
    CHECK(asked < 60);
}
