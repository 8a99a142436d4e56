// SPDX-License-Identifier: Apache-2.0
#include "camera_folder.h"

#include <algorithm>
#include <filesystem>

#include "../common/failure.h"
#include "base/near_names.h"
#include "base/shown_text.h"
#include "spectra.h"

namespace srisp::tool {

namespace fs = std::filesystem;

namespace {

const char kD65[] = "CIE_D_6500K";
constexpr std::size_t kValidationShare = 5; // one in so many

/// How names of lights begin, and of which kind they are.
constexpr struct {
    const char *prefix, *kind;
} kLightKinds[] = {
    { "CIE_illum_FL", "fluorescent" }, { "CIE_illum_LED", "led" },       { "CIE_D", "daylight" },
    { "CIE_A", "tungsten" },           { "iso7589", "tungsten" },        { "daylight", "daylight" },
    { "tungsten", "tungsten" },        { "fluorescent", "fluorescent" }, { "led", "led" },
};

std::string kind_of(const std::string& light, const std::string& where)
{
    std::string known;
    for (const auto& kind : kLightKinds) {
        if (light.rfind(kind.prefix, 0) == 0)
            return kind.kind;
        known += (known.empty() ? "" : ", ") + std::string(kind.prefix);
    }
    fail(where + ": the kind of light '" + shown_text(light) + "' is not known; names must begin with " + known);
}

/// JSON files of a folder whose names begin with `prefix`, sorted.
std::vector<std::string> json_files(const fs::path& folder, const std::string& prefix)
{
    std::vector<std::string> files;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error))
        if (entry->path().extension() == ".json" && entry->path().filename().string().rfind(prefix, 0) == 0)
            files.push_back(entry->path().string());
    std::sort(files.begin(), files.end());
    return files;
}

std::array<Spectrum, 3> three_columns(const SpectraTable& table, const std::vector<std::string>& names)
{
    std::array<Spectrum, 3> spectra;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto found = std::find(table.columns.begin(), table.columns.end(), names[i]);
        if (found == table.columns.end())
            fail(table.where + " has no column '" + names[i] + "'" + near_names(names[i], table.columns));
        spectra[i] = resampled(table, std::size_t(found - table.columns.begin()));
    }
    return spectra;
}

void append(const Spectrum& spectrum, double scale, std::vector<float>& values)
{
    for (const double value : spectrum)
        values.push_back(float(value * scale));
}

std::string or_not_stated(const std::string& text)
{
    return text.empty() ? "not stated" : text;
}

struct Camera {
    PackSpectrum about;
    std::array<Spectrum, 3> sensitivities;
};

void add_cameras(const fs::path& folder, CameraFolder& result)
{
    std::vector<Camera> cameras;
    for (const std::string& file : json_files(folder / "sensitivities", "")) {
        const SpectraTable table = read_spectra_json(file);
        Camera camera;
        camera.sensitivities = three_columns(table, { "R", "G", "B" });
        const std::string stem = fs::path(file).stem().string(), name = table.manufacturer + " " + table.model;
        camera.about = { table.model.empty() ? stem : name, "", fs::path(file).filename().string(),
                         or_not_stated(table.licence) };
        cameras.push_back(std::move(camera));
    }
    if (cameras.empty())
        fail("'" + (folder / "sensitivities").string() + "' holds no .json files");
    std::stable_sort(cameras.begin(), cameras.end(),
                     [](const Camera& a, const Camera& b) { return a.about.name < b.about.name; });
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        Camera& camera = cameras[i];
        double largest = 0;
        for (Spectrum& channel : camera.sensitivities)
            for (double& value : channel)
                largest = std::max(largest, value = std::max(value, 0.0));
        if (largest == 0)
            fail("'" + camera.about.source + "': all sensitivities are 0");
        for (const Spectrum& channel : camera.sensitivities)
            append(channel, 1 / largest, result.spectra.sensitivities);
        camera.about.validation = i % kValidationShare == kValidationShare - 1;
        result.names.cameras.push_back(camera.about);
    }
}

/// Lights of one table; the luminance of each becomes that of a light that is 1 everywhere.
void add_lights(const SpectraTable& table, const std::string& source, const std::string& licence,
                const Spectrum& luminosity, CameraFolder& result)
{
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
        const std::string name =
            table.columns[column] == "power" ? fs::path(source).stem().string() : table.columns[column];
        Spectrum light = resampled(table, column);
        double weighted = 0, weights = 0;
        for (int i = 0; i < kPackWavelengths; ++i) {
            light[i] = std::max(light[i], 0.0);
            weighted += light[i] * luminosity[i];
            weights += luminosity[i];
        }
        if (!(weighted > 0))
            fail(table.where + ": light '" + shown_text(name) + "' has no luminance");
        append(light, weights / weighted, result.spectra.lights);
        result.names.lights.push_back({ name, kind_of(name, table.where), source, licence });
    }
}

void add_reflectance(const fs::path& folder, const std::array<Spectrum, 3>& observer, const SpectraTable& lights,
                     CameraFolder& result)
{
    const auto d65 = std::find(lights.columns.begin(), lights.columns.end(), kD65);
    if (d65 == lights.columns.end())
        fail(lights.where + " has no column '" + kD65 + "'");
    const SpectraTable measured = read_spectra_json((folder / "training_spectral.json").string());
    std::vector<Spectrum> spectra;
    for (std::size_t column = 0; column < measured.columns.size(); ++column)
        spectra.push_back(resampled(measured, column));
    for (const Spectrum& color :
         reflectance_basis(spectra, observer, resampled(lights, std::size_t(d65 - lights.columns.begin()))))
        append(color, 1, result.spectra.reflectance);
}

} // namespace

bool is_camera_folder(const std::string& folder)
{
    std::error_code ignored;
    return fs::is_directory(fs::path(folder) / "sensitivities", ignored);
}

CameraFolder read_camera_folder(const std::string& name)
{
    const fs::path folder = name;
    CameraFolder result;
    for (int i = 0; i < kPackWavelengths; ++i)
        result.spectra.wavelengths.push_back(kFirstWavelength_nm + float(i) * kWavelengthStep_nm);
    add_cameras(folder, result);
    const std::array<Spectrum, 3> observer =
        three_columns(read_spectra_json((folder / "cmf_1931.json").string()), { "X", "Y", "Z" });
    const SpectraTable lights = read_spectra_csv((folder / "illuminants.csv").string());
    std::error_code ignored;
    const bool licence = fs::exists(folder / "LICENSE", ignored);
    add_lights(lights, "illuminants.csv", licence ? "as LICENSE beside it" : "not stated", observer[1], result);
    for (const std::string& file : json_files(folder, "iso7589")) {
        const SpectraTable table = read_spectra_json(file);
        add_lights(table, fs::path(file).filename().string(), or_not_stated(table.licence), observer[1], result);
    }
    add_reflectance(folder, observer, lights, result);
    return result;
}

} // namespace srisp::tool
