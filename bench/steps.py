"""steps.py - this library from Python: a million steps a round, a thousand by one call of advance.

    python METHOD SPACE SYSTEM      SYSTEM as for dal.c, of bench/systems

Prints what bench.h says.  As in dal.c each thousand steps begin at the start.
"""
import os
import sys
import time

import dalembert

STEPS = 1000
CALLS = 1 if os.environ.get('BENCH_MS') == '0' else 1000
method, space, system = sys.argv[1:]
file = dalembert.System.from_file(f'bench/systems/{system}.yaml')
run = dalembert.Run(file, method, step=0.01, space=space)
start = run.state
best = float('inf')
for _ in range(5):
    begin = time.process_time_ns()
    for _ in range(CALLS):
        run.set_state(start, 0)
        run.advance(STEPS)
    best = min(best, (time.process_time_ns() - begin) / (CALLS * STEPS))
print(f'{best:.5g}', *(f'{x:.17g}' for x in run.state[:2 * run.system.n]))
