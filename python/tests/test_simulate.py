"""Runs in one call, and their pictures."""
import base64
import copy
import io
import re
import sys
import types
import xml.etree.ElementTree

import numpy as np
import pytest

import dalembert
from test_run import FALL

SLEIGH = 'chaplygin-sleigh'
# A blade that turns on the spot, drawn as half the turn of its coordinate.
BLADE = """
coordinates: [a]
parameters: {r: 2}
lagrangian: a'^2/2
start: {a': 1}
picture: {x: 1, y: r, angle: a/2, body: blade}
"""


def test_rows_of_the_program(program):
    run = dalembert.simulate(SLEIGH, 'gauss4+project', 3, step=0.03, samples=7)
    text = program('run', SLEIGH, '--integrator', 'gauss4+project', '--step', '0.03', '--time', '3', '--samples', '7')
    expected = np.genfromtxt(io.StringIO(text), delimiter=',', names=True, deletechars='', dtype=float)
    assert run.names == tuple(text.split('\n')[0].split(',')) and len(run) == 8
    for name, other in zip(run.names, expected.dtype.names):
        assert np.array_equal(run[name], expected[other]), name


def test_trends_and_parameters():
    """All steps count, not the rows alone; the sleigh runs in a circle of radius v0/omega."""
    run = dalembert.simulate(SLEIGH, 'gauss8', 10, step=0.1, samples=5, parameters={'omega': 0.5})
    trend = dalembert.trend(SLEIGH, 'gauss8', 10, step=0.1, parameters={'omega': 0.5})['D1']
    assert repr(run.trends['D1']) == repr(trend)
    assert run.parameters == {'m': 1, 'I': 1, 'v0': 1, 'omega': 0.5}
    assert run['y1'] == pytest.approx(2 * np.sin(run['t'] / 2), abs=1e-10)
    assert run.trends['D1'].count == 101


def test_defaults_and_observed():
    run = dalembert.simulate(SLEIGH, observe='abs(h1) + m')
    assert (run.integrator, run.step, len(run)) == ('gauss4+project', 0.1, 401) and run['t'][-1] == 20
    assert run['abs(h1) + m'] == pytest.approx(2, abs=1e-6) and 'abs(h1) + m' in run.trends
    with pytest.raises(dalembert.InputError, match="no column is named 'z'"):
        run['z']


def test_events():
    """A ball falls from height 1 in sqrt(2/g) and leaves with 0.8 of its speed."""
    ball = dalembert.System("coordinates: [y]\nlagrangian: y'^2/2 - 9.81*y\nstart: {y: 1}\n"
                            "events: [{when: y, direction: down, restitution: 0.8}]\n")
    run = dalembert.simulate(ball, 'gauss4', 1, step=0.01, space='physical')
    assert [event.t for event in run.events] == pytest.approx([np.sqrt(2 / 9.81)], rel=1e-12)
    assert run.events[0].state[1] == pytest.approx(0.8 * np.sqrt(2 * 9.81), rel=1e-12)


def test_failure():
    with pytest.raises(dalembert.StepError) as caught:
        dalembert.simulate(dalembert.System(FALL), 'gauss4', 2, step=0.01)
    partial = caught.value.partial
    assert 0 < len(partial) < 401 and partial.trends['H'].trend == 'aborted'


def test_backwards():
    run = dalembert.simulate(SLEIGH, 'gauss8', -5, step=-0.1)
    assert run['y1'][-1] == pytest.approx(-np.sin(5), abs=1e-10)
    assert run.svg()


def test_copies():
    run = dalembert.simulate(SLEIGH, time=1)
    other = copy.deepcopy(run)
    assert np.array_equal(other.rows, run.rows) and other.system is not run.system


# ---- pictures -----------------------------------------------------------------------------------

def test_pose_and_outline():
    run = dalembert.simulate(dalembert.System(BLADE), 'gauss4', np.pi, step=np.pi / 8, samples=8)
    pose = run.pose()
    assert pose['angle'] == pytest.approx(run['t'] / 2, abs=1e-12)
    assert set(pose['x']) == {1} and set(pose['y']) == {2} and not pose['steer'].any()
    # At the end it points up: half its length is 1, its tip 0.3 wide on both sides.
    shaft, tip = run.outlines({name: values[-1] for name, values in pose.items()}, 0.5)
    assert shaft == pytest.approx(np.array([[1, 1.5], [1, 2.5]]), abs=1e-12)
    assert tip == pytest.approx(np.array([[0.85, 2.25], [1, 2.5], [1.15, 2.25]]), abs=1e-12)


