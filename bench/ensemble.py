"""ensemble.py - the speed of `dalembert ensemble`, as a share of the speed of its bare steps.

    ensemble.py PROGRAM PROGRAMS RESULTS     appends a section to RESULTS, for page.c

BENCH_MEMBERS members (a million) of system A, their starts drawn, take STEPS steps of RK4.  The bare
steps are taken by `dal compiled256` of PROGRAMS, a compiled batch, on each processor at once.  The
ensemble begins as a process and ends with all its files and its page; its compiled code is in the
cache.  Shares are medians of RUNS (3), by the clock on the wall and by the time of the processors,
which other work on the machine changes less.
"""
import json
import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time

LANES, STEPS, GOAL = 256, 1000, 0.6

program, programs, results = os.path.abspath(sys.argv[1]), sys.argv[2], sys.argv[3]
members = int(os.environ.get('BENCH_MEMBERS', '1000000'))
runs = int(os.environ.get('RUNS', '3'))
processors = len(os.sched_getaffinity(0))


def time_bare():
    """Seconds of a processor that the bare steps of all members take."""
    command = [os.path.join(programs, 'dal'), f'compiled{LANES}', 'rk4', 'physical', 'A']
    batches = [subprocess.Popen(command, stdout=subprocess.PIPE) for _ in range(processors)]
    nanoseconds = [float(batch.communicate()[0].split()[0]) for batch in batches]
    return 1e-9 * statistics.mean(nanoseconds) * members * STEPS


def time_ensemble(directory, count):
    """Seconds by the clock, and of the processors."""
    command = [program, 'ensemble', 'bench/systems/A.yaml', '--members', str(count), '--seed', '1',
               '--vary', "phi'=normal(0,0.1)", '--integrator', 'rk4', '--space', 'physical',
               '--step', '0.01', '--steps', str(STEPS), '--native', 'on', '--output', directory]
    before, begin = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after, end = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    used = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return end - begin, used


def write_case(file, name, what, shares):
    """A line of the results, and one of the table."""
    median = statistics.median(shares)
    json.dump({'case': name, 'what': what, 'a': 'dal', 'b': 'dalembert', 'median': median,
               'min': min(shares), 'max': max(shares), 'goal': f'>= {GOAL}',
               'met': median >= GOAL}, file)
    file.write('\n')
    print(f'{name:16} {what:52} {median:8.2f}  ({min(shares):.2f} to {max(shares):.2f})'
          f'  >= {GOAL} {"met" if median >= GOAL else "MISS"}')


by_clock, by_processor = [], []
with tempfile.TemporaryDirectory(dir=programs) as place:
    time_ensemble(os.path.join(place, 'compiled'), LANES)
    time_bare()
    for run in range(runs):
        bare = time_bare()
        clock, used = time_ensemble(os.path.join(place, str(run)), members)
        by_clock.append(bare / processors / clock)
        by_processor.append(bare / used)
with open(results, 'a', encoding='utf-8') as out:
    json.dump({'section': 'An ensemble, and its bare steps', 'unit': 'share of the bare speed',
               'figure': 'ratios',
               'text': f'The speed of dalembert ensemble with {members} members of A and {STEPS} steps of '
                       'RK4, as a share of the speed of a compiled batch, which only steps, on '
                       'all processors. The ensemble draws its starts, and writes all its files and '
                       'its page.'}, out)
    out.write('\n')
    write_case(out, 'ensemble-clock', f'{members} members, by the clock on the wall', by_clock)
    write_case(out, 'ensemble-cpu', f'{members} members, by the time of processors', by_processor)
