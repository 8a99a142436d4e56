// SPDX-License-Identifier: Apache-2.0
#include "../../../tools/srisppack/camera_folder.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <doctest/doctest.h>

#include "../failure_of.h"
#include "scratch_folder.h"
#include "shared_files.h"

using namespace srisp;
using namespace srisp::tool;

namespace {

/// A spectral file: `wavelengths` lines of the same numbers from 380 nm on in steps of 5 nm.
std::string spectral_json(const std::string& columns, const std::string& values, int wavelengths = 81)
{
    std::string text =
        R"({"header":{"manufacturer":"Anna","model":"One","license":"CC0"},"spectral_data":{"index":{"main":[)" +
        columns + R"(]},"data":{"main":{)";
    for (int i = 0; i < wavelengths; ++i)
        text += (i ? ",\"" : "\"") + std::to_string(380 + 5 * i) + "\":[" + values + "]";
    return text + "}}}}";
}

/// Light of a blackbody, relative. [Planck]
double planck(double wavelength_nm, double temperature_k)
{
    const double metres = wavelength_nm * 1e-9;
    return std::pow(metres * 1e6, -5) / (std::exp(1.4388e-2 / (metres * temperature_k)) - 1);
}

/// What camera `index` sees of white in this light, G = 1.
std::vector<double> white(const PackedCameras& cameras, std::size_t index, const std::vector<double>& light)
{
    std::vector<double> rgb(3);
    for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t i = 0; i < kPackWavelengths; ++i)
            rgb[c] += cameras.sensitivities[(index * 3 + c) * kPackWavelengths + i] * light[i] *
                      (cameras.reflectance[i] + cameras.reflectance[kPackWavelengths + i] +
                       cameras.reflectance[2 * kPackWavelengths + i]);
    return { rgb[0] / rgb[1], 1, rgb[2] / rgb[1] };
}

std::size_t index_of(const std::vector<PackSpectrum>& list, const std::string& name)
{
    const auto found =
        std::find_if(list.begin(), list.end(), [&](const PackSpectrum& spectrum) { return spectrum.name == name; });
    REQUIRE(found != list.end());
    return std::size_t(found - list.begin());
}

} // namespace

TEST_CASE("measured cameras are read, named, normalized and split")
{
    SKIP_WITHOUT_SHARED("data/cameras");
    const CameraFolder folder = read_camera_folder(shared_file("data/cameras"));
    CHECK(folder.names.cameras.size() == 44);
    CHECK(folder.names.lights.size() == 74);
    int validation = 0;
    for (const PackSpectrum& camera : folder.names.cameras) {
        validation += camera.validation;
        CHECK(camera.licence == "Apache-2.0");
    }
    CHECK(validation == 8);
    CHECK(folder.names.cameras[4].validation);
    CHECK(folder.names.lights[index_of(folder.names.lights, "CIE_A")].kind == "tungsten");
    CHECK(folder.names.lights[index_of(folder.names.lights, "CIE_illum_FLs_4")].kind == "fluorescent");
    CHECK(folder.names.lights[index_of(folder.names.lights, "CIE_illum_LEDs_1")].kind == "led");
    CHECK(folder.names.lights[index_of(folder.names.lights, "iso7589_stutung_380_780_5")].kind == "tungsten");
    const std::vector<float>& sensitivities = folder.spectra.sensitivities;
    for (std::size_t camera = 0; camera < 44; ++camera)
        CHECK(*std::max_element(sensitivities.begin() + std::ptrdiff_t(camera * 243),
                                sensitivities.begin() + std::ptrdiff_t(camera * 243 + 243)) == 1);
}

