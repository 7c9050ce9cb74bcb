"""page_data.py - reads the data of a page of `dalembert report` as docs/formats.md describes them.

    page_data.py motions PAGE          prints METHOD T X Y ANGLE STEER WIDTH for each frame
    page_data.py envelopes PAGE DIR    compares each envelope with DIR/series/LABEL.csv
    page_data.py curves PAGE NAME      prints NAME TITLE KIND X Y UPPER for each point of a figure, between tabs
"""
import base64
import csv
import json
import math
import re
import struct
import sys


def levels(text):
    """The 16-bit integers of a text."""
    data = base64.b64decode(text, validate=True)
    return struct.unpack(f"<{len(data) // 2}H", data)


def numbers(member, frames):
    """A number of all frames."""
    if len(member) == 1:
        return member * frames
    low, high, text = member
    return [low + (high - low) * level / 65535 for level in levels(text)]


def print_motions(parts):
    """Prints the frames of all motions."""
    for motion in (motion for part in parts for motion in part["motions"]):
        frames = motion["frames"]
        poses = [numbers(motion[name], frames) for name in ("x", "y", "angle", "steer", "width")]
        for i, pose in enumerate(zip(*poses, strict=True)):
            time = motion["start"] + (motion["end"] - motion["start"]) * i / (frames - 1)
            print(motion["integrator"], time, *pose)


def print_curves(figure):
    """Prints the points of all curves; UPPER is empty except of a band."""
    curves = figure["curves"]
    for curve in curves:
        x = curve["x"] if isinstance(curve["x"], list) else curves[curve["x"]]["x"]
        upper = curve.get("upper", [""] * len(x))
        for point in zip(x, curve["y"], upper, strict=True):
            print(figure["name"], curve["title"], curve["kind"], *point, sep="\t")


def value(level):
    """The value of an envelope."""
    return 0.0 if level == 0 else math.inf if level == 65535 else 2.0 ** ((level - 32768) / 256)


def compare_envelope(found, times, rows, column):
    """Whether values are the maxima of the rows up to each time, within half a level."""
    for level, time in zip(found, times):
        wanted = max(float(r[column] or 0) for r in rows if float(r["until"]) <= time * (1 + 1e-5))
        if wanted in (0, math.inf) or level == 0:
            same = value(level) == wanted
        else:
            same = abs(math.log2(value(level) / wanted)) < 0.51 / 256
        if not same:
            return f"{column} until {time}: {value(level)}, not {wanted}"
    return ""


def compare_envelopes(parts, directory):
    """Compares all envelopes; prints the differences and the number compared."""
    columns = {"D": "D", "E": "E", "I": "invariants", "H": "H", "error": "error"}
    count = 0
    for part in parts:
        with open(f"{directory}/series/{part['label']}.csv", encoding="utf-8") as file:
            series = list(csv.DictReader(file))
        for cell in part["cells"]:
            if cell["step"] not in range(len(part["steps"])):
                print(f"{part['label']}, {cell['integrator']}: step {cell['step']}")
                continue
            step = part["steps"][cell["step"]]
            starts = ("displaced",) if "H" in cell else ("physical", "surface")
            for name in columns.keys() & cell.keys():
                rows = [r for r in series if r["integrator"] == cell["integrator"] and
                        math.isclose(float(r["step"]), step["h"]) and r["start"] in starts]
                first = rows[0]["start"]
                rows = [r for r in rows if r["start"] == first]
                fault = compare_envelope(levels(cell[name]), step["t"], rows, columns[name])
                count += 1
                if fault:
                    print(f"{part['label']}, {cell['integrator']}: {fault}")
    print(f"{count} envelopes")


with open(sys.argv[2], encoding="utf-8") as page:
    content = page.read()


def parts_of(kind):
    """The JSON of a kind of element."""
    return [json.loads(text) for text in re.findall(
        rf'<script type="application/json" class="{kind}">(.*?)</script>', content, re.DOTALL)]


if sys.argv[1] == "motions":
    print_motions(parts_of("data"))
elif sys.argv[1] == "curves":
    print_curves(next(figure for figure in parts_of("figure") if figure["name"] == sys.argv[3]))
else:
    compare_envelopes(parts_of("data"), sys.argv[3])
