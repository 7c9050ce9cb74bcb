#!/usr/bin/env python3
"""predicted.py - predictions of `dalembert predict` beside long runs.

    predicted.py PROGRAM walks [PIECES]   s^2 of the random walk of E of chaotic oscillators, predicted from PIECES
                                          (100) pieces of the exact motion and measured on a run as long
    predicted.py PROGRAM zeros [STEPS]    mean rates that are "0 by reversibility", of all systems and symmetric
                                          methods, in runs of STEPS (1000000) steps: the largest change in the last
                                          tenth over the largest in the first
    predicted.py PROGRAM curves [TIME]    predicted curves to TIME (200), or as far as they go, and runs: the largest
                                          difference over the largest change, cell by cell; and a table of the systems

docs/predict.md has what they found.
"""
import json
import math
import subprocess
import sys

PROGRAM, WHAT = sys.argv[1:3]
COUNT = int(float(sys.argv[3])) if len(sys.argv) > 3 else {"walks": 100, "zeros": 1000000, "curves": 200}[WHAT]

# Method, step, length of a piece, angle of the start.
WALKS = (("mclachlan-perlmutter", 0.1, 2000, None), ("spark2", 0.1, 2000, None), ("dla", 0.1, 2000, None),
         ("mclachlan-perlmutter", 0.1, 2000, 1.1), ("mclachlan-perlmutter", 0.05, 2000, None))
METHODS = ("implicit-midpoint,stormer-verlet,gauss4,gauss6,lobatto4,lobatto6,mclachlan-perlmutter,rattle,dla,spark2,"
           "spark4,spark6,gauss-spark2,gauss-spark4,gauss-spark6,implicit-midpoint+yoshida4,bm4,"
           "gauss4+symmetric-project,lobatto4+symmetric-project")

REGULAR = ("appell-hamel-harmonic", "benenti", "chaplygin-sleigh", "contact-oscillator", "falling-disk",
           "falling-disk-reduced", "heisenberg", "knife-edge", "knife-edge-reaction", "mobile-robot",
           "nonholonomic-particle", "nonholonomic-particle-free", "pendulum-cvt", "rocket", "servo-pendulum",
           "snakeboard", "turntable-ball", "turntable-ball-tilted", "unequal-springs", "vertical-disk")
FOURTH = "rk4,gauss4,lobatto4,rk4+project,gauss4+project,spark4,gauss-spark4"
SECOND = ("mclachlan-perlmutter,spark2,gauss-spark2,dla,implicit-midpoint+project,stormer-verlet+project,"
          "implicit-midpoint,stormer-verlet")


