#!/usr/bin/env python3
"""Fits how likely a new piece of stuff is a thing (fusion.births), on simulated scenes.

Prints the two numbers for the config, and how good they are on scenes that they were not fitted on,
beside one probability for all. Nothing but Python's own library.

fit_births.py CREDO RUNS TRUTH [--test RUNS TRUTH]

RUNS and TRUTH are folders of folders named like scenes: runs with --dump labels, and what `credo
simulate` wrote.

Example:
  fit_births.py build/bin/credo out/scores/default out/scores/truth
"""
import argparse
import math
import sys

from scored_runs import brier_and_loss, evaluations


def births(program, runs, truth):
    """(scene, log thickness, whether it is there) of every birth."""
    return [(scene, math.log(birth["thickness_blocks"]), birth["is_there"])
            for scene, scores in evaluations(program, runs, truth) for birth in scores["births"]]


def probability(fit, log_thickness):
    return 1.0 / (1.0 + math.exp(-(fit[0] + fit[1] * log_thickness)))


def fitted(rows, with_thickness=True):
    """Logistic regression by Newton's method, with a weak prior that keeps it finite."""
    prior = 0.05
    a, b = 0.0, 0.0
    for _ in range(50):
        g = [-prior * a, -prior * b]
        h = [[prior, 0.0], [0.0, prior]]
        for _, x, there in rows:
            p = probability((a, b), x)
            g[0] += there - p
            g[1] += (there - p) * x
            for i, u in enumerate((1.0, x)):
                for j, v in enumerate((1.0, x)):
                    h[i][j] += p * (1.0 - p) * u * v
        if not with_thickness:
            a += g[0] / h[0][0]
            continue
        det = h[0][0] * h[1][1] - h[0][1] * h[1][0]
        a += (h[1][1] * g[0] - h[0][1] * g[1]) / det
        b += (h[0][0] * g[1] - h[1][0] * g[0]) / det
    return a, b


def scores(pairs):
    brier, loss = brier_and_loss(pairs)
    return f"Brier {brier:.4f}, log loss {loss:.4f} of {len(pairs)}"


def left_out(rows, with_thickness):
    """Each scene by the fit to all others."""
    pairs = []
    for scene in sorted({row[0] for row in rows}):
        fit = fitted([row for row in rows if row[0] != scene], with_thickness)
        pairs += [(probability(fit, x), there) for name, x, there in rows if name == scene]
    return pairs


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("credo")
    parser.add_argument("runs")
    parser.add_argument("truth")
    parser.add_argument("--test", nargs=2, metavar=("RUNS", "TRUTH"),
                        help="other runs, as of another sensor's noise, to be tested on")
    arguments = parser.parse_args()
    rows = births(arguments.credo, arguments.runs, arguments.truth)
    if not rows:
        sys.exit(f"fit_births.py: nothing new comes up in {arguments.runs}")
    fit = fitted(rows)
    print(f"fusion.births.log_odds={fit[0]:.2f}\nfusion.births.per_log_thickness={fit[1]:.2f}")
    print("scenes left out, one probability for all:", scores(left_out(rows, False)))
    print("scenes left out, by thickness:           ", scores(left_out(rows, True)))
    if arguments.test:
        others = births(arguments.credo, *arguments.test)
        print("other runs, one probability for all:     ",
              scores([(probability(fitted(rows, False), x), there) for _, x, there in others]))
        print("other runs, by thickness:                ",
              scores([(probability(fit, x), there) for _, x, there in others]))
    edges = [0, 2, 3, 4, 6, 10, 20, math.inf]
    print("thickness, blocks: births, there, fitted")
    for low, high in zip(edges, edges[1:]):
        of = [(x, there) for _, x, there in rows if low <= math.exp(x) < high]
        if of:
            mean = sum(probability(fit, x) for x, _ in of) / len(of)
            there = sum(there for _, there in of) / len(of)
            print(f"{low:>5} to {high:>4}: {len(of):4d}  {there:.2f}  {mean:.2f}")


if __name__ == "__main__":
    main()
