#!/usr/bin/env python3
"""Simulates every scene, runs both presets on it, scores them, and prints one table.

score_scenes.py CREDO OUT [--recordings DIR] [--markdown FILE] [--reliability SVG] [--scenes a,b]
"""
import argparse
import json
import pathlib
import subprocess
import sys

from reliability_plot import pooled, reliability_svg

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Scenes whose prior is not called like themselves.
PRIORS = {
    "cluttered-table": "thesis-table",
    "pen-on-table": "thesis-table",
    "thesis-3.4.2": "thesis-table-and-box",
    "thesis-3.4.3": "thesis-table-and-box",
    "thesis-3.4.4": "thesis-table",
    "thesis-4.4.1": "thesis-table-and-box",
    "thesis-4.4.2": "thesis-table-and-box",
    "thesis-4.4.3": "thesis-table",
    "thesis-4.4.4": "thesis-table-and-box",
}
PRESETS = {"default": [], "thesis": ["--config", str(ROOT / "config/thesis.yaml")]}
# OSD labels the parts of a thing, so the scores of parts want these apart.
OSD_PRESETS = {
    "default preset": [],
    "default preset with `segments.join_parts=false` and `segments.raised_quanta=0`":
        ["--set", "segments.join_parts=false", "--set", "segments.raised_quanta=0"],
    "thesis preset": PRESETS["thesis"],
}
# Of the recordings, those whose frames follow each other, and single frames.
DATASETS = ["kitchen", "thermos", "appearing-boxes/cam1", "appearing-boxes/cam2", "frames/grabber",
            "frames/linemod-cat", "frames/milk", "frames/office"]
COLUMNS = [
    ("frames", lambda s: s["frames"], "{}"),
    ("WOv %", lambda s: s["segmentation"]["wov"], "{:.1%}"),
    ("F_os %", lambda s: s["segmentation"]["f_os"], "{:.1%}"),
    ("F_us %", lambda s: s["segmentation"]["f_us"], "{:.1%}"),
    ("recall@.5 %", lambda s: s["segmentation"]["recall_50"], "{:.1%}"),
    ("floor deg", lambda s: s["floor"]["tilt_deg"], "{:.2f}"),
    ("wall P %", lambda s: s["walls"]["precision"], "{:.0%}"),
    ("wall R %", lambda s: s["walls"]["recall"], "{:.0%}"),
    ("object P %", lambda s: s["objects"]["precision"], "{:.0%}"),
    ("object R %", lambda s: s["objects"]["recall"], "{:.0%}"),
    ("mm", lambda s: mm(s["objects"]["translation_m"]), "{:.1f}"),
    ("NEES (95 %)", lambda s: nees(s["objects"]), "{}"),
    ("repeated", lambda s: repeated(s["objects"]), "{}"),
    ("ECE", lambda s: s["existence"]["ece"], "{:.3f}"),
    ("Brier", lambda s: s["existence"]["brier"], "{:.3f}"),
    ("change P %", lambda s: s["change"]["precision"], "{:.0%}"),
    ("change R %", lambda s: s["change"]["recall"], "{:.0%}"),
    ("after", lambda s: s["change"]["delay_frames"], "{:.0f}"),
    ("id switches", lambda s: switches(s["stuff"]), "{}"),
]
# Means over the 65 clouds of the whole mOSD test set, measured once: context, not the same clouds.
PEERS = [
    ("thesis to the letter, 1 cm voxels (65 clouds)", 34.6, 24.6, 548, 18.5),
    ("one plane removed, then thesis clusters (65 clouds)", 76.0, 2.7, 71, 73.1),
    ("organised: dominant plane, Euclid 0.01 (65 clouds)", 73.9, 3.6, 78, 69.8),
    ("PCL supervoxels and LCCP (65 clouds)", 84.4, 14.6, 7.6, 94.0),
]


def mm(metres):
    return None if metres is None else 1000 * metres


def nees(objects):
    """With the bounds of an honest one."""
    return None if objects["nees"] is None else "{nees:.1f} ({nees_low:.1f} to {nees_high:.1f})".format(**objects)


def repeated(objects):
    """The bounds if claims about one object repeat each other, as they do."""
    return None if objects["nees"] is None else \
        "{nees_repeated_low:.1f} to {nees_repeated_high:.1f}".format(**objects)


def switches(stuff):
    return None if stuff["id_switches"] is None else f'{stuff["id_switches"]} of {stuff["item_frames"]}'


def cell(value, form):
    return "-" if value is None else form.format(value).rstrip("%")


def credo(program, *arguments):
    ended = subprocess.run([program, *map(str, arguments)], capture_output=True, text=True)
    if ended.returncode != 0:
        sys.exit(f"credo {' '.join(map(str, arguments))}: {ended.stderr.strip()}")
    return ended.stdout


def scores(program, run, truth):
    return json.loads(credo(program, "eval", run, "--truth", truth, "--plots", run / "plots", "--json"))


