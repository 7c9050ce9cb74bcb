"""native_auto.py - whether `--native auto` ever loses: 40 (system, method, length), the cache cold.

    native_auto.py PROGRAM [REPEAT]          REPEAT processes of each, 3
    native_auto.py --few PROGRAM RESULTS     few cases, which it appends to RESULTS, for page.c

Seconds by the clock on the wall, the least of each kind: interpreted (off), compiled beforehand
(on) with an empty cache and with a full one (warm), and by auto with an empty one and a full one.
Missed: auto takes more than 1.05 times the better of off and on, or with a full cache 1.05 times off;
or, where off takes more than ten times as long as the compiler, more than 1.15 times warm.  A compiler beside a run has a processor of
its own here: measure with two that have nothing else to do.
"""
import itertools
import json
import os
import subprocess
import sys
import tempfile
import time

CASES = [  # system, method, step
    ('chaplygin-sleigh', 'rk4', 0.01),
    ('chaplygin-sleigh', 'gauss4', 0.01),
    ('chaplygin-sleigh', 'gauss12', 0.05),
    ('bench/systems/P4.yaml', 'gauss4', 0.001),
    ('falling-disk', 'gauss4', 0.001),
    ('nonholonomic-particle', 'stormer-verlet', 0.01),
    ('contact-oscillator', 'gauss4+project', 0.01),
    ('chaotic-oscillators', 'implicit-midpoint', 0.01),
]
LENGTHS = [0.05, 0.3, 1.0, 4.0, 15.0]  # seconds interpreted
FEW_CASES, FEW_LENGTHS = [CASES[0], CASES[3]], [0.1, 0.7, 5.0]
MEASURED_STEPS, FEW_STEPS = 20000, 10

few = sys.argv[1] == '--few'
program = os.path.abspath(sys.argv[2 if few else 1])
results = open(sys.argv[3], 'a', encoding='utf-8') if few else None
repeat = int(sys.argv[2]) if len(sys.argv) > 2 and not few else 2 if few else 3


def run(case, steps, mode, cache):
    """Seconds that a run takes."""
    system, method, step = case
    command = [program, 'run', system, '--integrator', method, '--step', str(step), '--time',
               repr(steps * step), '--samples', '100', '--native', mode, '--output', '/dev/stdout']
    begin = time.monotonic()
    subprocess.run(command, env=dict(os.environ, XDG_CACHE_HOME=cache), check=True,
                   stdout=subprocess.DEVNULL)
    return time.monotonic() - begin


def least(case, steps, mode, warm=False):
    """The least of several runs, each with a cache of its own."""
    times = []
    for _ in range(repeat):
        with tempfile.TemporaryDirectory() as cache:
            if warm:
                run(case, FEW_STEPS, 'on', cache)
            times.append(run(case, steps, mode, cache))
    return min(times)


def measure(case, length):
    """Prints the row of a case that takes about this long interpreted; whether it missed."""
    short = least(case, FEW_STEPS, 'off')
    compiling = least(case, FEW_STEPS, 'on') - short
    per_step = max(least(case, MEASURED_STEPS, 'off') - short, 1e-4) / MEASURED_STEPS
    steps = int(length / per_step)
    off, on, auto = (least(case, steps, mode) for mode in ('off', 'on', 'auto'))
    warm, auto_warm = (least(case, steps, mode, warm=True) for mode in ('on', 'auto'))
    if few:
        json.dump({'system': case[0], 'method': case[1], 'steps': steps, 'off': off, 'on': on,
                   'warm': warm, 'auto': auto, 'auto_warm': auto_warm},
                  results)
        results.write('\n')
    is_long = off > 10 * compiling
    missed = auto > 1.05 * min(off, on) or auto_warm > 1.05 * off or (is_long and auto > 1.15 * warm)
    print(f'{case[0]:22} {case[1]:17} {compiling:8.2f} {off:7.2f} {on:7.2f} {warm:7.2f} {auto:7.2f}'
          f' {auto_warm:9.2f} {auto / min(off, on):7.2f} {auto / warm if is_long else float("nan"):7.2f}'
          f'{"  missed" if missed else ""}', flush=True)
    return missed


rows = list(itertools.product(*((FEW_CASES, FEW_LENGTHS) if few else (CASES, LENGTHS))))
if few:
    json.dump({'section': 'Runs of the program, interpreted and compiled', 'figure': 'runs',
               'text': 'Seconds by the clock on the wall that dalembert run takes from its start to its '
                       'end, with --native off, on and auto, the compiler included where the cache is '
                       'empty. Each is the least of two.'}, results)
    results.write('\n')
print(f'{"system":22} {"method":17} compiler     off      on    warm    auto auto+warm /better   /warm')
missed = sum(measure(*row) for row in rows)
print(f'{missed} of {len(rows)} missed')
