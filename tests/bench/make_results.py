#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Makes docs/results.md and the report it links to, from the validation parts of the data.

    /usr/bin/python3 tests/bench/make_results.py --shared ../shared --build build

What takes long is kept in BUILD/results, and a run that is stopped goes on there. To begin anew, remove that folder."""
import argparse
import csv
import json
import os
import shutil
import statistics
import subprocess
import sys

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
MODELS = ["default", "spatial"]
SETS = {"real": "real RAW", "simulated": "simulated"}
RENDERINGS = ["fixed", "random", "camera"]
ALL_IMAGES = ["--set", "real_images=500", "--set", "real_validation_only=false", "--set", "simulated_images=0"]
PICTURE = "8"  # of the images shown in the report
REPORT = ["--pictures", "10", "--report-size", "2.8"]
# Whose means lie apart.
THERE_AND_BACK = ["blackmagic_pocket.dng", "raspberry_pi.dng", "canon_kiss_x4.dng", "gopro_hero6.dng",
                  "canon_powershot_g2.crw", "canon_powershot_s40.crw"]


class Work:
    """Runs programs whose outputs are not there yet."""

    def __init__(self, options):
        self.shared, self.build = os.path.abspath(options.shared), os.path.abspath(options.build)
        self.folder = self.build + "/results"
        os.makedirs(self.folder, exist_ok=True)

    def path(self, name):
        return f"{self.folder}/{name}"

    def program(self, name):
        return f"{self.build}/bin/{name}"

    def make(self, output, command, stdout=False, may_fail=False):
        """The output's path. `stdout`: it is what the command prints."""
        path = self.path(output)
        if os.path.exists(path):
            return path
        print(f"make_results: {output}", file=sys.stderr, flush=True)
        target = open(path + ".part", "w") if stdout else sys.stderr
        code = subprocess.run(command, stdout=target, cwd=self.folder).returncode
        if code and not may_fail:
            sys.exit(f"make_results: {command[0]} ended with {code}; the same command goes on")
        if stdout:
            target.close()
            os.replace(path + ".part", path)
        return path

    def scores(self, output, command, **options):
        with open(self.make(output, command, **options)) as file:
            return json.load(file)


def measure_all(work):
    """Everything that the page needs."""
    data, python = work.shared + "/data", sys.executable
    pack = work.make("pack", [work.program("srisppack"), data + "/photos", data + "/linear", data + "/cameras", "-o",
                              work.path("pack")])
    plugins = work.build + "/lib/srisp"
    developed = work.make("developed.safetensors", [python, HERE + "/develop_raws.py", "--pack", pack, "--plugins", plugins,
                                                    "-o", work.path("developed.safetensors")])
    simulated = work.make("simulated", [python, HERE + "/simulate_raws.py", "--shared", work.shared, "--pack", pack,
                                        "--plugins", plugins, "-o", work.path("simulated")])
    test_pack = [work.program("srispeval"), "--pack", pack, *MODELS, "--json"]
    half_split = [work.program("srispeval"), "half-split", "--model", MODELS[0], "--model", MODELS[1]]
    with open(data + "/photos/manifest.csv") as file:
        photos = [row["file"] for row in csv.DictReader(file) if row["use"] == "validation"][:20]
    back = {model: work.scores(f"back_{model}.json",
                               [work.program("contact_sheet"), "--model", model, "--json", "--photos",
                                *[f"{data}/photos/{name}" for name in photos], "--references",
                                *[f"{data}/raw/{name}" for name in THERE_AND_BACK]], stdout=True) for model in MODELS}
    return {
        "pack": work.scores("pack.json", test_pack + ["--set", "developed=" + developed], stdout=True),
        "all": work.scores("all.json", test_pack + ALL_IMAGES, stdout=True),
        "simulated": work.scores("simulated.json", half_split + [simulated, "--report", work.path("report.html"), "--json",
                                                                  work.path("simulated.json"), *REPORT]),
        "files": work.scores("files.json", half_split + [data + "/raw", "--rendering", "all", "--report",
                                                         work.path("files.html"), "--json", work.path("files.json")],
                             may_fail=True),  # it leaves out what cannot be tested, and says so
        "back": back,
    }


def signed(value, digits=1):
    return f"{value:+.{digits}f}".replace("-", "−")


