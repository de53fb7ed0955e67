#!/usr/bin/env python3
"""Runs a scene's camera round and round, and tells how much memory that takes and how it grows.

laps.py CREDO OUT [--scene corridor-loop] [--laps 135]

The things that move do so in every lap; nothing is taken away. 135 laps of the corridor are an hour.
"""
import argparse
import json
import pathlib
import re
import subprocess
import sys
import time

import yaml

ROOT = pathlib.Path(__file__).resolve().parent.parent
MB_PER_KB = 1 / 1024


def lapped(scene, laps):
    """The scene with every way walked `laps` times."""
    lap_s = scene["camera"]["path"][-1]["time_s"] - scene["camera"]["path"][0]["time_s"]

    def repeated(path):
        return [dict(point, time_s=round(point["time_s"] + lap * lap_s, 6))
                for lap in range(laps) for point in path if lap == 0 or point["time_s"] > 0]

    for thing in scene["things"]:
        if "path" in thing:
            thing["path"] = repeated(thing["path"])
    scene["camera"]["path"] = repeated(scene["camera"]["path"])
    scene.pop("events", None)
    return scene, int(round(laps * lap_s * scene["camera"]["frames_per_s"])) + 1


def memory_mb(pid):
    status = pathlib.Path(f"/proc/{pid}/status").read_text()
    found = re.search(r"VmRSS:\s+(\d+) kB", status)
    return int(found.group(1)) * MB_PER_KB if found else None


def last_belief(log):
    """(frame, pieces of stuff) of the last whole line; nothing yet: (0, 0)."""
    if not log.exists():
        return 0, 0
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - 1_000_000))
        lines = file.read().split(b"\n")[1:-1]
    if not lines:
        return 0, 0
    belief = json.loads(lines[-1])
    return belief["frame"], len(belief["stuff"])


def watch(process, log):
    """(frame, pieces of stuff, MB), every few seconds."""
    samples = []
    while process.poll() is None:
        time.sleep(2)
        try:
            memory = memory_mb(process.pid)
        except FileNotFoundError:
            break
        if memory:
            samples.append((*last_belief(log), memory))
    return samples


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("credo")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--scene", default="corridor-loop")
    parser.add_argument("--laps", type=int, default=135)
    arguments = parser.parse_args()
    arguments.out.mkdir(parents=True, exist_ok=True)
    scene = yaml.safe_load((ROOT / "scenes" / (arguments.scene + ".yaml")).read_text())
    scene, frames = lapped(scene, arguments.laps)
    path = arguments.out / "laps.yaml"
    path.write_text(yaml.safe_dump(scene, default_flow_style=None, width=1000))
    prior = ROOT / "scenes/priors" / (arguments.scene + ".yaml")
    known = ["--prior", prior, "--set", "detector.kind=sim"] if prior.exists() else []
    log = arguments.out / "log.txt"
    with log.open("w") as said:  # no pipe: nobody reads while it runs, and a full one stops it
        process = subprocess.Popen([arguments.credo, "run", "--source", f"sim:{path}", "--no-dds", "--out",
                                    arguments.out / "run", *known],
                                   stdout=subprocess.DEVNULL, stderr=said)
        samples = watch(process, arguments.out / "run/belief.jsonl")
    if process.wait() != 0:
        sys.exit(log.read_text()[-2000:])
    print(f"{arguments.laps} laps, {frames} frames\n\n| of the frames | things | MB |\n|---|---|---|")
    for tenth in range(10):
        part = [(things, memory) for frame, things, memory in samples
                if frames * tenth <= 10 * frame <= frames * (tenth + 1)]
        if part:
            things, memory = zip(*part)
            print(f"| {tenth * 10} to {tenth * 10 + 10} % | {min(things)} to {max(things)} | "
                  f"{min(memory):.0f} to {max(memory):.0f} |")


if __name__ == "__main__":
    main()
