"""Motions as SVG pictures that move by CSS alone, and stand still where their reader prefers that.

Also the drawing of tools/motion-svg.py, which takes motions from the pages of the program.
"""
from __future__ import annotations

import html
import math
from typing import Any, Mapping, Sequence

SECONDS, WIDTH, EDGE, BODY = 20, 600, 40, 26  # BODY: half its length in pixels
MAX_POINTS = 1500  # of the path

STYLE = """
.path { stroke: #c8c8ce; stroke-width: 2 } .trail { stroke: #2f80d0; stroke-width: 3 } .body { stroke: #1d1d20; stroke-width: 2 }
* { fill: none; stroke-linecap: round; stroke-linejoin: round; vector-effect: non-scaling-stroke;
  transform-origin: 0 0; animation: 20s linear infinite }
@media (prefers-color-scheme: dark) { .path { stroke: #4a4a52 } .body { stroke: #e6e6e8 } }
@media (prefers-reduced-motion: reduce) { * { animation: none !important } }
"""

Pose = Mapping[str, Sequence[float]]


def keyframes(name: str, values: Sequence[str]) -> str:
    """An animation by the texts of equally distant frames."""
    last = len(values) - 1
    steps = "".join(f"{100 * i / last:.4g}%{{{value}}}" for i, value in enumerate(values))
    return f"@keyframes {name}{{{steps}}}\n"


def line(points: Sequence[Any]) -> str:
    """The path through points."""
    return "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)


def arc_parts(points: Sequence[Any]) -> list[float]:
    """How much of the whole length lies before each point."""
    lengths = [0.0]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        lengths.append(lengths[-1] + math.hypot(x1 - x0, y1 - y0))
    return [length / (lengths[-1] or 1) for length in lengths]


def draw_part(part: Mapping[str, Any]) -> str:
    """A line or a circle of the body, with what turns and narrows it."""
    shape = (f'<circle r="{part["radius"]}"/>' if part["radius"]
             else f'<path d="M{"L".join(f"{x} {y}" for x, y in part["line"])}"/>')
    if part["narrowed"]:
        shape = f'<g style="animation-name:width">{shape}</g>'
    if part["turn"]:
        name = "turn" if part["turn"] > 0 else "turn-"
        shape = f'<g style="animation-name:{name}">{shape}</g>'
    return f'<g transform="translate({part["pivot"][0]} {part["pivot"][1]})">{shape}</g>'


def draw(pose: Pose, parts: Sequence[Mapping[str, Any]], title: str, frames: int) -> str:
    """The picture of a motion.

    Parameters
    ----------
    pose : mapping of str to sequence
        ``x``, ``y``, ``angle``, ``steer`` and ``width`` at equally distant times.
    parts : sequence of mapping
        Of the body, as the page of a run has them.
    frames : int
        How many of the times the animation takes, after the first.
    """
    left, right, low, high = min(pose["x"]), max(pose["x"]), min(pose["y"]), max(pose["y"])
    scale = (WIDTH - 2 * EDGE) / (max(right - left, high - low) or 1)
    points = [(EDGE + (x - left) * scale, EDGE + (high - y) * scale) for x, y in zip(pose["x"], pose["y"])]
    chosen = [round(i * (len(points) - 1) / frames) for i in range(frames + 1)]
    arcs = arc_parts(points)
    style = STYLE.replace("20s", f"{SECONDS}s")
    style += keyframes("body", [
        f"transform:translate({points[i][0]:.1f}px,{points[i][1]:.1f}px)"
        f"rotate({-math.degrees(pose['angle'][i]):.1f}deg)" for i in chosen])
    style += keyframes("trail", [f"stroke-dashoffset:{1 - arcs[i]:.4f}" for i in chosen])
    if any(part["turn"] for part in parts):
        for name, sign in ("turn", 1), ("turn-", -1):
            style += keyframes(name, [
                f"transform:rotate({math.degrees(sign * pose['steer'][i]):.1f}deg)" for i in chosen])
    if any(part["narrowed"] for part in parts):
        style += keyframes("width", [f"transform:scaleY({pose['width'][i]:.3f})" for i in chosen])
    size = [round(2 * EDGE + (end - start) * scale) for start, end in ((left, right), (low, high))]
    path = line(points[::max(1, len(points) // MAX_POINTS)])
    start = f"translate({points[0][0]:.1f}px,{points[0][1]:.1f}px)rotate({-math.degrees(pose['angle'][0]):.1f}deg)"
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size[0]} {size[1]}" role="img">'
            f'<title>{html.escape(title)}</title>\n<style>{style}</style>\n<path class="path" d="{path}"/>\n'
            f'<path class="trail" pathLength="1" stroke-dasharray="1 1" style="animation-name:trail" d="{path}"/>\n'
            f'<g class="body" style="animation-name:body;transform:{start}"><g transform="scale({BODY} {-BODY})">'
            f'{"".join(draw_part(part) for part in parts)}</g></g></svg>')
