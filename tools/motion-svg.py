"""motion-svg.py PAGE ALT - prints the motion on the page of a run as an animated SVG picture.

The page of `dalembert report` has the motion as docs/formats.md describes it; the package of Python
draws it.
"""
import base64
import json
import os
import re
import struct
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "python", "dalembert"))
import moving_svg  # noqa: E402

FRAMES = 300


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


def main(page, alt):
    """Prints the picture."""
    motion, pose = read_motion(page)
    print(moving_svg.draw(pose, motion["parts"], alt, FRAMES))


main(*sys.argv[1:])
