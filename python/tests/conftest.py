"""The systems of the tests, whose motions have closed forms."""
import os
import subprocess

import pytest

import dalembert

OSCILLATOR = """
coordinates: [x]
parameters: {k: 1}
lagrangian: (x'^2 - k*x^2)/2
start: {x: 1}
"""


@pytest.fixture
def oscillator():
    """x = cos(sqrt(k) t)."""
    return dalembert.System(OSCILLATOR, 'oscillator')


@pytest.fixture
def program():
    """Runs the program of the same build and returns its output."""
    def run(*arguments):
        return subprocess.run([os.environ['DALEMBERT_PROGRAM'], *arguments], check=True, text=True,
                              stdout=subprocess.PIPE).stdout
    if 'DALEMBERT_PROGRAM' not in os.environ:
        pytest.skip('DALEMBERT_PROGRAM names no program to compare with')
    return run


@pytest.fixture
def pyplot():
    """matplotlib.pyplot, drawing into memory; where CI is true it must be there."""
    if os.environ.get('CI') != 'true':
        pytest.importorskip('matplotlib')
    import matplotlib
    matplotlib.use('Agg')
    from matplotlib import pyplot as plotting
    yield plotting
    plotting.close('all')
