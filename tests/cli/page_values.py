"""page_values.py - whether a page of `dalembert report` says what the files of its directory say.

    page_values.py DIR            compares every table and every curve of DIR/report/index.html with
                                  the CSV files and trajectories that they are made from, and the
                                  gnuplot scripts with the page; prints what differs, and last how
                                  many values agree
    page_values.py DIR scripts    the scripts alone

What a table or a curve should be follows from docs/formats.md and the captions of the page.
"""
import ast
import csv
import html
import json
import math
import os
import re
import struct
import sys

ROOT = sys.argv[1]
agreed = 0


def same(what, found, wanted):
    """Compares texts, or numbers of six digits."""
    global agreed
    if isinstance(wanted, float) and not isinstance(found, str):
        equal = found == wanted or math.isclose(found, wanted, rel_tol=1e-5, abs_tol=1e-300)
    else:
        equal = found == wanted
    if equal:
        agreed += 1
    else:
        print(f"{what}: {found!r}, not {wanted!r}")


def read_csv(name):
    """The rows of a table, none where there is no file."""
    if not os.path.exists(f"{ROOT}/{name}"):
        return []
    with open(f"{ROOT}/{name}", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(text):
    """A number of a table."""
    return float(text) if text else math.nan


def printed(form, value):
    """A number as a table of the page has it."""
    return "–" if math.isnan(value) else form % value


def read_npy(path):
    """The columns of a trajectory."""
    with open(path, "rb") as file:
        data = file.read()
    size = struct.unpack("<H", data[8:10])[0]
    names = [name for name, _ in ast.literal_eval(data[10:10 + size].decode().strip())["descr"]]
    rows = list(struct.iter_unpack(f"<{len(names)}d", data[10 + size:]))
    return dict(zip(names, zip(*rows)))


# ---- the page ------------------------------------------------------------------------------

with open(f"{ROOT}/report/index.html", encoding="utf-8") as index:
    PAGE = index.read()
FIGURES = {f["name"]: f for f in map(json.loads, re.findall(
    r'<script type="application/json" class="figure">(.*?)</script>', PAGE, re.DOTALL))}


def plain(text):
    """The text of some HTML."""
    return html.unescape(re.sub("<.*?>", "", text)).replace("\u00ad", "")


def table_after(mark, page=None):
    """The rows of the first table after a mark: the attributes and the text of each cell."""
    page = PAGE if page is None else page
    start = page.index(mark)
    begin = page.index("<table", start)
    text = page[begin:page.index("</table>", begin)]
    return [re.findall(r"<t[hd]([^>]*)>(.*?)</t[hd]>", row, re.DOTALL)
            for row in re.split("<tr[^>]*>", text)[1:]]


def texts(row):
    """The texts of a row."""
    return [plain(text) for _, text in row]


def curve_list(figure):
    """The curves of a figure: title, x, y, of bands the upper edge, and what follows the title."""
    abscissas, found = [], []
    for curve in figure["curves"]:
        x = curve["x"] if isinstance(curve["x"], list) else abscissas[curve["x"]]
        abscissas.append(x)
        found.append((curve["title"], (x, curve["y"], curve.get("upper"), curve.get("note", ""))))
    return found


def curves(figure):
    """The same by their titles."""
    return dict(curve_list(figure))


def compare_points(what, curve, wanted):
    """Whether a curve has just the points that are wanted, to the six digits of a page."""
    found = list(zip(curve[0], curve[1]))
    close = len(found) == len(wanted) and all(math.isclose(a, b, rel_tol=1e-5, abs_tol=1e-300)
                                              for p, q in zip(found, wanted) for a, b in zip(p, q))
    same(what, found if not close else wanted, wanted)


def compare_curve(what, curve, wanted):
    """Whether a curve has the points wanted; those on a level between others may be left out."""
    left = list(zip(curve[0], curve[1]))
    for i, (x, y) in enumerate(wanted):
        if left and math.isclose(left[0][0], x, rel_tol=2e-5, abs_tol=1e-12):
            same(f"{what} at {x}", left.pop(0)[1], y)
        else:
            level = 0 < i < len(wanted) - 1 and wanted[i - 1][1] == y == wanted[i + 1][1]
            same(f"{what} has {x}", level, True)
    same(f"{what}: points that are not wanted", left, [])


def trend_colour(size, trend, value):
    """The class of a size with a trend."""
    if trend in ("failed", "aborted"):
        return "large"
    if not size and not trend:
        return "off"
    if size != "larger":
        return "kept"
    return "small" if value < 1e-9 else "medium" if value < 1e-4 else "large"


def compare_trend(what, cell, size, trend, value):
    """Whether a cell has a size, a trend and a value, in its words and its attributes."""
    attributes, text = cell
    shown = re.findall('data-(?:size|trend|value)="([^"]*)"', attributes)
    same(f"{what}: size and trend", shown[:2], [size, trend])
    same(f"{what}: class", re.search('class="trend ([a-z]*)"', attributes)[1],
         trend_colour(size, trend, value))
    if math.isnan(value):
        same(f"{what}: value", shown[2], "")
        return
    close = math.isclose(float(shown[2]), value, rel_tol=0.051, abs_tol=0)
    same(f"{what}: {shown[2]} is {value}", close, True)
    words = ", ".join(w for w in (size, trend if size != "exact" and trend != "none" else "") if w)
    same(f"{what}: words", re.sub("\\|drift.*", "", plain(text)), shown[2] + words)


def slope_note(points, values):
    """What a title of an envelope has after it."""
    if not points:
        return " (0)" if not any(values) else " (not finite)"
    last, first = points[-1], points[-1]
    for point in reversed(points):
        first = point
        if point[0] <= 0.1 * last[0] * (1 + 1e-9):
            break
    if first == last:
        return ""
    return f" ({abs(math.log(last[1] / first[1]) / math.log(last[0] / first[0])):.1f})"


# ---- scripts -------------------------------------------------------------------------------

def compare_script(figure):
    """Whether a script has the texts and the points of its figure, and room for them."""
    name = figure["name"]
    with open(f"{ROOT}/report/{name}.gp", encoding="utf-8") as file:
        script = file.read()
    quoted = r"'((?:[^']|'')*)'"
    for what, mark in (("title", "title offset 0,-0.4"), ("x", "xlabel offset 0,0.4"), ("y", "label 1")):
        found = re.search(f"^set {mark} {quoted}", script, re.MULTILINE)
        same(f"{name}.gp: {what}", found and found[1].replace("''", "'"), figure[what] or None)
    for axis in "xy":
        same(f"{name}.gp: logscale", f"set logscale {axis}\n" in script, f"log{axis.upper()}" in figure)
    data = [block[:-1].split("\n")
            for block in re.findall(r"^\$curve\d+ << END\n(.*?)^END$", script, re.DOTALL | re.MULTILINE)]
    same(f"{name}.gp: curves with points", len(data), len(figure["curves"]))
    lines = [line for line in script[script.index("\nplot "):].split("\n")
             if " using 1:" in line and "using 1:3" not in line and not line.endswith("notitle, \\")]
    for (title, curve), rows, shown in zip(curve_list(figure), data, figure["curves"]):
        same(f"{name}.gp: points of {title}", len(rows), len(curve[0]))
        for i, row in enumerate(rows):
            values = [None, None] if not row else [float(value) for value in row.split(",")]
            for k, value in enumerate(values):
                wanted = curve[k][i]
                same(f"{name}.gp: {title}", value, wanted if wanted is None else float(wanted))
        if title:
            line = next((line for line in lines if f" title '{title.replace(chr(39), 2 * chr(39))}{curve[3]}'" in line), "")
            style = {"band": "filledcurves", "dots": "points pt 7", "rings": "points pt 6",
                     "line": "linespoints" if "marks" in figure else "lines lw"}[shown["kind"]]
            same(f"{name}.gp: {title}: {style}", f" with {style}" in line, True)
    high, key = re.search(r"size 326,(\d+)", script), re.search(r"maxrows (\d+) maxcols (\d+)", script)
    height, rows, columns = int(high[1]), int(key[1]), int(key[2])
    titles = [t for t in re.findall(fr"(?<!no) title {quoted}", script[script.index("\nplot "):]) if t]
    same(f"{name}.gp: {len(titles)} titles in {rows} times {columns}", len(titles) <= rows * columns, True)
    longest = max((len(t.replace("''", "'").encode()) for t in titles), default=0)
    same(f"{name}.gp: columns of titles", columns, max(1, int(326 / (50 + 7 * longest))))
    margins = {m: float(v) for m, v in re.findall(r"([lrtb])margin at screen ([0-9.]+)", script)}
    same(f"{name}.gp: above", round((1 - margins["t"]) * height), 32)
    same(f"{name}.gp: below", round(margins["b"] * height), 54 + 17 * rows)
    if "toScale" not in figure and "rows" not in figure:
        same(f"{name}.gp: height", height, 245 + 17 * rows)
    for axis, place in (("x", 0), ("y", 1)):
        found = re.search(fr"^set {axis}range \[([-0-9.e+]+):([-0-9.e+]+)\]", script, re.MULTILINE)
        if found:
            points = [x for _, curve in curve_list(figure) for x in curve[place] if x is not None]
            low, high = float(found[1]), float(found[2])
            slack = 1e-5 * max(abs(low), abs(high))
            same(f"{name}.gp: range of {axis}", low - slack <= min(points) <= max(points) <= high + slack, True)


# ---- runs ----------------------------------------------------------------------------------

def events():
    """The table of events, from events.csv."""
    log = read_csv("events.csv")
    if not log:
        return
    for row in table_after('id="events"')[1:]:
        cells = texts(row)
        times = [e["t"] for e in log if cells[0].startswith(f"event {e['event']} ")]
        same("events: how often", cells[2], str(len(times)))
        for k, place in ((3, 0), (4, -1)):
            same("events: t", cells[k], printed("%.9g", float(times[place]) if times else math.nan))


def trends(time):
    """The table of sizes and trends, from summary.csv."""
    columns = ("confidence", "first", "final", "maximum", "deviation", "rate", "rate_low", "rate_high", "exponent")
    summary = read_csv("summary.csv")
    rows = table_after('id="trends"')[1:]
    same("trends: rows", len(rows), len(summary))
    for row, wanted in zip(rows, summary):
        name = wanted["observable"]
        same("trends: name", texts(row)[0], name)
        compare_trend(f"trends: {name}", row[1], wanted["size"], wanted["trend"], number(wanted["deviation"]))
        same(f"trends: {name}", texts(row)[2:], [printed("%.4g", number(wanted[c])) for c in columns])
        drift = re.search(r"\|drift\| ≤ (.*)", plain(row[1][1]))
        rate = max(abs(number(wanted["rate_low"])), abs(number(wanted["rate_high"])))
        has_drift = wanted["trend"] == "none" and wanted["size"] != "exact"
        same(f"trends: drift of {name}", drift and drift[1], f"{rate * time:.1e}" if has_drift else None)


def run(has_trends=True):
    """A page of a run of few rows, none of which oscillates between them."""
    columns = read_npy(f"{ROOT}/trajectory.npy")
    t = columns["t"]
    if has_trends:
        trends(abs(t[-1] - t[0]))
    same("trends", 'id="trends"' in PAGE or 'class="verdicts"' in PAGE, has_trends)
    shown = dict(re.findall(r"<span>(.*?) = (.*?)</span>", html.unescape(PAGE)))
    for name, text in shown.items():
        close = math.isclose(float(text), columns[name][-1], rel_tol=6e-4, abs_tol=1e-300)
        same(f"state: {name} = {text}", close, True)
    figures = {"coordinates", "angles", "D", "observed", "R", "error", "E", "H", "I"} & FIGURES.keys()
    jumps = bool(read_csv("events.csv"))
    for f in figures:
        for name, curve in curves(FIGURES[f]).items():
            first = columns[name][0] if f in ("E", "H", "I") else 0.0
            values = [x - first for x in columns[name]]
            if len(values) > 1 and FIGURES[f]["curves"][0]["kind"] != "band":
                compare_curve(f"{f}: {name}", curve, list(zip(t, values)))
    names = list(columns)[1:]
    coordinates = [n for f in ("coordinates", "angles") if f in FIGURES for n in curves(FIGURES[f])]
    velocities = [f"{n}'" for n in names if n in coordinates and f"{n}'" in columns]
    if coordinates:
        same("state", list(shown), ["t"] + [n for n in names if n in coordinates] + velocities)
    if "drift" in FIGURES and not jumps:
        for name, curve in curves(FIGURES["drift"]).items():
            points, largest, at = [], 0.0, 0.0
            for i, time in enumerate(t):
                passed = abs(time - t[0])
                first = columns[name][0] if name[0] != "D" and name != "error" else 0.0
                largest = max(largest, abs(columns[name][i] - first))
                if passed >= 1.05 * at or i == len(t) - 1:
                    at = passed
                    if passed > 0 and largest > 0:
                        points.append((passed, largest))
            compare_curve(f"drift: {name}", curve, points)
            same(f"drift: slope of {name}", curve[3], slope_note(list(zip(*curve[:2])), [largest]))
    events()


def steer():
    """A page of motions to a target, which begins with them: inputs drive E and momenta, whatever the method."""
    names = ("S", "distance", "residual", "max_D", "iterations", "rank", "conjugate_times", "condition")
    with open(f"{ROOT}/steer.json", encoding="utf-8") as file:
        found = json.load(file)
    best = found["motions"][0]
    same("what was found", f"<p><strong>Reaches the target at t = {found['to']:.6g} for S = {best['S']:.9g}, within "
         f"{best['distance']:.2g}.</strong> </p>" in PAGE, True)
    rows = [texts(row) for row in table_after("Reaches the target")]
    values = [[math.nan if m[k] is None else float(m[k]) for k in names] for m in found["motions"]]
    same("motions", rows, [["motion", *names]] +
         [[str(i + 1), *(printed("%.6g", x) for x in row)] for i, row in enumerate(values)])
    inputs = read_csv("inputs.csv")
    drawn = curves(FIGURES["inputs"])
    same("inputs", list(drawn), [name for name in inputs[0] if name != "t"])
    for name, curve in drawn.items():
        compare_curve(f"inputs: {name}", curve, [(number(r["t"]), number(r[name])) for r in inputs])
    run(False)


# ---- studies -------------------------------------------------------------------------------

QUANTITIES = (("D", "D_max", "D", "D"), ("E", "E_deviation", "E", "E"),
              ("I", "invariant_deviation", "invariant", "invariants"),
              ("H", "H_deviation", "H", "H"), ("error", "error_max", None, "error"))


def step_title(text):
    """A step as a table has it, in words."""
    step, tolerance = (text.split() + [""])[:2]
    return f"{float(step):g}" + (f", tolerance {float(tolerance):g}" if tolerance else "")


def with_steps(rows):
    """Rows whose step is the pair of step and tolerance."""
    for row in rows:
        if row["step"] and float(row.get("tolerance") or 0):
            row["step"] += " " + row["tolerance"]
    return rows


def expectations():
    """The tables of expectations, from expectations.csv."""
    rows = with_steps(read_csv("expectations.csv"))
    if not rows:
        return
    heads = ("label", "integrator", "start", "step", "quantity", "expected", "found")
    shown = [[step_title(r[h]) if h == "step" and r[h] else r[h] or "–" * (h == "step") for h in heads] +
             ["met" if r["met"] == "yes" else "not met"] for r in rows]
    colours = {"met": "kept", "not met": "large"}
    failed = [r for r in rows if r["met"] == "no" and r["quantity"] != "state"]
    counts = "".join(f"; {n} {word}" for word in ("failed", "aborted")
                     if (n := sum(r["found"] == word for r in failed)))
    met = sum(r["met"] == "yes" for r in rows)
    same("expectations", f"<p>{met} of {len(rows)} are met{counts}.</p>" in PAGE, True)
    tables = [("all of them", shown)]
    if met < len(rows):
        tables.append(('id="expectations"', [row for row in shown if row[-1] != "met"]))
    for mark, wanted in tables:
        found = table_after(mark)[1:]
        same(f"expectations {mark}", [texts(row) for row in found], wanted)
        same("their colours", [re.search('class="(.*)"', row[-1][0])[1] for row in found],
             [colours[row[-1]] for row in wanted])


def find_cell(cells, label, method, step, displaced):
    """The cell that is shown: of the two starts without displacement the physical one."""
    starts = ("displaced",) if displaced else ("physical", "surface")
    return next((c for start in starts for c in cells if c["state"] != "refused" and c["start"] == start and
                 (c["label"], c["integrator"], c["step"]) == (label, method, step)), None)


def matrices(cells):
    """The tables of methods against systems."""
    for name, column, prefix, _ in QUANTITIES:
        mark = f'class="matrix" data-quantity="{name}"'
        if not prefix or not any(c[column] for c in cells if (c["start"] == "displaced") == (name == "H")):
            same(f"a matrix of {name}", mark in PAGE, False)
            continue
        begin = PAGE.rindex("<", 0, PAGE.index(mark))
        heads, *rows = table_after("<table", PAGE[begin:])
        same(f"{name}: heads", len(heads) > 1, True)
        for row in rows:
            method = texts(row)[0]
            for head, cell in zip(heads[1:], row[1:]):
                label, step = (html.unescape(re.search(f'data-{what}="([^"]*)"', head[0])[1]) for what in ("label", "step"))
                whole = next(c["step"] for c in cells if c["label"] == label and step_title(c["step"]) == step)
                wanted = find_cell(cells, label, method, whole, name == "H")
                what = f"{name} of {method}, {label}, {step}"
                if wanted and wanted["state"] == "failed":
                    compare_trend(what, cell, "", "failed", number(wanted[column]))
                elif not wanted or not wanted[column]:
                    same(what, plain(cell[1]), "–")
                else:
                    compare_trend(what, cell, wanted[f"{prefix}_size"], wanted[f"{prefix}_trend"], number(wanted[column]))
        shown = {(texts(row)[0]) for row in rows}
        labels = {html.unescape(re.search('data-label="([^"]*)"', head[0])[1]) for head in heads[1:]}
        same(f"{name}: methods", shown, {c["integrator"] for c in cells for l in labels
                                         if c["label"] == l and find_cell(cells, l, c["integrator"], c["step"], name == "H")})
        same(f"{name}: labels", labels, {c["label"] for c in cells if c[column] and (c["start"] == "displaced") == (name == "H")})


def envelopes(cells, label, number_of, series, steps):
    """The figures over t of a label."""
    for h, step in enumerate(steps):
        for name, column, _, column_of_series in QUANTITIES:
            file = f"{number_of}-{name}" + (f"-h{h + 1}" if h else "")
            figure = FIGURES.get(file)
            drawn = curves(figure) if figure else {}
            for method in dict.fromkeys(c["integrator"] for c in cells if c["label"] == label):
                cell = find_cell(cells, label, method, step, name == "H")
                if not cell or not cell[column]:
                    same(f"{file}: {method}", method in drawn, False)
                    continue
                rows = [r for r in series if (r["integrator"], r["step"], r["start"]) == (method, step, cell["start"])]
                points, largest = [], 0.0
                for r in rows:
                    largest = max(largest, number(r[column_of_series]))
                    if largest > 0:
                        points.append((float(r["until"]), largest))
                if method in drawn:
                    compare_curve(f"{file}: {method}", drawn[method], points)
                    same(f"{file}: slope of {method}", drawn[method][3], slope_note(list(zip(*drawn[method][:2])), [largest]))
                else:
                    same(f"{file}: {method} is not drawn", points, [])


def errors(cells, label, number_of, steps):
    """The figures of errors over work, steps and tolerances of a label."""
    mine = [c for c in cells if c["label"] == label]
    column = next((c for c in ("error_max", "invariant_deviation", "E_deviation")
                   if any(r[c] and (c != "E_deviation" or r["E_trend"]) for r in mine)), None)
    controlled = [" " in step for step in steps]
    for name, enough in (("work", True), ("order", controlled.count(False) > 1), ("tolerance", sum(controlled) > 1)):
        figure = FIGURES.get(f"{number_of}-{name}")
        for title, curve in curves(figure).items() if figure else ():
            points = []
            for step in steps:
                cell = find_cell(cells, label, title, step, False)
                if not cell or cell["state"] != "done" or (name != "work" and (" " in step) != (name == "tolerance")):
                    continue
                sizes = [float(x) for x in step.split()]
                x = {"work": float(cell["evaluations"]) / (float(cell["steps"]) * sizes[0]),
                     "order": sizes[0], "tolerance": sizes[-1]}[name]
                points.append((x, number(cell[column])))
            compare_points(f"{number_of}-{name}: {title}", curve, [p for p in points if p[1] > 0])
        if column and enough:
            zero = not any(number(c[column]) > 0 for c in mine if c["state"] == "done" and c["start"] != "displaced")
            same(f"there is {number_of}-{name}", figure is not None, not zero)


def predicted(cells):
    """The figure and the table of what was predicted of a study."""
    shown = [c for c in cells if find_cell(cells, c["label"], c["integrator"], c["step"], False) is c]
    drawn = curves(FIGURES["predicted"])
    ends = []
    for title, value, size in (("max |D|", "D_max", "D_size"), ("max |E - E(0)|", "E_deviation", "E_size"),
                               ("max |I - I(0)|", "invariant_deviation", "invariant_size")):
        points = [(number(c[f"predicted_{value}"]), number(c[value])) for c in shown
                  if c["state"] == "done" and not c["predicted_message"] and c[size] in ("", "larger")]
        points = [p for p in points if p[0] > 0 and p[1] > 0]
        ends += [x for p in points for x in p]
        if points:
            compare_points(f"predicted: {title}", drawn[title], points)
    compare_points("predicted: equal", drawn["equal"], [(min(ends),) * 2, (max(ends),) * 2])
    heads, *rows = table_after('id="predicted"')
    same("predicted: rows", [texts(row)[:3] for row in rows],
         [[c["label"], c["integrator"], step_title(c["step"])] for c in shown if c["predicted_until"] or c["predicted_message"]])
    same("predicted: values", [texts(row)[3:] for row in rows],
         [[printed("%.3g", number(c[k])) for value in ("D_max", "E_deviation", "invariant_deviation")
           for k in (f"predicted_{value}", value)] +
          [printed("%.6g", number(c["predicted_until"])), c["predicted_message"]]
          for c in shown if c["predicted_until"] or c["predicted_message"]])


def study():
    """A page of a study of few methods."""
    cells = with_steps(read_csv("cells.csv"))
    states = ", ".join(f"{n} {s}" for s in ("done", "failed", "refused") if (n := sum(c["state"] == s for c in cells)))
    counts = [len({c[k] for c in cells}) for k in ("integrator", "label")]
    same("counts", f"<p>{counts[0]} methods × {counts[1]} systems, {len(cells)} runs: {states}; " in PAGE, True)
    expectations()
    matrices(cells)
    if "predicted_until" in cells[0]:
        predicted(cells)
    for part in map(json.loads, re.findall(r'class="data">(.*?)</script>', PAGE, re.DOTALL)):
        label = part["label"]
        begin = re.search(fr'<h3 id="s(\d+)">(?:(?!</h3>).)*{re.escape(html.escape(label, quote=True).replace("&#x27;", chr(39)))}', PAGE)
        same(f"{label} has a section", begin is not None, True)
        steps = list(dict.fromkeys(c["step"] for c in cells if c["label"] == label))
        series = with_steps(read_csv(f"series/{label}.csv"))
        envelopes(cells, label, begin[1], series, steps)
        errors(cells, label, begin[1], steps)


# ---- ensembles, orders, sections, means ----------------------------------------------------

def ensemble():
    """A page of an ensemble at few times."""
    statistics, histograms, cloud = (read_csv(f"{n}.csv") for n in ("statistics", "histograms", "cloud"))
    names = list(dict.fromkeys(r["column"] for r in statistics))
    times = list(dict.fromkeys(r["t"] for r in statistics))
    keys = list(statistics[0])
    same("statistics: title", f">Statistics at t = {float(times[-1]):.6g}</h2>" in PAGE, True)
    heads, *rows = table_after('id="statistics"')
    same("statistics: heads", texts(heads), keys[1:])
    same("statistics", [texts(row) for row in rows],
         [[r["column"]] + [printed("%.6g", number(r[k])) for k in keys[2:]] for r in statistics if r["t"] == times[-1]])
    last = {r["column"]: r for r in statistics if r["t"] == times[-1]}
    means = {html.unescape(name): (float(mean), float(size)) for name, mean, size in
             re.findall(r"<span>([^<=]*) = (\S+) ± (\S+)</span>", PAGE)}
    same("means: names", list(means), [n for n in last if number(last[n]["deviation"]) > 0])
    for name, (mean, size) in means.items():
        same(f"means: {name}", math.isclose(mean, number(last[name]["mean"]), rel_tol=6e-4) and
             math.isclose(size, number(last[name]["deviation"]), rel_tol=0.06), True)
    varying = [n for n in names if any(number(r["min"]) < number(r["max"]) for r in statistics if r["column"] == n)]
    same("histograms", [n for n in FIGURES if n.startswith("histogram")],
         [f"histogram-{names.index(n) + 1}" for n in varying])
    for n in varying:
        drawn = curves(FIGURES[f"histogram-{names.index(n) + 1}"])
        for t in times if len(times) <= 4 else []:
            bins = [r for r in histograms if r["t"] == t and r["column"] == n]
            wanted = [(number(r[end]), number(r["count"])) for r in bins for end in ("low", "high")]
            if any(y for _, y in wanted):
                compare_curve(f"histogram of {n} at {t}", drawn[f"t = {float(t):.6g}"], wanted)
        band = FIGURES.get(f"band-{names.index(n) + 1}")
        same(f"band of {n}", band is not None, len(times) > 2)
        if band:
            mine = [r for r in statistics if r["column"] == n]
            drawn = curves(band)
            compare_curve(f"mean of {n}", drawn["mean"], [(number(r["t"]), number(r["mean"])) for r in mine])
            for k, key in ((1, keys[6]), (2, keys[-2])):
                for found, r in zip(drawn[""][k], mine):
                    same(f"band of {n}: {key}", found, number(r[key]))
            same(f"caption of {n}", f"Mean, and between the quantiles {keys[6][1:]} and {keys[-2][1:]}." in PAGE, True)
    axes = list(cloud[0])[2:]
    for i, t in enumerate(times if len(times) <= 12 else []):
        figure = FIGURES[f"cloud-{i + 1}"]
        same("cloud", [figure["title"], figure["x"], figure["y"]], [f"t = {float(t):.6g}"] + axes)
        wanted = [[number(r[a]) for r in cloud if r["t"] == t] for a in axes]
        for k in range(2):
            for found, value in zip(figure["curves"][0]["xy"[k]], wanted[k], strict=True):
                same(f"cloud at {t}", found, value)


def orders():
    """A page of orders of few methods."""
    table = with_steps(read_csv("order.csv"))
    good = [r for r in table if r["error"]]
    methods, steps = (list(dict.fromkeys(r[k] for r in good)) for k in ("integrator", "step"))
    heads, *rows = table_after("<th>order, stated</th>", PAGE.replace("<table><thead><tr><td></td><th>order, s",
                                                                     "<th>order, stated</th><table><tr><td></td><th>order, s"))
    same("orders: heads", texts(heads)[3:-2], [f"h = {step_title(s)}" for s in steps])
    for row, method in zip(rows, methods, strict=True):
        mine = {r["step"]: r for r in good if r["integrator"] == method}
        first, last = next(iter(mine.values())), mine.get(steps[-1])
        cost = [float(last[k]) / float(last["steps"]) * f for k, f in (("evaluations", 1), ("seconds", 1e6))]
        *found, seconds = texts(row)
        same(f"orders of {method}", found,
             [method, f"{float(first['stated_order']):g}", printed("%.2f", number(first["observed_order"]))] +
             [printed("%.1e", number(mine[s]["error"]) if s in mine else math.nan) for s in steps] +
             [f"{cost[0]:.1f}"])
        same(f"seconds of {method}", math.isclose(float(seconds), cost[1], rel_tol=0, abs_tol=0.00501), True)
    for r in table:
        if r["message"]:
            same(f"message of {r['integrator']}", f"<li>{r['integrator']}: {html.escape(r['message'], quote=False)}</li>" in PAGE, True)
    for name, column in (("order", "step"), ("work", "evaluations"), ("time", "seconds"), ("tolerance", "tolerance")):
        for title, curve in curves(FIGURES[name]).items() if name in FIGURES else ():
            wanted = [(number(r[column].split()[0]), number(r["error"])) for r in good if r["integrator"] == title]
            compare_points(f"{name} of {title}", curve, [p for p in wanted if p[1] > 0])


def section():
    """A page of a section of few crossings."""
    rows = read_csv("section.csv")
    up = sum(r["direction"] == "1" for r in rows)
    same("crossings", f"<p class=\"lead\">{len(rows)} crossings: {up} upwards, {len(rows) - up} downwards, from t = "
         f"{number(rows[0]['t']):.6g} to t = {number(rows[-1]['t']):.6g}.</p>" in PAGE, True)
    figure = FIGURES["section"]
    for title, direction in (("upwards", "1"), ("downwards", "-1")):
        mine = [r for r in rows if r["direction"] == direction]
        drawn = curves(figure).get(title, ([], []))
        for k, axis in enumerate((figure["x"], figure["y"])):
            for found, r in zip(drawn[k], mine, strict=True):
                same(f"crossings {title}", found, number(r[axis]))


def means(name):
    """A page of means so far."""
    rows = read_csv(f"{name}.csv")
    columns = [c for c in rows[0] if c != "t"]
    found = [texts(row) for row in table_after('id="means"')]
    same("means", found, [["", "mean"]] + [[c, f"{number(rows[-1][c]):.6g}"] for c in columns])
    for c in columns:
        compare_curve(f"mean of {c}", curves(FIGURES[name])[c], [(number(r["t"]), number(r[c])) for r in rows])


def files():
    """Files that a page shows whole."""
    for name in ("manifest.json", "study.yaml", "tables.txt", "order.json", "section.json", "steer.json", "failures.csv"):
        shown = re.search(fr"<summary>[^<]*{re.escape(name)}</summary>\n<pre[^>]*>(.*?)</pre></details>", PAGE, re.DOTALL)
        path = f"{ROOT}/{name}"
        if os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                same(name, shown and html.unescape(shown[1]), file.read())


KINDS = (("steer.json", steer), ("cells.csv", study), ("statistics.csv", ensemble), ("order.csv", orders), ("section.csv", section),
         ("lyapunov.csv", lambda: means("lyapunov")), ("volume.csv", lambda: means("volume")), ("trajectory.npy", run))
if sys.argv[2:] != ["scripts"]:
    next(kind for name, kind in KINDS if os.path.exists(f"{ROOT}/{name}"))()
for each in FIGURES.values():
    compare_script(each)
files()
print(f"{agreed} values")
