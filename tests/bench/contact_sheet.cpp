// SPDX-License-Identifier: Apache-2.0
// Photos × references through the library as it ships: a picture to look at, and numbers that judge what has no truth.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <nlohmann/json.hpp>
#include <srisp/apply.h>
#include <srisp/metrics.h>
#include <srisp/model.h>
#include <srisp/photo.h>
#include <srisp/reference.h>
#include <srisp/select.h>
#include <srisp/thumbnail.h>
#include <unistd.h>

#include "rank_correlation.h"

using namespace srisp;
using Json = nlohmann::ordered_json;

namespace {

struct Settings {
    std::vector<std::string> photos, references;
    std::string model = "default", output, round_trips;
    int cell_px = 160;
    bool json = false;
};

/// Three interleaved float channels.
struct Picture {
    int width = 0, height = 0;
    std::vector<float> rgb;

    Picture(int w, int h) : width(w), height(h), rgb(std::size_t(3) * w * h) {}
    ImageView view() const { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
    MutableImageView mutable_view() { return { rgb.data(), width, height, 3, std::ptrdiff_t(3) * width }; }
};

/// What one photo gave with all references.
struct PhotoScores {
    std::string name;
    std::array<double, 3> rank{};      ///< correlation of log channel means, results against references
    std::vector<double> round_trip_db; ///< forward(reverse(photo)) against the photo
    std::array<double, 3> white{};     ///< mean after the round trip of pixels that are (1, 1, 1)
    double worst_white = 0;            ///< over references: largest distance of a channel's mean from the three's mean
    std::int64_t white_pixels = 0;
};

template<class T> T require(Expected<T> result)
{
    if (result)
        return std::move(*result);
    throw std::runtime_error(result.error().message);
}

void require(const Status& status)
{
    if (!status)
        throw std::runtime_error(status.error().message);
}

Picture load_photo(const std::string& path)
{
    OIIO::ImageBuf file(path);
    if (!file.read(0, 0, true, OIIO::TypeFloat))
        throw std::runtime_error(path + ": " + file.geterror());
    file = OIIO::ImageBufAlgo::reorient(file);
    const PhotoConverter converter = require(PhotoConverter::create(file.spec(), InputEncoding::automatic, path));
    Picture photo(file.spec().width, file.spec().height);
    std::vector<float> stored(std::size_t(photo.width) * photo.height * file.nchannels());
    file.get_pixels(OIIO::ROI(), OIIO::TypeFloat, stored.data());
    PhotoCounts counts;
    converter.to_rgb(stored.data(), std::int64_t(photo.width) * photo.height, photo.rgb.data(), counts);
    return photo;
}

Picture apply(const Model& model, const Parameters& parameters, Direction direction, const Picture& image)
{
    Picture result(image.width, image.height);
    require(require(Applier::create(model, parameters, direction))->run(image.view(), result.mutable_view()));
    return result;
}

std::array<double, 3> channel_means(ImageView image)
{
    std::array<double, 3> sums{};
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < 3; ++c)
                sums[c] += image.pixel(x, y)[c];
    for (double& sum : sums)
        sum /= double(image.width) * image.height;
    return sums;
}

/// Adds the colour that pixels clipped to white in `photo` have in `round_trip`.
void add_white(const Picture& photo, const Picture& round_trip, PhotoScores& scores)
{
    std::array<double, 3> sum{};
    std::int64_t count = 0;
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3) {
        if (std::min({ photo.rgb[i], photo.rgb[i + 1], photo.rgb[i + 2] }) < 1)
            continue;
        ++count;
        for (int c = 0; c < 3; ++c)
            sum[c] += round_trip.rgb[i + c];
    }
    if (count == 0)
        return;
    const double grey = (sum[0] + sum[1] + sum[2]) / 3;
    for (int c = 0; c < 3; ++c) {
        scores.white[c] += sum[c];
        scores.worst_white = std::max(scores.worst_white, std::abs(sum[c] - grey) / count);
    }
    scores.white_pixels += count;
}

