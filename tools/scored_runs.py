"""What the tools that fit probabilities to simulated runs share. Nothing but Python's own library."""
import json
import math
import pathlib
import subprocess
import sys


def evaluations(program, runs, truth):
    """(scene, what `credo eval` says of it) of every run with labels in a folder of folders named like scenes,
    whose truth, as `credo simulate` writes it, is in a folder of the same kind. Ends the program where there is none."""
    found = []
    for run in sorted(pathlib.Path(runs).iterdir()):
        of_scene = pathlib.Path(truth) / run.name
        if not (run / "labels").is_dir() or not (of_scene / "truth.jsonl").is_file():
            continue
        ended = subprocess.run([program, "eval", run, "--truth", of_scene, "--json"],
                               capture_output=True, text=True)
        if ended.returncode != 0:
            sys.exit(f"credo eval {run}: {ended.stderr.strip()}")
        found.append((run.name, json.loads(ended.stdout)))
    if not found:
        sys.exit(f"{pathlib.Path(sys.argv[0]).name}: {runs} has no run with labels whose scene is in {truth}")
    return found


def brier_and_loss(pairs):
    """Brier score and log loss of (probability, whether it came true)."""
    n = max(1, len(pairs))
    brier = sum((p - true) ** 2 for p, true in pairs) / n
    loss = -sum(math.log(p if true else 1.0 - p) for p, true in pairs) / n
    return brier, loss
