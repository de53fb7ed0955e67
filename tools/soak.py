#!/usr/bin/env python3
"""Runs credo on a virtual sensor for a while, and judges: nothing lost, memory flat.

soak.py CREDO OPENNI2_FOLDER OUT SECONDS
"""
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
RATE_HZ = 30
MOST_LOST = 1 / 1000
MOST_GROWTH = 0.05
# Images under way when the run starts and when it is ended.
EDGE_FRAMES = 5


def run(credo, drivers, out, seconds):
    """What the program measured, and what the sensor handed out and passed over."""
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    scene = ROOT / "scenes" / "live" / "table.yaml"
    subprocess.run([credo, "simulate", scene, "--out", out / "data"], check=True)
    sensor = {"name": "soak", "dataset": "data", "rate_hz": RATE_HZ, "play": "ping_pong", "report": True}
    (out / "sensor.json").write_text(json.dumps({"sensors": [sensor]}))
    environment = dict(os.environ, LD_LIBRARY_PATH=str(drivers),
                       CREDO_VIRTUAL_SENSOR=str(out / "sensor.json"))
    with open(out / "log.txt", "w+", encoding="utf-8") as log:
        program = subprocess.Popen([credo, "run", "--source", "openni:virtual://soak", "--no-dds",
                                    "--out", out / "run"], env=environment, stderr=log)
        try:
            program.wait(seconds)
        except subprocess.TimeoutExpired:
            program.send_signal(signal.SIGINT)
            program.wait(60)
        log.seek(0)
        report = re.search(r"handed out (\d+) depth .*; (\d+) came too late", log.read())
    if program.returncode != 0 or report is None:
        sys.exit(f"soak failed: credo ended with {program.returncode}; see {out / 'log.txt'}")
    metrics = json.loads((out / "run" / "metrics.json").read_text())
    return metrics, int(report[1]), int(report[2])


def faults(metrics, delivered, seconds):
    lost = max(0, delivered - metrics["frames_in"] - EDGE_FRAMES)
    lost += sum(metrics["dropped"].values()) + metrics["failed"]
    growth = metrics["rss_mb_end"] / metrics["rss_mb_at_100"] - 1
    if metrics["wall_s"] < 0.9 * seconds:
        yield f"ended after {metrics['wall_s']:.0f} of {seconds:.0f} s"
    if lost > delivered * MOST_LOST:
        yield f"lost {lost} of {delivered} frames, more than 1 in 1000"
    if growth > MOST_GROWTH:
        yield f"memory grew by {growth:.1%} after frame 100, more than {MOST_GROWTH:.0%}"


def main():
    credo, drivers, out = (pathlib.Path(argument).resolve() for argument in sys.argv[1:4])
    seconds = float(sys.argv[4])
    metrics, delivered, late = run(credo, drivers, out, seconds)
    latency = metrics["latency_ms"]
    print(f"{delivered} delivered ({late} too late to be), {metrics['frames_in']} in, "
          f"{metrics['frames_out']} out, {sum(metrics['dropped'].values())} dropped, "
          f"{metrics['failed']} failed\n"
          f"RSS {metrics['rss_mb_at_100']:.0f} MB at frame 100, {metrics['rss_mb_end']:.0f} at the end, "
          f"{metrics['peak_rss_mb']:.0f} at most; latency p50 {latency['p50']:.0f}, p99 {latency['p99']:.0f} ms")
    found = list(faults(metrics, delivered, seconds))
    print("soak " + ("failed: " + "; ".join(found) if found else "passed"))
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