TEST_CASE("white has the camera colours that another program computes from the same spectra")
{
    SKIP_WITHOUT_SHARED("data/cameras");
    const CameraFolder folder = read_camera_folder(shared_file("data/cameras"));
    std::vector<double> d65, tungsten;
    const std::size_t at = index_of(folder.names.lights, "CIE_D_6500K") * kPackWavelengths;
    for (std::size_t i = 0; i < kPackWavelengths; ++i) {
        d65.push_back(folder.spectra.lights[at + i]);
        tungsten.push_back(planck(380 + 5 * double(i), 2856));
    }
    // NumPy's singular value decomposition, uncentred: R, B under D65, then under 2856 K.
    const struct {
        const char* camera;
        double values[4];
    } expected[] = { { "Canon EOS 5D Mark II", { 0.404881, 0.729393, 0.724299, 0.376636 } },
                     { "Canon EOS 5DS", { 0.398253, 0.681439, 0.732354, 0.390419 } } };
    for (const auto& check : expected) {
        const std::size_t camera = index_of(folder.names.cameras, check.camera);
        const std::vector<double> day = white(folder.spectra, camera, d65),
                                  lamp = white(folder.spectra, camera, tungsten);
        const double values[] = { day[0], day[2], lamp[0], lamp[2] };
        for (int i = 0; i < 4; ++i)
            CHECK_MESSAGE(std::abs(values[i] - check.values[i]) < 1e-5, check.camera, " value ", i, " is ", values[i]);
    }
}

TEST_CASE("folders of cameras that lack something are refused by name")
{
    const ScratchFolder scratch;
    const auto message = [&] { return failure_of([&] { read_camera_folder(scratch.path()); }).substr(3); };
    std::filesystem::create_directory(scratch.path("sensitivities"));
    CHECK(is_camera_folder(scratch.path()));
    CHECK(message() == "'" + scratch.path("sensitivities") + "' holds no .json files");
    const auto camera_message = [&](const std::string& text) {
        scratch.file("sensitivities/a.json", text);
        const std::string full = message();
        return full.substr(full.find("a.json'") + 7);
    };
    CHECK(camera_message("{") == ": file is not a JSON object (line 1, column 2)");
    CHECK(camera_message("{}") == " has no spectral_data with index and data");
    CHECK(camera_message(spectral_json(R"("R","G")", "1,2")) == " has no column 'B'; did you mean 'G' or 'R'?");
    CHECK(camera_message(spectral_json(R"("R","G","B")", "1,2")) == ", 380.000000 nm: has 2 numbers, needs 3");
    CHECK(camera_message(spectral_json(R"("R","G","B")", "1,2,\"x\"")) == ", 380 nm: \"x\" is not a finite number");
    CHECK(camera_message(spectral_json(R"("R","G","B")", "1,2,3", 60)) ==
          " covers 380 to 675 nm, 400 to 700 are needed");
    CHECK(camera_message(spectral_json(R"("R","G","B")", "0,0,-1")) == ": all sensitivities are 0");
    scratch.file("sensitivities/a.json", spectral_json(R"("R","G","B")", "1,2,3"));
    CHECK(message().find("cmf_1931.json") != std::string::npos);
    scratch.file("cmf_1931.json", spectral_json(R"("X","Y","Z")", "1,2,3"));
    CHECK(message().find("illuminants.csv") != std::string::npos);
    scratch.file("illuminants.csv", "wavelength_nm,CIE_A\n380,1\n780,1\n");
    CHECK(message() == "'" + scratch.path("illuminants.csv") + "' has no column 'CIE_D_6500K'");
    scratch.file("illuminants.csv", "wavelength_nm,moon\n380,1\n780,1\n");
    CHECK(message().find("the kind of light 'moon' is not known; names must begin with CIE_illum_FL, ") !=
          std::string::npos);
    scratch.file("illuminants.csv", "wavelength_nm,CIE_D_6500K\n380,1\n780,x\n");
    CHECK(message().find(", 780 nm, 'CIE_D_6500K': 'x' is not a finite number") != std::string::npos);
    scratch.file("illuminants.csv", "wavelength_nm,CIE_D_6500K\n380,1\n780,1\n");
    scratch.file("training_spectral.json", spectral_json(R"("a","b","c")", "1,1,1"));
    CHECK(message() == "the measured reflectances have fewer than three independent spectra");
}
