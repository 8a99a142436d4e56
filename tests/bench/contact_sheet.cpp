// SPDX-License-Identifier: Apache-2.0
// Photos × references through the library as it ships: a picture to look at, and numbers for what has no truth. The
// first row of the sheet shows the references, the first column the photos.
#include <algorithm>
#include <cstdio>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "base/progress.h"
#include "photo_scores.h"
#include "require.h"

using namespace srisp;
using Json = nlohmann::ordered_json;

namespace {

struct Settings {
    std::vector<std::string> photos, references;
    std::string model = "default", output, round_trips;
    int cell_px = 160;
    bool json = false;
};

double mean(const std::vector<double>& values)
{
    double sum = 0;
    for (const double value : values)
        sum += value;
    return sum / values.size();
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
    const int columns = int(settings.references.size()) + 1, rows = int(settings.photos.size()) + 1;
    Sheet results(columns, rows, settings.cell_px), round_trips(columns, rows, settings.cell_px);
    const Sheets sheets{ &results, &round_trips };
    std::vector<std::shared_ptr<const Reference>> references;
    for (const std::string& path : settings.references) {
        references.push_back(require(load_reference(path)));
        Picture picture(kThumbnailSize, kThumbnailSize);
        picture.rgb = references.back()->thumbnail.rgb;
        sheets.paste(picture, kDisplayExponent, int(references.size()), 0);
    }
    std::vector<PhotoScores> scores;
    ProgressMeter meter({ "contact_sheet", "photos", std::int64_t(settings.photos.size()) }, true);
    for (const std::string& path : settings.photos) {
        scores.push_back(judge_photo(*model, path, references, sheets, int(scores.size()) + 1));
        meter.show(std::int64_t(scores.size()));
    }
    meter.wipe();
    if (!settings.output.empty())
        results.write(settings.output);
    if (!settings.round_trips.empty())
        round_trips.write(settings.round_trips);
    const Json result = summary(scores);
    if (settings.json)
        std::puts(result.dump(2).c_str());
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