def table(head, rows):
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] * len(head)] + rows)


def group_of(scores, model, set_name, rendering):
    groups = next(one["scores"]["groups"] for one in scores if one["name"] == model)
    return next((g for g in groups if (g["set"], g["rendering"], g["camera"]) == (set_name, rendering, None)), None)


def over_gain_match(group):
    return f"{signed(group['psnr_over_gain_match_db'])} dB, {group['angle_ratio']:.2f} ×"


def pack_rows(scores, sets=SETS):
    rows = []
    for set_name, title in sets.items():
        for rendering in RENDERINGS:
            groups = [group_of(scores, model, set_name, rendering) for model in MODELS]
            base = groups[0]["gain_match"]
            rows.append([title, rendering, f"{base['psnr_db']:.1f} dB, {base['angle_degrees']:.1f}°"] +
                        [over_gain_match(g) for g in groups])
            title = ""
    return rows


def developed_rows(scores):
    groups = next(one["scores"]["groups"] for one in scores if one["name"] == MODELS[0])
    names = sorted({g["rendering"] for g in groups if g["set"] == "developed"})
    rows = []
    for name in names:
        first, second = (group_of(scores, model, "developed", name) for model in MODELS)
        base, own = first["gain_match"], first["model"]
        rows.append([name, f"{base['psnr_db']:.1f} dB, {base['angle_degrees']:.1f}°",
                     over_gain_match(first),
                     f"{signed(own['log_mean_error'], 2)} ± {own['log_mean_error_deviation']:.2f}",
                     over_gain_match(second)])
    return rows


def file_rows(scores):
    rows = []
    for group in scores["groups"]:
        if group["camera"]:
            continue
        by_name = {method["method"]: method for method in group["methods"]}
        base = by_name["gain_match"]["values"]
        row = [group["rendering"], str(group["files"]), f"{base['psnr_db'][0]:.1f} dB, {base['angle_degrees'][0]:.1f}°"]
        for name in ["upi"] + MODELS:
            mean, low, high = by_name[name]["over_baseline"]["psnr_db"]
            interval = f" ({signed(low)} to {signed(high)})" if low is not None else ""
            ratio = by_name[name]["values"]["angle_degrees"][0] / base["angle_degrees"][0]
            row.append(f"{signed(mean)}{interval}, {ratio:.2f} ×")
        rows.append(row)
    return rows


def value_range(values, digits=1, sign=""):
    low, high = f"{min(values):{sign}.{digits}f}", f"{max(values):{sign}.{digits}f}"
    return low if low == high else f"{low} to {high}"


