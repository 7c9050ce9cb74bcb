"""steps.py - this library from Python, as dal.c has it: a thousand steps from the start by one call.

    python METHOD SPACE SYSTEM      SYSTEM of bench/systems

Prints and times as bench.h says, in rounds of the same length.
"""
import os
import sys
import time

import dalembert

STEPS = 1000


def work():
    """Nanoseconds that a thousand steps take."""
    begin = time.process_time_ns()
    run.set_state(start, 0)
    run.advance(STEPS)
    return time.process_time_ns() - begin


method, space, system = sys.argv[1:]
file = dalembert.System.from_file(f'bench/systems/{system}.yaml')
run = dalembert.Run(file, method, step=0.01, space=space)
start = run.state
work()
repeats = 1 + int(1e6 * float(os.environ.get('BENCH_MS', '20')) / work())
best = min(sum(work() for _ in range(repeats)) / (repeats * STEPS) for _ in range(5))
print(f'{best:.5g}', *(f'{x:.17g}' for x in run.state[:2 * run.system.n]))
