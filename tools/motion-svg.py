"""motion-svg.py PAGE ALT - prints the motion on the page of a run as an animated SVG picture.

The page of `dalembert report` has the motion as docs/formats.md describes it.  The picture moves by
CSS alone, and does not move where its reader prefers reduced motion: then it is the whole path.
"""
import base64
import html
import json
import math
import re
import struct
import sys

FRAMES, SECONDS, WIDTH, EDGE, BODY = 300, 20, 600, 40, 26  # BODY: half its length in pixels

STYLE = """
.path { stroke: #c8c8ce; stroke-width: 2 } .trail { stroke: #2f80d0; stroke-width: 3 } .body { stroke: #1d1d20; stroke-width: 2 }
* { fill: none; stroke-linecap: round; stroke-linejoin: round; vector-effect: non-scaling-stroke;
  transform-origin: 0 0; animation: 20s linear infinite }
@media (prefers-color-scheme: dark) { .path { stroke: #4a4a52 } .body { stroke: #e6e6e8 } }
@media (prefers-reduced-motion: reduce) { * { animation: none !important } }
"""


def read_motion(page):
    """The motion of a page and its poses, lists of frames by name."""
    with open(page, encoding="utf-8") as file:
        text = re.search(r'<script type="application/json" class="data">(.*?)</script>', file.read(), re.DOTALL)
    motion = json.loads(text.group(1))["motions"][0]
    pose = {}
    for name in ("x", "y", "angle", "steer", "width"):
        low, *rest = motion[name]
        pose[name] = [low] * motion["frames"]
        if rest:
            data = base64.b64decode(rest[1])
            pose[name] = [low + (rest[0] - low) * level / 65535
                          for level in struct.unpack(f"<{len(data) // 2}H", data)]
    return motion, pose


def keyframes(name, values):
    """An animation by the texts of equally distant frames."""
    last = len(values) - 1
    steps = "".join(f"{100 * i / last:.4g}%{{{value}}}" for i, value in enumerate(values))
    return f"@keyframes {name}{{{steps}}}\n"


def line(points):
    """The path through points."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def arc_parts(points):
    """How much of the whole length lies before each point."""
    lengths = [0.0]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        lengths.append(lengths[-1] + math.hypot(x1 - x0, y1 - y0))
    return [length / (lengths[-1] or 1) for length in lengths]


def draw_part(part):
    """A line or a circle of the body, with what turns and narrows it."""
    shape = (f'<circle r="{part["radius"]}"/>' if part["radius"]
             else f'<path d="M{"L".join(f"{x} {y}" for x, y in part["line"])}"/>')
    if part["narrowed"]:
        shape = f'<g style="animation-name:width">{shape}</g>'
    if part["turn"]:
        name = "turn" if part["turn"] > 0 else "turn-"
        shape = f'<g style="animation-name:{name}">{shape}</g>'
    return f'<g transform="translate({part["pivot"][0]} {part["pivot"][1]})">{shape}</g>'


def main(page, alt):
    """Prints the picture."""
    motion, pose = read_motion(page)
    left, right, low, high = min(pose["x"]), max(pose["x"]), min(pose["y"]), max(pose["y"])
    scale = (WIDTH - 2 * EDGE) / max(right - left, high - low)
    points = [(EDGE + (x - left) * scale, EDGE + (high - y) * scale) for x, y in zip(pose["x"], pose["y"])]
    chosen = [round(i * (motion["frames"] - 1) / FRAMES) for i in range(FRAMES + 1)]
    parts = arc_parts(points)
    style = STYLE.replace("20s", f"{SECONDS}s")
    style += keyframes("body", [
        f"transform:translate({points[i][0]:.1f}px,{points[i][1]:.1f}px)"
        f"rotate({-math.degrees(pose['angle'][i]):.1f}deg)" for i in chosen])
    style += keyframes("trail", [f"stroke-dashoffset:{1 - parts[i]:.4f}" for i in chosen])
    if any(part["turn"] for part in motion["parts"]):
        for name, sign in ("turn", 1), ("turn-", -1):
            style += keyframes(name, [
                f"transform:rotate({math.degrees(sign * pose['steer'][i]):.1f}deg)" for i in chosen])
    if any(part["narrowed"] for part in motion["parts"]):
        style += keyframes("width", [f"transform:scaleY({pose['width'][i]:.3f})" for i in chosen])
    size = [round(2 * EDGE + (end - start) * scale) for start, end in ((left, right), (low, high))]
    path = line(points[::max(1, len(points) // 1500)])
    start = f"translate({points[0][0]:.1f}px,{points[0][1]:.1f}px)rotate({-math.degrees(pose['angle'][0]):.1f}deg)"
    print(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" role="img">'
          f'<title>{html.escape(alt)}</title>\n<style>{style}</style>\n<path class="path" d="{path}"/>\n'
          f'<path class="trail" pathLength="1" stroke-dasharray="1 1" style="animation-name:trail" d="{path}"/>\n'
          f'<g class="body" style="animation-name:body;transform:{start}"><g transform="scale({BODY} {-BODY})">'
          f'{"".join(draw_part(part) for part in motion["parts"])}</g></g></svg>')


main(*sys.argv[1:])
