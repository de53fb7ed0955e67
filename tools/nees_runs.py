#!/usr/bin/env python3
"""Whether the belief is as sure of known objects' poses as it may be: many runs of each scene.

One run's claims about an object repeat each other from frame to frame. So every scene is run with
one seed after the other for the sensor's noise and the detector's errors, and each frame has the
mean of the squared errors, over runs and objects, for itself: their sum follows a chi-square
distribution if claims are honest, and 95 of 100 frames lie within its bounds (Bar-Shalom, Li and
Kirubarajan 2001, 5.4.2). Objects count from the frame in which the run first sees them: before,
there is the prior, whose error no seed draws anew. Nothing but Python's own library.

nees_runs.py CREDO OUT [--runs N] [--scenes a,b] [--set KEY=VALUE]...
"""
import argparse
import collections
import json
import pathlib
import statistics
import sys

from score_scenes import PRIORS, ROOT, credo, table

SCENES = ["bottle-moves", "box-on-table", "cluttered-table", "corridor-loop", "swap-and-occlude", "thesis-4.4.2"]
HEAD = ["scene", "runs", "frames", "NEES, expected", "mean, bounds of most frames", "frames inside %",
        "below %", "above %"]


def quantile(share, degrees_of_freedom):
    """Of the chi-square distribution, by Wilson and Hilferty 1931: to 0.2 % from 30 degrees on."""
    spread = 2.0 / (9.0 * degrees_of_freedom)
    return degrees_of_freedom * (1.0 - spread + statistics.NormalDist().inv_cdf(share) * spread ** 0.5) ** 3


def seen_from(run):
    """The frame in which each object was first seen."""
    first = {}
    for line in (run / "belief.jsonl").open():
        belief = json.loads(line)
        for thing in belief["objects"]:
            if thing["evidence"] == "seen":
                first.setdefault(thing["id"], belief["frame"])
    return first


def claims_of(program, run, truth):
    first = seen_from(run)
    scores = json.loads(credo(program, "eval", run, "--truth", truth, "--json"))
    return [claim for claim in scores["objects"]["claims"]
            if claim["frame"] >= first.get(claim["id"], float("inf"))]


def run_scene(program, scene, seed, out, settings):
    truth = out / "truth" / scene
    if not (truth / "truth.jsonl").exists():
        credo(program, "simulate", scene, "--out", truth)
    run = out / scene / str(seed)
    prior = ROOT / "scenes/priors" / (PRIORS.get(scene, scene) + ".yaml")
    known = [f"sim.seed={seed}", "detector.kind=sim", f"detector.sim.seed={seed}"] + settings
    credo(program, "run", "--source", "sim:" + scene, "--no-dds", "--out", run, "--prior", prior,
          *[word for setting in known for word in ("--set", setting)])
    return claims_of(program, run, truth)


def by_frame(claims):
    """(mean squared error, low, high) of each frame."""
    frames = collections.defaultdict(list)
    for claim in claims:
        frames[claim["frame"]].append(claim)
    rows = []
    for _, those in sorted(frames.items()):
        freedom = sum(claim["degrees_of_freedom"] for claim in those)
        rows.append((statistics.fmean(claim["squared_error"] for claim in those),
                     quantile(0.025, freedom) / len(those), quantile(0.975, freedom) / len(those)))
    return rows


def row_of(scene, runs, claims):
    frames = by_frame(claims)
    mean = statistics.fmean(claim["squared_error"] for claim in claims)
    expected = statistics.fmean(claim["degrees_of_freedom"] for claim in claims)
    share = lambda test: f"{100 * sum(map(test, frames)) / len(frames):.0f}"
    low, high = (statistics.median(row[i] for row in frames) for i in (1, 2))
    return [scene, str(runs), str(len(frames)), f"{expected:.1f}", f"{mean:.2f} ({low:.1f} to {high:.1f})",
            share(lambda row: row[1] <= row[0] <= row[2]), share(lambda row: row[0] < row[1]),
            share(lambda row: row[0] > row[2])]


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("credo")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--runs", type=int, default=20)
    parser.add_argument("--scenes", default=",".join(SCENES), help="names, with commas")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE", help="of the config, for all runs")
    arguments = parser.parse_args()
    rows = []
    for scene in arguments.scenes.split(","):
        claims = []
        for seed in range(1, arguments.runs + 1):
            print(f"{scene}: {seed} of {arguments.runs}", file=sys.stderr, flush=True)
            claims += run_scene(arguments.credo, scene, seed, arguments.out, arguments.set)
        rows.append(row_of(scene, arguments.runs, claims))
    print(table(HEAD, rows))


if __name__ == "__main__":
    main()
