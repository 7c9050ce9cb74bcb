"""Events of runs, against closed forms."""
import io

import numpy as np
import pytest

import dalembert

G, C = 9.81, 0.8
BALL = """
coordinates: [y]
parameters: {g: 9.81, c: 0.8}
lagrangian: y'^2/2 - g*y
start: {y: 1}
events:
  - {when: y, direction: down, restitution: c}
"""


@pytest.fixture
def ball():
    """Bounces at t_1 (1 + 2 c (1 - c^k)/(1 - c)), t_1 = sqrt(2/g)."""
    return dalembert.System(BALL, 'ball')


def bounce(k):
    return np.sqrt(2 / G) * (1 + 2 * C * (1 - C ** k) / (1 - C))


def speed(k):
    """After bounce k."""
    return C ** (k + 1) * np.sqrt(2 * G)


def test_closed_form(ball):
    assert ball.events == ('event 1 (y)',)
    run = dalembert.Run(ball, 'gauss4', step=0.01, space='physical')
    assert run.event_counts == (0,) and run.stopped is None
    first, rest = run.events(1.5), run.events(3)
    assert len(first) == 2 and run.event_counts == (6,)
    for k, event in enumerate(first + rest):
        assert (event.event, event.name, event.direction) == (0, 'event 1 (y)', -1)
        assert event.t == pytest.approx(bounce(k), abs=1e-12)
        assert event.before == pytest.approx([0, -speed(k) / C], abs=1e-12)
        assert event.state == pytest.approx([0, speed(k)], abs=1e-12)
    energy = run.observable_names.index('E')
    assert run.jumps[energy] == pytest.approx(G * (C ** 12 - 1), abs=1e-11)
    assert run.observables[energy] - run.jumps[energy] == pytest.approx(G, abs=1e-11)


@pytest.mark.parametrize('step', [0.01, -0.01])
def test_rows_of_the_program(ball, program, tmp_path, step):
    """Rows and events have the bits of `dalembert run`."""
    path, log = tmp_path / 'ball.yaml', tmp_path / 'events.csv'
    path.write_text(BALL)
    text = program('run', str(path), '--integrator', 'gauss4', '--step', str(step), '--time', str(200 * step),
                   '--samples', '7', '--events', str(log))
    expected = np.genfromtxt(io.StringIO(text), delimiter=',', names=True, deletechars='', dtype=float)
    rows = dalembert.Run(ball, 'gauss4', step=step).trajectory(expected['t'])
    assert np.array_equal(rows["y'"], expected["y'"]) and np.array_equal(rows['E'], expected['E'])
    events = dalembert.Run(ball, 'gauss4', step=step).events(200 * step)
    table = np.loadtxt(log, delimiter=',', skiprows=1)
    assert np.array_equal(table, [[e.t, e.event + 1, *e.state] for e in events])
    assert len(events) == 3


def test_stop():
    """x = t is 1.25 between two steps and two rows."""
    system = dalembert.System("coordinates: [x]\nlagrangian: x'^2/2\nstart: {x': 1}\n"
                              "events: [{when: x - 1, set: {x': 1}}, {when: x - 1.25, stop: true}]\n")
    make = lambda: dalembert.Run(system, 'rk4', step=0.1, space='physical')
    runs = [make() for _ in range(3)]
    runs[0].advance(100)
    rows = runs[1].trajectory(np.linspace(0, 3, 31))
    events = runs[2].events(3)
    assert [e.event for e in events] == [0, 1]
    assert len(rows) == 14 and rows['t'][-1] == pytest.approx(1.25, abs=1e-14)
    for run in runs:
        assert run.stopped == 1 and run.event_counts == (1, 1)
        assert run.time == pytest.approx(1.25, abs=1e-14) and run.state == pytest.approx([1.25, 1])
        other = make()
        other.restore(run.save())
        for again in run.advance, other.advance, lambda: run.trajectory([2.0]), lambda: run.events(3):
            with pytest.raises(dalembert.StepError, match='event 2 .* stopped the run at t = 1.25') as caught:
                again()
            assert caught.value.status == 'DAL_STOPPED'
    assert dalembert.trend(system, 'rk4', 3, step=0.1)['E'].trend in ('none', 'undecided')


def test_endless(ball):
    """Bounces accumulate at t_1 (1 + c)/(1 - c)."""
    run = dalembert.Run(ball, 'gauss4', step=0.01, parameters={'c': 0.5})
    with pytest.raises(dalembert.StepError, match='happens infinitely often') as caught:
        run.events(3)
    assert caught.value.status == 'DAL_EVENT' and len(caught.value.partial) == run.event_counts[0] > 10
    assert caught.value.partial[-1].t == pytest.approx(3 * np.sqrt(2 / G), abs=1e-7)
    for again in run.advance, lambda: run.trajectory([3.0]):
        with pytest.raises(dalembert.StepError, match='happens infinitely often'):
            again()


def test_trend_without_jumps(ball):
    """Impacts take energy; the method keeps it between them."""
    found = dalembert.trend(ball, 'gauss4', 2, step=0.01)['E']
    assert found.deviation < 1e-12 and found.size == 'rounding'


def test_refused(ball):
    for measure in (lambda: dalembert.Batch(ball, 'rk4', 3), lambda: dalembert.order(ball, 'rk4', 1),
                    lambda: dalembert.lyapunov(ball, 'rk4', 1), lambda: dalembert.generate(ball, 'rk4'),
                    lambda: dalembert.section(ball, 'y', 'rk4', 1), lambda: dalembert.explain(ball, 'rk4', 1)):
        with pytest.raises(dalembert.InputError, match='ball has events: .* would pass over them') as caught:
            measure()
        assert caught.value.status == 'DAL_UNSUPPORTED'
    with pytest.raises(dalembert.InputError, match='p = pi = 0 only'):
        dalembert.Run(ball, 'rk4', start={'pi_y': 1}).advance()