def score_scene(program, scene, out):
    """The scores of both presets. Whatever the scene's path is, poses are as told."""
    truth = out / "truth" / scene
    if not (truth / "truth.jsonl").exists():
        credo(program, "simulate", scene, "--out", truth)
    prior = ROOT / "scenes/priors" / (PRIORS.get(scene, scene) + ".yaml")
    known = ["--prior", prior, "--set", "detector.kind=sim"] if prior.exists() else []
    rows = []
    for preset, config in PRESETS.items():
        run = out / preset / scene
        credo(program, "run", "--source", "sim:" + scene, "--no-dds", "--out", run, "--dump", "labels",
              *config, *known)
        rows.append((scene, preset, scores(program, run, truth)))
    return rows


def reliability_picture(rows):
    """Of all claims of all scenes, a panel for each preset."""
    of_preset = {preset: [s["existence"]["reliability"] for _, p, s in rows
                          if p == preset and s["existence"]["ece"] is not None] for preset in PRESETS}
    return reliability_svg({preset + " preset": pooled(runs) for preset, runs in of_preset.items()})


def recording_table(program, folder, out):
    """What beliefs about recordings come to, which have no truth."""
    sources = [("oni", path.name, path) for path in sorted(folder.glob("oni/*.oni"))]
    sources += [("dataset", str(path.relative_to(folder)), path) for name in DATASETS
                for path in [folder / name] if path.is_dir()]
    rows = []
    for kind, name, path in sources:
        for preset, config in PRESETS.items():
            run = out / "recordings" / preset / name
            credo(program, "run", "--source", f"{kind}:{path}", "--no-dds", "--out", run, *config)
            beliefs = [json.loads(line) for line in (run / "belief.jsonl").open()]
            fusion = json.loads((run / "metrics.json").read_text())["stages"]["fusion"]
            rows.append([name, preset, str(len(beliefs)),
                         str(len({piece["id"] for b in beliefs for piece in b["stuff"]})),
                         str(len(beliefs[-1]["stuff"])), f'{fusion["p50_ms"]:.1f}'])
    return table(["recording", "preset", "frames", "ids ever", "things at the end", "fusion, ms a frame (p50)"],
                 rows)


def table(head, rows):
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def scene_table(rows):
    head = ["scene", "preset"] + [name for name, _, _ in COLUMNS]
    return table(head, [[scene, preset] + [cell(get(s), form) for _, get, form in COLUMNS]
                        for scene, preset, s in rows])


def osd_table(program, folder, out):
    rows = [[name] + [str(value) for value in values] + ["-", "-"] for name, *values in PEERS]
    clouds = 0
    for number, (preset, config) in enumerate(OSD_PRESETS.items()):
        run = out / "osd" / str(number)
        credo(program, "run", "--source", f"dataset:{folder}", "--no-dds", "--out", run, "--dump", "labels",
              *config)
        result = scores(program, run, folder)
        clouds = result["frames"]
        parts, things = result["segmentation"], result["segmentation"]["merged"]
        rows.append([f"Credo, {preset} ({clouds} clouds)"] +
                    [cell(parts[key], "{:.1%}") for key in ("wov", "f_os", "f_us", "recall_50")] +
                    [cell(things[key], "{:.1%}") for key in ("wov", "f_us")])
    return table(["method", "WOv %", "F_os %", "F_us %", "recall@.5 %", "WOv %, parts merged",
                  "F_us %, parts merged"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("credo")
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--recordings", type=pathlib.Path, help="folder that holds osd/")
    parser.add_argument("--markdown", type=pathlib.Path, help="write the tables to this page too")
    parser.add_argument("--reliability", type=pathlib.Path, help="write the reliability diagram here")
    parser.add_argument("--scenes", help="names, with commas; all of scenes/ otherwise")
    arguments = parser.parse_args()
    scenes = arguments.scenes.split(",") if arguments.scenes else sorted(
        path.stem for path in (ROOT / "scenes").glob("*.yaml"))
    rows = []
    for i, scene in enumerate(scenes):
        print(f"[{i + 1}/{len(scenes)}] {scene}", file=sys.stderr, flush=True)
        rows += score_scene(arguments.credo, scene, arguments.out)
    page = "# Scores on the simulated scenes\n\nMade by `make scores`; [eval.md](eval.md) tells what " \
           "each score is. Known objects by the simulated detector (5 mm, 0.02 rad).\n\n" + scene_table(rows)
    osd = arguments.recordings / "osd" if arguments.recordings else None
    if osd and osd.is_dir():
        page += "\n## OSD table tops\n\n`osd` is 15 of the clouds; the peers' figures are of all 65, so " \
                "compare with care.\n\n" + osd_table(arguments.credo, osd, arguments.out)
    else:
        print("no osd/ in the recordings (CREDO_DATA): its table is left out", file=sys.stderr)
    if osd and osd.is_dir():
        page += "\n## Recordings without truth\n\nKnown objects are told of in none. Times depend on what else the " \
                "machine does.\n\n" + recording_table(arguments.credo, arguments.recordings, arguments.out)
    print(page)
    if arguments.reliability:
        arguments.reliability.write_text(reliability_picture(rows))
    if arguments.markdown:
        arguments.markdown.write_text(page)


if __name__ == "__main__":
    main()