/// Pastes a picture, squashed to fit, into cell (column, row) of the sheet.
void paste(OIIO::ImageBuf& sheet, const Picture& picture, float exponent, int column, int row, int cell_px)
{
    OIIO::ImageBuf buffer(OIIO::ImageSpec(picture.width, picture.height, 3, OIIO::TypeFloat),
                          const_cast<float*>(picture.rgb.data()));
    OIIO::ImageBuf encoded = OIIO::ImageBufAlgo::pow(buffer, exponent);
    const double scale = double(cell_px - 4) / std::max(picture.width, picture.height);
    const int width = std::max(1, int(picture.width * scale)), height = std::max(1, int(picture.height * scale));
    const OIIO::ImageBuf small =
        OIIO::ImageBufAlgo::resize(encoded, "triangle", 0.0f, OIIO::ROI(0, width, 0, height, 0, 1, 0, 3));
    OIIO::ImageBufAlgo::paste(sheet, column * cell_px + (cell_px - width) / 2, row * cell_px + (cell_px - height) / 2,
                              0, 0, small);
}

/// Results and round trips as pictures; the first row shows the references, the first column the photos.
struct Sheets {
    OIIO::ImageBuf results, round_trips;
    int cell_px;

    Sheets(int columns, int rows, int cell)
        : results(OIIO::ImageSpec(columns * cell, rows * cell, 3, OIIO::TypeFloat)),
          round_trips(OIIO::ImageSpec(columns * cell, rows * cell, 3, OIIO::TypeFloat)), cell_px(cell)
    {
        for (OIIO::ImageBuf* sheet : { &results, &round_trips })
            OIIO::ImageBufAlgo::fill(*sheet, { 0.25f, 0.25f, 0.25f });
    }
    void add(const Picture& picture, float exponent, int column, int row)
    {
        paste(results, picture, exponent, column, row, cell_px);
        paste(round_trips, picture, exponent, column, row, cell_px);
    }
};

constexpr float kDisplayExponent = 1 / 2.2f; // RAW values, to be looked at

PhotoScores judge(const Model& model, const std::string& path,
                  const std::vector<std::shared_ptr<const Reference>>& references, Sheets& sheets, int row)
{
    const Picture photo = load_photo(path);
    const Thumbnail thumbnail = make_thumbnail(photo.view());
    sheets.add(photo, 1, 0, row);
    PhotoScores scores;
    scores.name = std::filesystem::path(path).filename();
    std::array<std::vector<double>, 3> results, wanted;
    for (std::size_t i = 0; i < references.size(); ++i) {
        const Parameters parameters = require(srisp::select(model, thumbnail, references[i]->thumbnail));
        const Picture raw = apply(model, parameters, Direction::reverse, photo);
        const Picture again = apply(model, parameters, Direction::forward, raw);
        scores.round_trip_db.push_back(psnr(again.view(), photo.view()));
        add_white(photo, again, scores);
        const auto result_means = channel_means(raw.view());
        const auto reference_means = channel_means(references[i]->thumbnail.view());
        for (int c = 0; c < 3; ++c) {
            results[c].push_back(std::log(std::max(result_means[c], 1e-6)));
            wanted[c].push_back(std::log(std::max(reference_means[c], 1e-6)));
        }
        paste(sheets.results, raw, kDisplayExponent, int(i) + 1, row, sheets.cell_px);
        paste(sheets.round_trips, again, 1, int(i) + 1, row, sheets.cell_px);
    }
    for (int c = 0; c < 3; ++c) {
        scores.rank[c] = rank_correlation(results[c], wanted[c]);
        scores.white[c] /= std::max<std::int64_t>(1, scores.white_pixels);
    }
    return scores;
}

double mean(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / values.size();
}

void write(const OIIO::ImageBuf& sheet, const std::string& path)
{
    if (path.empty())
        return;
    const std::string temporary = path + ".part" + std::filesystem::path(path).extension().string();
    if (!sheet.write(temporary, OIIO::TypeUInt8))
        throw std::runtime_error(path + ": " + sheet.geterror());
    std::filesystem::rename(temporary, path);
}

