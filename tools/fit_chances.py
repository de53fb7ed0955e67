#!/usr/bin/env python3
"""Fits how likely a detector finds a known object that is there (fusion.objects), on simulated scenes.

Prints the limits for the config, and how good they are on runs that they were not fitted on, beside one
probability for all and beside other limits. Nothing but Python's own library.

fit_chances.py CREDO RUNS TRUTH [--test RUNS TRUTH]... [--beside SHARE SHARE PX PX]

RUNS and TRUTH are folders of folders named like scenes: runs of one detector with --dump labels, and what
`credo simulate` wrote with the same seed.

Example:
  S="--set sim.seed=2"
  credo simulate corridor-loop $S --out out/truth2/corridor-loop
  credo run --source sim:corridor-loop $S --prior scenes/priors/corridor-loop.yaml --set detector.kind=bpa \\
      --dump labels --no-dds --out out/bpa2/corridor-loop
  tools/fit_chances.py build/bin/credo out/bpa2 out/truth2
"""
import argparse
import itertools
import math
import sys

from scored_runs import brier_and_loss, evaluations

# What is there as surely as a detector ever finds it (fusion.existence.seen_if_present).
MOST = 0.95
SHARES = [0.0, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7]
NEVER_PX = [50, 100, 150, 200, 250, 300, 400]
SURELY_PX = [500, 1000, 1500, 2000, 2500, 3000, 4000, 6000]


def chances(program, runs, truth):
    """(visible share, log of the pixels, whether it is found) of every chance."""
    return [(chance["visible_share"], math.log(chance["shown_px"]), chance["is_found"])
            for _, scores in evaluations(program, runs, truth) for chance in scores["chances"]]


def rise(value, low, high):
    return min(1.0, max(0.0, (value - low) / (high - low)))


def probability(limits, share, log_px):
    """As the belief has it, but never certain: a fit must survive what it does not expect."""
    never_share, surely_share, never_px, surely_px = limits
    found = MOST * rise(share, never_share, surely_share) * \
        rise(log_px, math.log(never_px), math.log(surely_px))
    return min(0.99, max(0.01, found))


def scores(pairs):
    brier, loss = brier_and_loss(pairs)
    return f"Brier {brier:.3f}, log loss {loss:.3f} of {len(pairs)}"


def by(limits, rows):
    return [(probability(limits, share, log_px), found) for share, log_px, found in rows]


def fitted(rows):
    limits = [(a, b, c, d) for a, b in itertools.combinations(SHARES, 2)
              for c in NEVER_PX for d in SURELY_PX]
    return min(limits, key=lambda some: brier_and_loss(by(some, rows))[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("credo")
    parser.add_argument("runs")
    parser.add_argument("truth")
    parser.add_argument("--test", nargs=2, metavar=("RUNS", "TRUTH"), action="append", default=[],
                        help="other runs, as with other seeds or another sensor's noise, to be tested on")
    parser.add_argument("--beside", nargs=4, type=float, default=[0.1, 0.2, 200.0, 2500.0],
                        metavar=("SHARE", "SHARE", "PX", "PX"),
                        help="limits to compare with (default: those of the default preset)")
    arguments = parser.parse_args()
    rows = chances(arguments.credo, arguments.runs, arguments.truth)
    if not rows:
        sys.exit(f"fit_chances.py: no frame of {arguments.runs} shows a known object")
    fit = fitted(rows)
    for name, limit in zip(("never_found_share", "surely_found_share", "never_found_px", "surely_found_px"), fit):
        print(f"fusion.objects.{name}={limit:g}")
    mean = sum(found for _, _, found in rows) / len(rows)
    for name, some in [("fitted on", rows)] + \
            [("tested on", chances(arguments.credo, *test)) for test in arguments.test]:
        print(f"{name}, one probability for all: {scores([(mean, found) for _, _, found in some])}")
        print(f"{name}, fitted:                  {scores(by(fit, some))}")
        print(f"{name}, beside:                  {scores(by(arguments.beside, some))}")
    edges = [1, 100, 200, 400, 800, 1600, 3200, 6400, math.inf]
    print("pixels: chances, found, fitted")
    for low, high in zip(edges, edges[1:]):
        of = [row for row in rows if low <= math.exp(row[1]) + 1e-6 < high]
        if of:
            said = sum(probability(fit, share, log_px) for share, log_px, _ in of) / len(of)
            print(f"{low:>5} to {high:>5}: {len(of):4d}  {sum(row[2] for row in of) / len(of):.2f}  {said:.2f}")


if __name__ == "__main__":
    main()