def facts(found, credits):
    """What stands between the braces of the page."""
    pack, back = found["pack"], found["back"]
    groups = {(model, s, r): group_of(pack, model, s, r) for model in MODELS for s in SETS for r in RENDERINGS}
    real = [groups[model, "real", r] for model in MODELS for r in RENDERINGS]
    first = {r: groups[MODELS[0], "real", r] for r in RENDERINGS}
    developed = [g for one in pack for g in one["scores"]["groups"] if g["set"] == "developed" and g["camera"] is None]
    ranks = [value for photo in back[MODELS[0]]["photos"] for value in photo["rank_correlation"]]
    result = {
        "real_cameras": first["fixed"]["cameras"],
        "real_crops": first["fixed"]["crops"],
        "simulated_cameras": groups[MODELS[0], "simulated", "fixed"]["cameras"],
        "simulated_crops": groups[MODELS[0], "simulated", "fixed"]["crops"],
        "real_gain_range": value_range([g["psnr_over_gain_match_db"] for g in real]),
        "real_angle_range": value_range([g["angle_ratio"] for g in real], 2),
        "developed_gain_range": value_range([g["psnr_over_gain_match_db"] for g in developed]),
        "developed_angle_range": value_range([g["angle_ratio"] for g in developed], 2),
        "developed_crops": developed[0]["crops"],
        "all_crops": f"{group_of(found['all'], MODELS[0], 'real', 'fixed')['crops']:,}",
        "highlights_range": value_range([-g["model"]["highlight_error"] for g in real], 2),
        "highlights_gain_match_range": value_range([-g["gain_match"]["highlight_error"] for g in real], 2),
        "back_mean": f"{back['default']['round_trip_mean_db']:.1f}",
        "back_lowest": f"{back['default']['round_trip_lowest_db']:.1f}",
        "back_pairs": len(back["default"]["photos"]) * len(THERE_AND_BACK),
        "back_tint": f"{back['default']['worst_white_tint']:.3f}",
        "back_spatial_mean": f"{back['spatial']['round_trip_mean_db']:.1f}",
        "back_spatial_lowest": f"{back['spatial']['round_trip_lowest_db']:.1f}",
        "back_spatial_tint": f"{back['spatial']['worst_white_tint']:.3f}",
        "rank_mean": ", ".join(f"{statistics.mean(p['rank_correlation'][c] for p in back['default']['photos']):.2f}"
                               for c in range(3)),
        "rank_below": sum(value < 0.8 for value in ranks),
        "rank_lowest": f"{min(ranks):.2f}",
        "simulated_files": found["simulated"]["groups"][0]["files"],
        "files_cameras": len({image["camera"] for image in found["files"]["images"]}),
        "credits": credits,
    }
    for rendering in RENDERINGS:
        model, oracle = first[rendering]["model"], first[rendering]["model_with_true_means"]
        result["sd_" + rendering] = f"{model['log_mean_error_deviation'] / 0.6931472:.2f}"
        result["oracle_" + rendering] = f"{oracle['psnr_db'] - model['psnr_db']:.1f}"
    models = [f"`{name}`" for name in MODELS]
    result["pack_table"] = table(["", "rendering", "gain match"] + models, pack_rows(pack))
    result["all_table"] = table(["", "rendering", "gain match"] + models, pack_rows(found["all"], {"real": "real RAW"}))
    result["developed_table"] = table(["", "gain match", models[0], "brightness", models[1]], developed_rows(pack))
    files_head = ["photo by", "files", "gain match", "upi"] + models
    result["files_table"] = table(files_head, file_rows(found["files"]))
    result["simulated_table"] = table(files_head, file_rows(found["simulated"]))
    result["sure_table"] = table(["", "told on average", "within one", "within two"], [
        [f"{SETS[s]}, {r}", f"{m['deviation_ev']:.2f} EV", f"{100 * m['within_one_deviation']:.0f} %",
         f"{100 * m['within_two_deviations']:.0f} %"]
        for s in SETS for r in RENDERINGS for m in [groups[MODELS[0], s, r]["model"]]])
    pair = lambda m: f"{signed(m['highlight_error'], 2)}, {signed(m['highlight_error_at_gain'], 2)}"
    result["highlights_table"] = table(["", "rendering", "gain match: as it is, at one gain per image"] + models, [
        [SETS[s], r, pair(groups[MODELS[0], s, r]["gain_match"])] + [pair(groups[m, s, r]["model"]) for m in MODELS]
        for s in SETS for r in RENDERINGS])
    return result


def credits_of(folder, report):
    """Sources of the photos that the report shows."""
    with open(report) as file:
        page = file.read()
    sources = set()
    with open(folder + "/credits.txt") as file:
        for line in file:
            name, source = line.strip().split(": ", 1)
            if name[:-4] + ".dng" in page:
                sources.add(source.replace("README: all assets public domain", "public domain"))
    return "; ".join(sorted(sources))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shared", required=True, help="folder with the data")
    parser.add_argument("--build", default="build")
    work = Work(parser.parse_args())
    found = measure_all(work)
    with open(HERE + "/results_page.md") as file:
        page = file.read()
    page = page.format(**facts(found, credits_of(work.path("simulated"), work.path("report.html"))))
    os.makedirs(ROOT + "/docs/results", exist_ok=True)
    for name, text in (("results.md", page), ("results/report.html", open(work.path("report.html")).read())):
        with open(f"{ROOT}/docs/{name}", "w") as file:
            file.write(text)
    if shutil.which("chromedriver"):
        subprocess.run([sys.executable, HERE + "/report_picture.py", ROOT + "/docs/results/report.html",
                        ROOT + "/docs/images/evaluation.jpg", PICTURE], check=True)
    print(f"make_results: docs/results.md and docs/results/report.html; all RAW files: {work.path('files.html')}")


if __name__ == "__main__":
    main()