Json summary(const std::vector<PhotoScores>& photos)
{
    Json list = Json::array();
    double lowest_db = 1e9, sum_db = 0, worst_white = 0;
    std::array<double, 3> lowest_rank{ 1, 1, 1 };
    for (const PhotoScores& p : photos) {
        const double lowest = *std::min_element(p.round_trip_db.begin(), p.round_trip_db.end());
        list.push_back({ { "photo", p.name },
                         { "rank_correlation", p.rank },
                         { "round_trip_mean_db", mean(p.round_trip_db) },
                         { "round_trip_lowest_db", lowest },
                         { "white_pixels_all_references", p.white_pixels },
                         { "white_after_round_trip", p.white },
                         { "worst_white_tint", p.worst_white } });
        lowest_db = std::min(lowest_db, lowest);
        sum_db += mean(p.round_trip_db);
        worst_white = std::max(worst_white, p.worst_white);
        for (int c = 0; c < 3; ++c)
            lowest_rank[c] = std::min(lowest_rank[c], p.rank[c]);
    }
    return { { "photos", list },
             { "lowest_rank_correlation", lowest_rank },
             { "round_trip_mean_db", sum_db / photos.size() },
             { "round_trip_lowest_db", lowest_db },
             { "worst_white_tint", worst_white } };
}

void print(const Json& result)
{
    std::printf("photo                     rank correlation        round trip dB     white after round trip   tint\n"
                "                           R      G      B       mean   lowest\n");
    for (const Json& p : result["photos"]) {
        const auto& rank = p["rank_correlation"];
        const auto& white = p["white_after_round_trip"];
        std::printf("%-22.22s  %+.2f  %+.2f  %+.2f     %6.2f   %6.2f", p["photo"].get<std::string>().c_str(),
                    rank[0].get<double>(), rank[1].get<double>(), rank[2].get<double>(),
                    p["round_trip_mean_db"].get<double>(), p["round_trip_lowest_db"].get<double>());
        if (p["white_pixels_all_references"].get<std::int64_t>() > 0)
            std::printf("     %.3f %.3f %.3f      %.3f", white[0].get<double>(), white[1].get<double>(),
                        white[2].get<double>(), p["worst_white_tint"].get<double>());
        std::printf("\n");
    }
    const auto& rank = result["lowest_rank_correlation"];
    std::printf("all: lowest rank correlation %+.2f %+.2f %+.2f, round trip %.2f dB on average, lowest %.2f, "
                "largest tint of white %.3f\n",
                rank[0].get<double>(), rank[1].get<double>(), rank[2].get<double>(),
                result["round_trip_mean_db"].get<double>(), result["round_trip_lowest_db"].get<double>(),
                result["worst_white_tint"].get<double>());
}

int run(const Settings& settings)
{
    const std::shared_ptr<const Model> model = require(Model::load(settings.model));
    Sheets sheets(int(settings.references.size()) + 1, int(settings.photos.size()) + 1, settings.cell_px);
    std::vector<std::shared_ptr<const Reference>> references;
    for (const std::string& path : settings.references) {
        references.push_back(require(load_reference(path)));
        Picture picture(kThumbnailSize, kThumbnailSize);
        picture.rgb = references.back()->thumbnail.rgb;
        sheets.add(picture, kDisplayExponent, int(references.size()), 0);
    }
    std::vector<PhotoScores> scores;
    for (const std::string& path : settings.photos) {
        scores.push_back(judge(*model, path, references, sheets, int(scores.size()) + 1));
        if (isatty(STDERR_FILENO))
            std::fprintf(stderr, "\r%zu of %zu photos ", scores.size(), settings.photos.size());
    }
    write(sheets.results, settings.output);
    write(sheets.round_trips, settings.round_trips);
    const Json result = summary(scores);
    if (settings.json)
        std::printf("%s\n", result.dump(2).c_str());
    else
        print(result);
    return 0;
}

} // namespace

int main(int argc, char** argv)
{
    Settings settings;
    CLI::App app{ "Unprocesses photos with references, every one with every one, and says how well it went." };
    app.add_option("--photos", settings.photos, "photos")->required()->check(CLI::ExistingFile);
    app.add_option("--references", settings.references, "RAW files")->required()->check(CLI::ExistingFile);
    app.add_option("--model", settings.model, "model name or file")->capture_default_str();
    app.add_option("-o,--output", settings.output, "contact sheet of the results, RAW values at gamma 2.2 (PNG, JPEG)");
    app.add_option("--round-trips", settings.round_trips, "contact sheet of forward(reverse(photo))");
    app.add_option("--cell", settings.cell_px, "size of a picture on the sheet, pixels")
        ->capture_default_str()
        ->check(CLI::Range(16, 2048));
    app.add_flag("--json", settings.json, "print one JSON object");
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    }
    try {
        return run(settings);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "contact_sheet: %s\n", error.what());
        return 1;
    }
}