def test_pose_without_picture(oscillator):
    assert dalembert.simulate(oscillator, 'rk4', 1).pose() is None
    plane = dalembert.System("coordinates: [x1, x2]\nlagrangian: (x1'^2 + x2'^2)/2\nstart: {x1': 1}\n")
    pose = dalembert.simulate(plane, 'rk4', 1).pose()
    assert pose['x'] == pytest.approx(np.linspace(0, 1, 401)) and not pose['y'].any()


def parse_svg(text):
    return xml.etree.ElementTree.fromstring(text)


@pytest.mark.parametrize('system', ['snakeboard', 'falling-disk', SLEIGH])
def test_svg(system):
    """The body turns with the system: from its first angle to its last."""
    run = dalembert.simulate(system, 'gauss4', 2, step=0.01)
    root = parse_svg(run.svg(frames=10))
    style = next(element.text for element in root.iter() if element.tag.endswith('style'))
    body = re.search(r'@keyframes body{(.*)}\n', style)[1]
    angles = [float(angle) for angle in re.findall(r'rotate\(([-.\d]+)deg', body)]
    assert len(angles) == 11
    pose = run.pose()
    assert angles[0] == pytest.approx(-np.degrees(pose['angle'][0]), abs=0.06)
    assert angles[-1] == pytest.approx(-np.degrees(pose['angle'][-1]), abs=0.06)


def test_html(oscillator):
    run = dalembert.simulate(SLEIGH, time=5)
    text = run._repr_html_()
    picture = re.search(r'src="data:image/svg\+xml;base64,([^"]*)"', text)[1]
    assert parse_svg(base64.b64decode(picture)).tag.endswith('svg')
    assert len(text) < 60000 and '<th>D1</th>' in text and run.trends['D1'].size in text
    without = dalembert.simulate(oscillator, 'rk4', 1)._repr_html_()
    assert 'svg' not in without and '<th>E</th>' in without


def test_plot(pyplot):
    run = dalembert.simulate('snakeboard', time=3)
    path, drift = run.plot()
    assert np.array_equal(path.lines[0].get_xdata(), run.pose()['x'])
    assert drift.get_yscale() == 'log' and 'E' in [line.get_label() for line in drift.lines]
    axes = run.plot('x', "x'")
    assert [line.get_label() for line in axes.lines] == ['x', "x'"]
    assert np.array_equal(axes.lines[1].get_ydata(), run["x'"])
    assert run.plot('y', axes=axes) is axes and len(axes.lines) == 3
    with pytest.raises(dalembert.InputError, match="'q'"):
        run.plot('q')


def test_plot_without_place(pyplot, oscillator):
    run = dalembert.simulate(oscillator, 'rk4', 1)
    assert [line.get_label() for line in run.plot()[0].lines] == ['x']
    with pytest.raises(dalembert.InputError, match='^system: oscillator has no picture'):
        run.animate()


def test_animate(pyplot):
    run = dalembert.simulate(dalembert.System(BLADE), 'gauss4', np.pi, step=np.pi / 8)
    motion = run.animate(frames=3)
    motion._func(2)
    trail, shaft, tip = motion._fig.axes[0].lines[1:]
    assert shaft.get_xdata() == pytest.approx([1, 1]) and shaft.get_ydata()[1] > 2 > shaft.get_ydata()[0]
    motion._draw_was_started = True  # nothing is to be shown


def test_without_matplotlib(monkeypatch):
    monkeypatch.setitem(sys.modules, 'matplotlib', None)
    run = dalembert.simulate(SLEIGH, time=1)
    for draw in (run.plot, run.animate):
        with pytest.raises(ImportError, match='python3-matplotlib'):
            draw()
    assert 'svg' in run._repr_html_()


# ---- progress -----------------------------------------------------------------------------------

@pytest.fixture
def bars(monkeypatch):
    """A tqdm that keeps its bars."""
    made = []

    class Bar:
        def __init__(self, total, **_):
            self.total, self.n, self.open = total, 0, True
            made.append(self)

        def update(self, more):
            assert more >= 0
            self.n += more

        def close(self):
            self.open = False
    monkeypatch.setitem(sys.modules, 'tqdm', types.SimpleNamespace(tqdm=Bar))
    return made


def test_progress(bars):
    dalembert.simulate(SLEIGH, 'rk4', 100, step=0.01, progress=True)
    assert len(bars) == 1 and bars[0].total == 100 and not bars[0].open
    assert 80 < bars[0].n <= 100
    dalembert.simulate(SLEIGH, 'rk4', 1, progress=False)
    assert len(bars) == 1


def test_progress_of_a_failure(bars):
    with pytest.raises(dalembert.StepError):
        dalembert.simulate(dalembert.System(FALL), 'gauss4', 2, step=0.01, progress=True)
    assert not bars[0].open


def test_without_tqdm(monkeypatch):
    monkeypatch.setitem(sys.modules, 'tqdm', None)
    assert len(dalembert.simulate(SLEIGH, 'rk4', 1, progress=True)) == 401
