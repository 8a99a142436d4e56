// SPDX-License-Identifier: Apache-2.0
// Makes what the fuzz targets start from: make_fuzz_seeds FOLDER. What run.sh --merge found beyond that lies beside it.
#include <cstdio>

#include <nlohmann/json.hpp>
#include <srisp/develop.h>
#include <srisp/metadata.h>

#include "model/safetensors.h"
#include "random_model.h"
#include "record/record.h"
#include "scratch_folder.h"
#include "seed_folder.h"
#include "tiny_pack.h"

using namespace srisp;

namespace {

Parameters made_parameters()
{
    Parameters parameters;
    parameters.tone_weights.fill({ 0.25f, 0.75f });
    parameters.gamma_weights = parameters.color_weights = parameters.gain_weights = { 1 };
    parameters.white_balance = { 2.1f, 1, 1.6f };
    parameters.brightness_sd_ev = 0.5f;
    parameters.brightness_ev = 1;
    parameters.model_name = "default";
    parameters.model_hash = "xxh128:00112233445566778899aabbccddeeff";
    parameters.reference_name = "a.dng";
    return parameters;
}

void make_json(const SeedFolder& seeds)
{
    const std::string parameters = to_json(made_parameters());
    seeds.add("parameters", "all", parameters);
    seeds.add("json", "parameters", parameters);
    seeds.add("json", "values", R"([null, true, -1, 18446744073709551615, 1.5e300, "\u00e9\ud83d\ude00", {"a": {}}])");
    seeds.add("recipe", "recipe",
              R"(r{"format": "srisp-recipe-1", "source": "a.jpg", "references": ["b.dng"],)"
              R"( "direction": "reverse", "seed": 3, "mosaic": "rggb", "noise": "iso=800"})");
    seeds.add("recipe", "job",
              R"(j{"format": "srisp-recipe-1", "action": "save", "file": "p.json", "brightness": 0.5,)"
              R"( "params": )" +
                  to_json(made_parameters(), -1) + "}");
    for (const char* query : { "brightness\0sample",
                               "resize\0"
                               "640x0",
                               "crop\0random:16x9", "noise\0shot=0.01,read=1e-4",
                               "whitebalance\0"
                               "5600,10",
                               "exposure\0-1.5", "develop\0ACEScg",
                               "seed\0"
                               "12",
                               "mosaic\0RGGB" }) {
        const std::string key = query, value = query + key.size() + 1;
        seeds.add("query", key, key + '\0' + value + '\0');
    }
    seeds.add("query", "frames", literal("model\0s.1-9@@.tif\0params\0p.%04d.json"));
    seeds.add("training_settings", "all",
              R"({"rate": 0.5, "flag": true, "target": "rgb", "init": "m.safetensors",)"
              R"( "inner": {"steps": 7, "range": [0.1, 0.9]}})");
    seeds.add("training_settings", "assignment", "inner.range=0.1,0.9");
    seeds.add("noise_profiles", "two",
              R"({"version": 0, "noiseprofiles": [{"maker": "Canon", "models": [{"model": )"
              R"("EOS 5D", "profiles": [{"iso": 100, "a": [1e-5, 2e-5, 3e-5], "b": [0, 0, 0]},)"
              R"( {"iso": 400, "a": [7e-5, 8e-5, 9e-5], "b": [1e-7, 1e-7, 1e-7]}]}]}]})");
}

void make_records(const SeedFolder& seeds)
{
    Development development;
    development.space = "ACEScg";
    seeds.add("record_line", "development", to_json(development));
    RecordLine line;
    line.parameters = to_json(made_parameters(), -1);
    line.description = "a photo";
    line.sensor = R"({"cfa_pattern": "RGGB", "black_level": [0.1, 0.1, 0.1, 0.1], "white_level": 0.9})";
    line.development = to_json(development);
    seeds.add("record_line", "line", format_record(line) + "\nmore");
    OIIO::ImageSpec spec(4, 4, 1, OIIO::TypeFloat);
    mark_result(spec, Direction::reverse);
    SensorValues sensor;
    sensor.cfa_pattern = "RGGB";
    sensor.black_level = { 0.1f, 0.1f, 0.1f, 0.1f };
    sensor.noise_profile = { 1e-4, 1e-7 };
    record_sensor_values(spec, sensor);
    seeds.add("record_line", "sensor", spec.get_string_attribute("ImageDescription"));
}

void make_models(const SeedFolder& seeds)
{
    const ScratchFolder scratch;
    const std::string path = scratch.path("a.safetensors");
    const std::uint16_t values[6] = { 0, 0x3c00, 0x7c00, 1, 2, 3 };
    for (const char* type : { "F16", "BF16", "F32", "U8" }) {
        if (write_safetensors(path, { { "a", type, { 1, 3 }, values }, { "b", "F16", { 2 }, values } },
                              { { "format", "srisp-1" } }))
            seeds.add("safetensors", type, bytes_of(path));
    }
    for (char edit = 0; edit < 8; ++edit)
        seeds.add("model", "edit" + std::to_string(edit), literal("\0\0\0\0\3\0") + edit + literal("\0\2\3\4\5\0"));
}

void make_tools(const SeedFolder& seeds)
{
    const ScratchFolder scratch;
    write_tiny_pack(scratch.path("pack"));
    seeds.add("pack_index", "tiny", bytes_of(scratch.path("pack") + "/pack.json"));
    seeds.add("csv", "quoted", "\xef\xbb\xbfphoto,raw\r\n\"a,\"\"b\"\"\",c\n\nd,e");
    seeds.add("manifest", "lines",
              R"({"output": "a.exr", "settings": "xxh128:00", "reference": "r.dng", "photo_hash": "p",)"
              R"( "reference_hash": "q", "bytes": 12, "output_hash": "h", "time": 1})"
              "\n"
              R"({"output": "a.exr", "bytes": 13, "time": 2})"
              "\n{\"output\": \"b");
    seeds.add("messages", "two", literal("\2\0\0\0\3\0\0\0abc\0\0\0\0"));
    std::string task("\14\0\0\0", 4);
    for (int i = 0; i < 12; ++i)
        task += literal("\1\0\0\0") + char('0' + i % 2);
    seeds.add("messages", "task", task);
    seeds.add("yaml_fragment", "config",
              "ocio_profile_version: 2\n\nenvironment:\n  A: b\nsearch_path: \"\"\nlooks:\n"
              "  - !<Look>\n    name: x\n# next\ncolorspaces:\n  []\n");
    seeds.add("scores", "scores",
              R"(s{"format": "srisp-scores-1", "methods": ["default"], "images": [{"image": "a.dng",)"
              R"( "part": "", "rendering": "fixed", "camera": "c", "reference": "r", "width": 8, "height": 6,)"
              R"( "reference_chromaticity": null, "truth_chromaticity": [0.1, 0.2], "notes": ["n"],)"
              R"( "methods": {"default": {"psnr_db": 30.5, "weights": {}, "error_by_level": [],)"
              R"( "chromaticity": null, "parameters": null}}}]})");
    seeds.add("scores", "journal",
              R"(j{"format":"srisp-evaluation-1","settings":"settings"})"
              "\n"
              R"({"task":"t","images":[],"left_out":[["a","b"]]})"
              "\n");
    for (const char* target : { "apply", "kernels", "tone_kernels", "dng_round_trip" })
        for (char kind = 0; kind < 5; ++kind) {
            std::string bytes(1, kind);
            for (int i = 0; i < 300; ++i)
                bytes += char(i * (2 * kind + 37) + i / 7);
            seeds.add(target, std::to_string(int(kind)), bytes);
        }
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fprintf(stderr, "usage: make_fuzz_seeds FOLDER\n");
        return 2;
    }
    const SeedFolder seeds(argv[1]);
    make_json(seeds);
    make_records(seeds);
    make_models(seeds);
    make_tools(seeds);
    make_raw_seeds(seeds);
    make_image_seeds(seeds);
    return 0;
}
