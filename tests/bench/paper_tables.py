#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Does the paper's claim hold here? Trains every row of its tables with the same data and budget, several seeds each,
tests all on the same images, and prints the table and the paper's relations, each marked reproduced or not.

    python3 tests/bench/paper_tables.py --pack pack --out tables [--steps 1500] [--seeds 2] [--jobs 1]

A run that is stopped (Ctrl-C) goes on where it was with the same command. --print-only: the table of what is there."""
import argparse
import concurrent.futures
import json
import os
import statistics
import subprocess
import sys

PAPER = ["paper", "data.image_size=64"]
# Methods without an anchor find brightness themselves.
NO_ANCHOR = ["loss.brightness_matched=false", "loss.highlights=0"]
# name of the row, recipe, settings; all rows get the common ones below. The paper's tone map is 3x3: its ablations
# build on `spatial`, and `default` is one of them.
ROWS = [
    ("spatial", ["spatial"]),
    ("paper", PAPER),
    ("paper, our rates", PAPER + ["optimizer.rate=1e-3", "optimizer.dictionary_rate=6e-3",
                                  "optimizer.schedule=one_cycle"]),
    ("no DPS", ["no_dps"]),
    ("gain merged", ["merged_gain"]),
    ("static tone map", ["static_tone"]),
    ("1x1 tone map", ["default"]),
    ("no PP_MT", ["no_mt"]),
    ("PP_MT-", ["mt_real_reference"]),
    ("U-Net", ["unet"]),
    ("MBISPLD", ["mbispld"]),
    ("MBISPLD + augmentation", ["mbispld_augmented"]),
    ("pseudo pairs of real RAW", ["pseudo_pairs"]),
    ("real pairs of real RAW", ["real_pairs"]),
    ("U-Net, real pairs", ["real_pairs", "model.method=unet"] + NO_ANCHOR),
    ("MBISPLD, real pairs", ["real_pairs", "model.method=mbispld"] + NO_ANCHOR),
]
UNTRAINED = ["gain match", "upi"]
GROUPS = [("real", "fixed"), ("real", "random"), ("simulated", "fixed"), ("simulated", "random")]
# The paper's relations [its tables 1-5]: better row, worse row, measure, test images, the paper's own numbers.
KNOWN, UNKNOWN = ("real", "fixed"), ("real", "random")
RELATIONS = [
    ("1", "spatial", "upi", "angle", KNOWN, "3.72 / 7.35 deg"),
    ("1", "spatial", "upi", "psnr", KNOWN, "37.97 / 32.97 dB"),
    ("1", "real pairs of real RAW", "pseudo pairs of real RAW", "psnr", KNOWN, "45.92 / 37.89 dB"),
    ("1", "real pairs of real RAW", "pseudo pairs of real RAW", "angle", KNOWN, "2.84 / 4.00 deg"),
    ("1", "real pairs of real RAW", "MBISPLD, real pairs", "psnr", KNOWN, "45.92 / 41.38 dB"),
    ("1", "real pairs of real RAW", "U-Net, real pairs", "psnr", KNOWN, "45.92 / 41.53 dB"),
    ("1", "spatial", "no PP_MT", "angle", KNOWN, "3.72 / 4.00 deg"),
    ("2", "pseudo pairs of real RAW", "real pairs of real RAW", "psnr", UNKNOWN, "33.35 / 28.65 dB"),
    ("2", "pseudo pairs of real RAW", "MBISPLD, real pairs", "psnr", UNKNOWN, "33.35 / 20.26 dB"),
    ("2", "pseudo pairs of real RAW", "U-Net, real pairs", "psnr", UNKNOWN, "33.35 / 20.35 dB"),
    ("3", "spatial", "MBISPLD, real pairs", "psnr", KNOWN, "42.81 / 33.60 dB (Nikon to SIDD)"),
    ("3", "spatial", "U-Net, real pairs", "psnr", KNOWN, "42.81 / 33.84 dB (Nikon to SIDD)"),
    ("4", "spatial", "upi", "intersection", None, "0.940 / 0.761"),
    ("4", "spatial", "no PP_MT", "intersection", None, "0.940 / 0.900"),
    ("4", "spatial", "MBISPLD, real pairs", "intersection", None, "0.895 / 0.768"),
    ("5", "spatial", "no DPS", "psnr", KNOWN, "35.74 / 27.47 dB"),
    ("5", "spatial", "gain merged", "psnr", KNOWN, "36.87 / 35.74 dB"),
    ("5", "spatial", "static tone map", "psnr", KNOWN, "37.89 / 36.87 dB"),
    ("5", "spatial", "PP_MT-", "psnr", KNOWN, "37.97 / 35.64 dB"),
    ("5", "no PP_MT", "PP_MT-", "psnr", KNOWN, "37.89 / 35.64 dB"),
]


def folder_of(options, row, seed):
    name = "".join(c if c.isalnum() else "_" for c in row)
    return os.path.join(options.out, f"{name}-{seed}")


def train(options, row, recipe, seed):
    common = [f"seed={seed}", f"steps={options.steps}", f"validate_every={options.steps}", "pairs=4",
              "validation.set.real_images=1", "validation.set.simulated_images=1", "anchor_fit.pairs=8000",
              "anchor_fit.steps=3000"]
    settings = common + (["unpaired=2"] if recipe[0] in ("default", "spatial", "paper", "no_dps", "merged_gain",
                                                         "static_tone", "mt_real_reference") else ["unpaired=0"])
    command = [options.bin + "/srisptrain", recipe[0], "--pack", options.pack, "-o", folder_of(options, row, seed),
               "--threads", "1", "-q"]
    for setting in settings + recipe[1:]:
        command += ["--set", setting]
    subprocess.run(command, check=True)


def evaluate(options, row, seed):
    """Scores of a model, or of a method that needs none; kept beside the model."""
    folder = folder_of(options, row, seed)
    path = os.path.join(folder, "scores.json")
    if os.path.exists(path):
        with open(path) as file:
            return json.load(file)
    model = ["--baseline", row.replace(" ", "_")] if row in UNTRAINED else [folder + "/best.safetensors"]
    output = subprocess.run([options.bin + "/srispeval", "--pack", options.pack, *model, "--json", "-q", "--threads",
                             "1", "--set", "unpaired_photos=20"],
                            check=True, stdout=subprocess.PIPE).stdout
    scores = json.loads(output)[0]["scores"]
    os.makedirs(folder, exist_ok=True)
    with open(path + ".part", "w") as file:
        json.dump(scores, file)
    os.replace(path + ".part", path)
    return scores


def measures(scores):
    """(measure, test images) -> number"""
    result = {}
    for group in scores["groups"]:
        if not group.get("camera"):
            key = (group["set"], group["rendering"])
            result["psnr", key] = group["model"]["psnr_db"]
            result["angle", key] = group["model"]["angle_degrees"]
    result["intersection", None] = scores["unpaired"]["model"]["histogram_intersection"]
    return result


def spread(values):
    return (max(values) - min(values)) / 2


def cell(runs, key, digits):
    values = [run[key] for run in runs]
    return f"{statistics.mean(values):.{digits}f} ± {spread(values):.{digits}f}" if len(values) > 1 else \
        f"{values[0]:.{digits}f}"


def print_table(found):
    print("| | " + " | ".join(f"{name}, {rendering}: dB | °" for name, rendering in GROUPS) +
          " | histogram intersection | runs |")
    print("|---" * (2 * len(GROUPS) + 3) + "|")
    for row, runs in found.items():
        cells = []
        for key in GROUPS:
            cells += [cell(runs, ("psnr", key), 2), cell(runs, ("angle", key), 2)]
        cells.append(cell(runs, ("intersection", None), 3))
        print(f"| {row} | " + " | ".join(cells) + f" | {len(runs)} |")


def print_relations(found):
    print("\n| table | relation | paper | here | reproduced |\n|---|---|---|---|---|")
    for table, better, worse, measure, images, paper in RELATIONS:
        where = f", {images[0]} RAW, {images[1]} rendering" if images else ""
        text = f"| {table} | {better} before {worse}: {measure}{where} | {paper} | "
        if better not in found or worse not in found:
            print(text + "not measured | |")
            continue
        first, second = ([run[measure, images] for run in found[row]] for row in (better, worse))
        gain = statistics.mean(first) - statistics.mean(second)
        noise = spread(first) + spread(second)
        if measure == "angle":
            gain = -gain
        verdict = "yes" if gain > noise else "no" if gain < -noise else "within the spread"
        if any(len(found[row]) < 2 for row in (better, worse) if row not in UNTRAINED):
            verdict = "one run only"
        print(text + f"{statistics.mean(first):.3f} / {statistics.mean(second):.3f} | {verdict} |")


def scores_of(options, row, recipe, seed):
    """Trains and tests one row where that has not been done; None where it is only to be printed and is not there."""
    scores = os.path.exists(os.path.join(folder_of(options, row, seed), "scores.json"))
    if not scores and options.print_only:
        return None
    if not scores and recipe:
        print(f"{row}, seed {seed}", file=sys.stderr, flush=True)
        train(options, row, recipe, seed)
    return measures(evaluate(options, row, seed))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--pack", required=True, help="made by srisppack of photos, RAW images and cameras")
    parser.add_argument("--out", required=True, help="folder for the models and their scores")
    parser.add_argument("--bin", default="build/bin", help="folder of srisptrain and srispeval")
    parser.add_argument("--steps", type=int, default=1500)
    parser.add_argument("--seeds", type=int, default=2)
    parser.add_argument("--jobs", type=int, default=1, help="rows at a time, of one thread each")
    parser.add_argument("--print-only", action="store_true", help="train nothing")
    options = parser.parse_args()
    runs = [(name, None, 1) for name in UNTRAINED]
    runs += [(name, recipe, seed) for seed in range(1, options.seeds + 1) for name, recipe in ROWS]
    found = {}
    pool = concurrent.futures.ThreadPoolExecutor(options.jobs)
    try:
        waiting = [pool.submit(scores_of, options, *run) for run in runs]
        for (row, _, _), scores in zip(runs, waiting):
            if scores.result():
                found.setdefault(row, []).append(scores.result())
    except subprocess.CalledProcessError as error:
        sys.exit(f"paper_tables: {error.cmd[0]} ended with {error.returncode}; the same command goes on from there")
    except KeyboardInterrupt:
        sys.exit("paper_tables: stopped; the same command goes on from there")
    finally:
        pool.shutdown(cancel_futures=True)
    print_table(found)
    print_relations(found)


main()