def call(*arguments):
    """What a command prints as JSON; None where it is refused."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json"], capture_output=True, text=True, check=False)
    return json.loads(done.stdout) if done.returncode == 0 else None


def energies(*arguments):
    """E at the rows of a run."""
    done = subprocess.run([PROGRAM, "run", *map(str, arguments), "--columns", "E", "--output", "-"],
                          capture_output=True, text=True, check=True)
    return [float(line.split(",")[-1]) for line in done.stdout.splitlines()[1:]]


def variance(values):
    """Their variance."""
    mean = math.fsum(values) / len(values)
    return math.fsum((x - mean) ** 2 for x in values) / (len(values) - 1)


def walks():
    """s^2 by var S(T) and var S(T/2), of predictions and of runs."""
    print("| method | h | angle | predicted s²/h⁴ | measured | ratio |\n|---|---|---|---|---|---|")
    for method, step, length, angle in WALKS:
        start = ("chaotic-oscillators", "--integrator", method, "--step", step)
        start += () if angle is None else ("--set", f"angle={angle}")
        found = call("predict", *start, "--time", length, "--pieces", COUNT)
        if not found or found["predictions"][0]["refused"]:
            print(f"| `{method}` | {step} | refused |")
            continue
        ahead = next(o for o in found["predictions"][0]["observables"] if o["name"] == "E")
        E = energies(*start, "--time", length * COUNT, "--samples", 2 * COUNT)
        whole = variance([E[i + 2] - E[i] for i in range(0, 2 * COUNT, 2)])
        half = variance([E[i + 1] - E[i] for i in range(2 * COUNT)])
        measured = 2 * (whole - half) / length
        margin = 2 * math.sqrt((whole ** 2 + half ** 2 + (whole / 2 - half) ** 2) / COUNT) / length
        print(f"| `{method}` | {step} | {angle or 'π/9'} | {ahead['walk'] / step ** 4:.3g} ± "
              f"{100 * ahead['walk_margin'] / ahead['walk']:.0f} % | {measured / step ** 4:.3g} ± {100 * margin / measured:.0f} % | "
              f"{ahead['walk'] / measured:.2f} |", flush=True)


def zeros():
    """Zeros that are said, and what runs do."""
    print("| system | method | quantity | first tenth | last tenth | ratio |\n|---|---|---|---|---|---|")
    for system in (item["system"] for item in call("list", "systems")["systems"]):
        found = call("predict", system, "--integrator", METHODS, "--time", 200, "--quad-steps", 0)
        for p in found["predictions"] if found else ():
            said = [o for o in p.get("observables", ()) if o["zero_by_reversibility"] and o["max_change"] > 1e-11]
            if p["refused"] or not said:
                continue
            rows = 10000
            names = ",".join(o["name"] for o in said)
            done = subprocess.run([PROGRAM, "run", system, "--integrator", p["integrator"], "--step", str(p["step"]),
                                   "--steps", str(COUNT), "--samples", str(rows), "--columns", names, "--output", "-"],
                                  capture_output=True, text=True, check=False)
            table = [list(map(float, line.split(",")[-len(said):])) for line in done.stdout.splitlines()[1:]]
            if len(table) < 20:
                print(f"| `{system}` | `{p['integrator']}` | {names} | {done.stderr.strip()} |", flush=True)
                continue
            for o, column in zip(said, zip(*table)):
                change = [abs(x - column[0]) for x in column]
                first, last = max(change[:len(change) // 10]), max(change[-(len(change) // 10):])
                print(f"| `{system}` | `{p['integrator']}` | {o['name']} | {first:.3g} | {last:.3g} | "
                      f"{last / first if first else math.inf:.3f}{'' if done.returncode == 0 else ' (failed)'} |", flush=True)


def compare(system, p):
    """The differences of a curve that ends where p does from the run, over the largest change of the run.

    Gives the quantity, the end, where the phase is lost, and the differences of the curve, as far as there, of its size.
    """
    name, step, end = p["integrator"], str(p["step"]), p["end"]
    steps = round(end / p["step"])
    end = end if steps <= 200 else p["step"] * 200 * (steps // 200)
    again = call("predict", system, "--integrator", name, "--step", step, "--time", end)["predictions"][0]
    shown = [o for o in again["observables"] if o["conserved"] and o["name"][:1] + o["name"][1:].strip("0123456789") != "D"]
    rows, phase = len(again["t"]) - 1, again["in_phase"] or end
    done = subprocess.run([PROGRAM, "run", system, "--integrator", name, "--step", step, "--time", str(end), "--sampling",
                           "steps", "--samples", str(rows), "--columns", ",".join(["t"] + [o["name"] for o in shown]),
                           "--output", "-"], capture_output=True, text=True, check=False)
    table = [list(map(float, line.split(",")[-len(shown):])) for line in done.stdout.splitlines()[1:]]
    times = [float(line.split(",")[0]) for line in done.stdout.splitlines()[1:]]
    if len(table) != rows + 1 or any(abs(a - b) > 0.01 * p["step"] for a, b in zip(times, again["t"])):
        print(f"| `{system}` | `{name}` | the run ends before the prediction |")
        return
    for o, column in zip(shown, zip(*table)):
        change = [x - column[0] for x in column]
        size = max(map(abs, change))
        if size > 1e-11:
            off = [abs(x - y) / size for x, y in zip(change, o["curve"])]
            before = max(x for x, t in zip(off, times) if t <= phase)
            yield o["name"], end, phase, max(off), before, abs(max(map(abs, o["curve"])) / size - 1)


def curves():
    """Predicted curves and runs, and a table of the systems."""
    table = []
    print("| system | method | leaves D = 0 | quantity | to t | in phase to | curve | in phase | size |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for system in REGULAR:
        row = []
        for order, methods in ((4, FOURTH), (2, SECOND)):
            found = call("predict", system, "--integrator", methods, "--time", COUNT)
            for p in found["predictions"] if found else ():
                for name, end, phase, curve, before, size in compare(system, p) if not p["refused"] else ():
                    row.append((order, p["leaves_D"], curve, before))
                    print(f"| `{system}` | `{p['integrator']}` | {'yes' if p['leaves_D'] else 'no'} | {name} | {end:.6g} | "
                          f"{phase:.4g} | {100 * curve:.2g} % | {100 * before:.2g} % | {100 * size:.2g} % |", flush=True)
        table.append((system, found["predictions"][0]["step"] if found else math.nan, row))
    print("\n| system | h | order 4: cells | leaves D = 0 | does not | order 2: cells | leaves D = 0 | does not | in phase |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for system, step, row in table:
        text = f"| `{system}` | {step} |"
        for order in (4, 2):
            text += f" {sum(r[0] == order for r in row)} |"
            for leaves in (True, False):
                cells = [r[2] for r in row if r[:2] == (order, leaves)]
                text += f" {100 * max(cells):.2g} % |" if cells else " - |"
        cells = [r[3] for r in row if r[:2] == (2, False)]
        print(text + (f" {100 * max(cells):.2g} % |" if cells else " - |"))
    for order, leaves, limit in ((4, False, 0.01), (4, True, 0.02), (2, False, 0.01), (2, True, 0.02)):
        cells = [r[2:] for s in table for r in s[2] if r[:2] == (order, leaves)]
        print(f"Order {order}, {'leaves' if leaves else 'does not leave'} D = 0: {sum(c[0] <= limit for c in cells)} of "
              f"{len(cells)} cells within {100 * limit:.0f} %, {sum(c[1] <= limit for c in cells)} as far as in phase.")


{"walks": walks, "zeros": zeros, "curves": curves}[WHAT]()
