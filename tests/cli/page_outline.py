"""page_outline.py - reads a page of `dalembert report` strictly.

    page_outline.py PAGE            prints its headings, terms and heads of columns in their order,
                                    without the places where words may be divided
    page_outline.py PAGE skeleton   prints all elements with their attributes and texts, figures and
                                    gnuplot scripts without their points, each line once and # for
                                    each number; no files, styles and equations

Every element is one that HTML has, is closed, and has attributes that it may have; anything else is
an error.
"""
import glob
import json
import os
import re
import sys
from html.parser import HTMLParser

VOID = {"meta", "link", "img", "br", "hr", "input", "col"}
HTML = VOID | set(
    "html head title style script body header main section footer nav div span p a b i em strong "
    "code pre h1 h2 h3 h4 dl dt dd ul ol li table caption colgroup thead tbody tr th td details "
    "summary figure figcaption noscript button label select option canvas sub sup small var time".split()
)
SVG = set(
    "svg g path line polyline polygon rect circle ellipse text tspan title desc defs clippath use "
    "marker lineargradient stop".split()
)
MATH = set("math mtable mtr mtd mrow mi mn mo mtext mspace mfrac msqrt msub msup msubsup mover".split())
OWN = {
    "a": {"href", "download"},
    "img": {"src", "alt", "loading", "width", "height", "decoding"},
    "meta": {"charset", "name", "content", "http-equiv"},
    "script": {"type", "id"},
    "html": {"lang"},
    "th": {"colspan", "rowspan", "scope"},
    "td": {"colspan", "rowspan"},
    "button": {"type", "value", "disabled"},
    "input": {"type", "value", "name", "min", "max", "step", "checked", "disabled"},
    "details": {"open"},
    "label": {"for"},
    "select": {"name"},
    "option": {"value", "selected"},
    "canvas": {"width", "height"},
}
GLOBAL = {"id", "class", "title", "hidden", "tabindex", "role", "style", "lang", "inert"}
BLOCKS = set("body main nav h1 h2 h3 p dl dt div table tr details summary figure ul li a noscript".split())
HIDDEN = {"script", "style", "pre", "math"}
NUMBER = re.compile(r"(?<![A-Za-z_0-9#])[-+]?[0-9]+(?:[.][0-9]+)?(?:e[-+]?[0-9]+)?")
SHOWN = {"title", "h1", "h2", "h3", "dt", "th", "summary"}


class Outline(HTMLParser):
    """The elements that are open, and the texts of those that are shown."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.open, self.text = [], []

    def fault(self, what):
        sys.exit(f"line {self.getpos()[0]}: {what}, in {' '.join(self.open)}")

    def handle_starttag(self, tag, attrs):
        in_svg = "svg" in self.open or tag == "svg"
        in_math = "math" in self.open or tag == "math"
        if tag not in (SVG if in_svg else MATH if in_math else HTML):
            self.fault(f"<{tag}>")
        for name, _ in attrs:
            known = in_svg or in_math or name in GLOBAL | OWN.get(tag, set())
            if not known and not name.startswith(("data-", "aria-")):
                self.fault(f"<{tag} {name}=>")
        if tag not in VOID:
            self.open.append(tag)
        if tag in SHOWN and not in_svg:
            self.text.append("")

    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.fault(f"</{tag}>")
        if tag in SHOWN and "svg" not in self.open:
            print(tag, " ".join(self.text.pop().replace("\u00ad", "").split()))

    def handle_data(self, data):
        for i in range(len(self.text)):
            self.text[i] += data


class Skeleton(HTMLParser):
    """The elements of the body with their attributes and texts, and figures without their points."""

    def __init__(self):
        super().__init__(convert_charrefs=True)
        self.hidden, self.in_body, self.lines = "", False, [""]

    def handle_starttag(self, tag, attrs):
        self.in_body |= tag == "body"
        if tag in BLOCKS:
            self.lines.append("")
        if self.in_body and not self.hidden:
            self.lines[-1] += f"<{tag}{''.join(f' {name}={value}' for name, value in attrs)}>"
        if tag in HIDDEN and not self.hidden:
            self.hidden = "figure" if ("class", "figure") in attrs else tag

    def handle_endtag(self, tag):
        if tag == self.hidden or (tag == "script" and self.hidden):
            self.hidden = ""
        if tag in BLOCKS:
            self.lines[-1] += f"</{tag}>"
            self.lines.append("")

    def handle_data(self, data):
        if self.hidden == "figure":
            figure = json.loads(data)
            for curve in figure["curves"]:
                for name in ("x", "y", "upper"):
                    curve.pop(name, None)
            self.lines += [json.dumps(figure["curves"]), json.dumps(figure | {"events": 0, "curves": 0})]
        elif self.in_body and not self.hidden:
            self.lines[-1] += " ".join(data.split())


def print_skeleton(path):
    """What a page and the scripts beside it have, each line once, with # for each number."""
    skeleton = Skeleton()
    with open(path, encoding="utf-8") as page:
        skeleton.feed(page.read())
    lines = skeleton.lines
    for script in sorted(glob.glob(os.path.join(os.path.dirname(path), "*.gp"))):
        if os.path.basename(script).startswith("time"):  # its axis is of measured times
            continue
        with open(script, encoding="utf-8") as file:
            lines += re.sub(r"(<< END\n).*?^END$", r"\1END", file.read(), flags=re.DOTALL | re.MULTILINE).split("\n")
    for line in dict.fromkeys(NUMBER.sub("#", line) for line in lines if line):
        print(line)


def main():
    sys.stdout.reconfigure(encoding="utf-8")
    if sys.argv[2:] == ["skeleton"]:
        print_skeleton(sys.argv[1])
        return
    outline = Outline()
    with open(sys.argv[1], encoding="utf-8") as page:
        outline.feed(page.read())
    outline.close()
    if outline.open:
        outline.fault("the end")


main()
