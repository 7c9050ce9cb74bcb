"""Measurements against closed forms and theory."""
import signal

import numpy as np
import pytest

import dalembert

SKATE = """
coordinates: [x, y, phi]
parameters: {m: 1, J: 1, k: 1}
lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 - k/2*(x^2 + y^2)
constraints: [x'*sin(phi) - y'*cos(phi)]
start: {x: 1, x': 0.5, phi': 0.7}
"""
SADDLE = """
coordinates: [x]
accelerations: {x: x}
"""


def test_trend(oscillator):
    """rk4 takes E of an oscillator away as -h^5/72 E in unit time; a symmetric method does not."""
    e = dalembert.trend(oscillator, 'rk4', 100, step=0.1, space='physical')['E']
    assert (e.size, e.trend, e.conservation) == ('larger', 'linear', 'conserved')
    assert e.rate == pytest.approx(-0.5 * 0.1 ** 5 / 72, rel=0.02)
    assert e.rate_low <= e.rate <= e.rate_high and e.count == 1001
    gauss = dalembert.trend(oscillator, 'gauss4', 100, step=0.1, every=10)['E']
    assert gauss.size in ('rounding', 'exact') and gauss.count == 101


def test_trend_of_a_constraint():
    skate = dalembert.System(SKATE)
    drifts = dalembert.trend(skate, 'rk4', 200, step=0.05)
    kept = dalembert.trend(skate, 'gauss4+project', 200, step=0.05)
    assert drifts['D1'].size == 'larger' and kept['D1'].size == 'rounding'
    assert drifts['D1'].deviation > 1e3 * kept['D1'].deviation


def test_trend_of_a_failure():
    from test_run import FALL
    with pytest.raises(dalembert.StepError) as caught:
        dalembert.trend(dalembert.System(FALL), 'gauss4', 2, step=0.01)
    assert caught.value.partial['H'].trend == 'aborted'


@pytest.mark.parametrize('method, stated', [('rk4', 4), ('implicit-midpoint', 2), ('gauss6', 6)])
def test_order(oscillator, method, stated):
    exact = [np.cos(2), -np.sin(2)]
    found = dalembert.order(oscillator, method, 2, step=0.5, levels=5, reference=exact, space='physical')
    assert found.order == pytest.approx(stated, abs=0.1)
    assert np.array_equal(found.step, 0.5 / 2.0 ** np.arange(5))
    assert np.all(np.diff(found.error) < 0) and np.isnan(found.slope[0])
    other = dalembert.order(oscillator, method, 2, step=0.5, levels=5, space='physical')
    assert other.error == pytest.approx(found.error, abs=1e-13)
    wrong = dalembert.order(oscillator, method, 2, step=0.5, reference=[0, 0], space='physical')
    assert wrong.error[-1] == pytest.approx(np.sin(2), abs=0.01)
    rough = dalembert.order(oscillator, method, 2, step=0.5, levels=2, reference='symplectic-euler')
    assert 1e-2 < rough.error[1] < 1
    right = dalembert.order(oscillator, method, 2, step=0.5, reference='gauss8')
    assert right.order == pytest.approx(stated, abs=0.1)


def test_bad_order(oscillator):
    for arguments in ({'levels': 1}, {'reference': [1, 2, 3]}, {'reference': 'none'}, {'time': 2.01}):
        with pytest.raises(dalembert.InputError):
            dalembert.order(oscillator, 'rk4', **{'time': 2, 'step': 0.5, **arguments})


def test_lyapunov():
    """x'' = x has the exponents 1 and -1, x'' = x - x'/2 (-1 +- sqrt(17))/4."""
    found = dalembert.lyapunov(dalembert.System(SADDLE), 'gauss8', 20, step=0.1, transient=20)
    assert [e.mean for e in found.exponents] == pytest.approx([1, -1], abs=1e-8)
    assert found.is_exact and found.holds and found.sum.mean == pytest.approx(0, abs=1e-10)
    damped = dalembert.System('coordinates: [x]\naccelerations: {x: "x - x\'/2"}\n')
    first = dalembert.lyapunov(damped, 'gauss8', 40, step=0.1, transient=20, count=1)
    assert first.exponents[0].mean == pytest.approx((17 ** 0.5 - 1) / 4, abs=1e-8)
    assert len(first.exponents) == 1 and first.holds is None
    assert first.divergence.mean == pytest.approx(-0.5)
    lift = dalembert.lyapunov(damped, 'gauss8', 40, step=0.1, transient=80, space='lifted')
    pair = [(17 ** 0.5 - 1) / 4, (17 ** 0.5 + 1) / 4]
    assert [e.mean for e in lift.exponents] == pytest.approx([pair[1], pair[0], -pair[0], -pair[1]], abs=1e-8)
    assert lift.holds and lift.sum.mean == pytest.approx(0, abs=1e-10)


def test_section(oscillator):
    """cos t = 0 at pi/2 + k pi, downwards first."""
    found = dalembert.section(oscillator, 'x', 'gauss12', 20, step=0.1)
    rows = found.rows
    assert (found.up, found.down, found.touches, found.unresolved) == (3, 3, 0, 0)
    assert rows['t'] == pytest.approx(np.pi * (np.arange(6) + 0.5), abs=1e-11)
    assert list(rows['direction']) == [-1, 1] * 3 and np.abs(rows['x']).max() < 1e-13
    up = dalembert.section(oscillator, 'x = 0', 'gauss12', 20, step=0.1, direction=1)
    assert np.array_equal(up.rows['t'], rows['t'][1::2]) and up.down == 3
    half = dalembert.section(oscillator, 'x = k/2', 'gauss12', 6, step=0.1)
    assert half.rows['t'] == pytest.approx([np.pi / 3, 5 * np.pi / 3], abs=1e-11)
    assert len(dalembert.section(oscillator, 'x - 2', 'gauss12', 20, step=0.1).rows) == 0


@pytest.mark.parametrize('formula, column', [('z', 1), ('x + z', 5), ('x = z', 5), ('x + z = 1', 5),
                                             ('x*x = 1 + z', 11)])
def test_place_in_a_section(oscillator, formula, column):
    with pytest.raises(dalembert.InputError, match="'z'") as caught:
        dalembert.section(oscillator, formula, 'rk4', 20)
    assert (caught.value.line, caught.value.column) == (1, column)


def test_explain(oscillator):
    """The drift of rk4 at a large step is truncation."""
    shares = dalembert.explain(oscillator, 'rk4', 100, step=0.1, quad_steps=200)['E']
    assert shares.share['truncation'] == pytest.approx(1, abs=1e-6)
    assert abs(shares.share['rounding']) < 1e-6 and shares.trend.trend == 'linear'
    assert shares.how['truncation'] and not shares.is_motion and shares.is_conserved
    assert shares.sentence.startswith('drifts by truncation (100 %): halve the step and it falls by ')
    assert sum(shares.share[name] for name in ('truncation', 'coefficients', 'solver', 'rounding')
               ) == pytest.approx(1)


def test_generate(program):
    text = dalembert.generate('chaplygin-sleigh', 'gauss4+project', prefix='sleigh')
    assert text == program('generate', 'chaplygin-sleigh', '--integrator', 'gauss4+project',
                           '--prefix', 'sleigh')
    assert 'rk4_advance' in dalembert.generate('falling-disk', 'rk4', lanes=4, prefix='rk4')
    text = dalembert.generate('chaplygin-sleigh', 'rk4', prefix='sleigh', field=True)
    assert text == program('generate', 'chaplygin-sleigh', '--integrator', 'rk4', '--prefix', 'sleigh', '--with', 'field')
    assert 'int sleigh_jacobian(' in text
    for arguments in ({'prefix': '1'}, {'lanes': 3}):
        with pytest.raises(dalembert.InputError):
            dalembert.generate('chaplygin-sleigh', 'rk4', **arguments)


def test_dirac():
    sleigh = dalembert.dirac('chaplygin-sleigh')
    assert (sleigh.is_complete, sleigh.dimensions, sleigh.dimension) == (True, 20, 6)
    assert (sleigh.first_class, sleigh.second_class, sleigh.stages) == (7, 6, 3)
    assert sleigh.multipliers['mu_e'] is None and sleigh.multipliers['mu_phi'] == "phi'"
    assert [c.formula for c in sleigh.constraints if c.stage == 1] == ['pi_y1', 'pi_y2', 'pi_phi']
    assert {c.source for c in sleigh.constraints if c.stage == 1} == {'pi_e'}
    assert [s[2] for s in sleigh.steps if s[1] == 'pi_e'] == ['irregular']
    assert sleigh.brackets['y1', 'p_y1'] == '1' and ('y1', 'y2') not in sleigh.brackets
    vakonomic = dalembert.dirac('chaplygin-sleigh-vakonomic', parameters={'m': 2})
    assert (vakonomic.first_class, vakonomic.second_class, vakonomic.gauge) == (0, 14, {})


def test_action():
    """x'' = a: at rest the action is a^2/2 T; the motion has none, and is stationary for its own method."""
    pushed = dalembert.System("coordinates: [x]\naccelerations: {x: a}\nparameters: {a: 0.5}\n")
    t = np.cumsum(np.linspace(0.5, 1.5, 9))
    rest = dalembert.action(pushed, {'t': t, 'x': np.full(9, 3)})
    assert rest.value['nh10'] == pytest.approx(0.5**2/2*(t[-1] - t[0]), rel=1e-12)
    assert set(rest.value) == {'nh10', 'nh11', 'nh23'} and rest.discrete == {} and rest.max_constraint == 0
    fallen = dalembert.action(pushed, {'t': t, 'x': t**2}, parameters={'a': 2})
    assert abs(fallen.value['nh10']) < 1e-20
    run = dalembert.simulate('chaplygin-sleigh', 'gauss8', 5, step=0.05, samples=100)
    curve = {name: run[name] for name in ('t', 'y1', 'y2', 'phi', "y1'", "y2'", "phi'")}
    sleigh = dalembert.action('chaplygin-sleigh', curve, methods=['gauss8', 'gauss4'])
    assert sleigh.value['nh10'] < 1e-6 and sleigh.max_constraint < 1e-4
    assert sleigh.discrete['gauss8'].is_stationary and not sleigh.discrete['gauss4'].is_stationary
    assert sleigh.discrete['gauss8'].defect < 1e-12 < sleigh.discrete['gauss4'].defect
    bent = dalembert.action('chaplygin-sleigh', {**curve, 'y1': curve['y1'] + 0.01*np.sin(curve['t'])})
    assert bent.value['nh10'] > 1e-5
    for wrong, message in (({'x': t}, 'it has no times t'), ({'t': t}, "no column 'x'"),
                           ({'t': t, 'x': t[1:]}, 'other lengths'), ({'t': t[:3], 'x': t[:3]}, 'rows')):
        with pytest.raises(dalembert.InputError, match=message):
            dalembert.action(pushed, wrong)
    with pytest.raises(dalembert.InputError, match='no velocities'):
        dalembert.action(pushed, {'t': t, 'x': t}, methods=['gauss4'])
    with pytest.raises(dalembert.InputError, match='different distances'):
        dalembert.action(pushed, {'t': t, 'x': t, "x'": t}, methods=['gauss4'])


def test_invariants():
    """Two oscillators of one frequency conserve four quadratic forms; with friction they conserve none."""
    text = """
coordinates: [x, y]
parameters: {k: 2, c: 2, f: 0}
lagrangian: (x'^2 + y'^2 - k*x^2 - c*y^2)/2
forces: {x: -f*x', y: -f*y'}
start: {x: 1, y': 1}
"""
    pair = dalembert.System(text)
    found = dalembert.invariants(pair, measure=True)
    formulas = [i.formula for i in found.invariants]
    assert len(formulas) == 4 and "x*y' - y*x'" in formulas and found.independent == 3
    assert found.atoms == ('x', 'y', "x'", "y'") and found.products == found.functions == 14
    assert all(i.exact for i in found.invariants) and found.largest_zero < 1e-12 < found.least_change
    assert found.measure == dalembert.Measure('1', 1.0, True, False)  # f is not 0 in general
    other = dalembert.invariants(pair, parameters={'c': 3})
    assert {i.formula for i in other.invariants} == {"k*x^2 + x'^2", "c*y^2 + y'^2"}
    assert other.measure is None and [i.is_new for i in other.invariants] == [True, False]
    assert dalembert.invariants(pair, parameters={'f': 0.5}).invariants == ()


def test_factors_of_invariants():
    kepler = dalembert.System("coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + 1/hypot(x, y)\n"
                              "start: {x: 1, y': 1}\n")
    assert len(dalembert.invariants(kepler).invariants) == 1
    assert len(dalembert.invariants(kepler, factors=['1/hypot(x, y)']).invariants) == 2
    with pytest.raises(dalembert.InputError, match="'z'") as caught:
        dalembert.invariants(kepler, factors=['x', '2*z'])
    assert (caught.value.line, caught.value.column) == (2, 3)
    with pytest.raises(dalembert.InputError, match='degree'):
        dalembert.invariants(kepler, 0)
    with pytest.raises(dalembert.InputError, match='factors'):
        dalembert.invariants(kepler, factors=[1])


def test_predict():
    # rk4 multiplies the E of x'' = -x by |R(ih)|^2 = 1 - h^6/72 + h^8/576 in each step.
    oscillator = dalembert.System("coordinates: [x]\nlagrangian: (x'^2 - x^2)/2\nstart: {x: 1}\n")
    change = 0.5 * (-0.25 ** 6 / 72 + 0.25 ** 8 / 576)
    ahead = dalembert.predict(oscillator, 'rk4', 50, step=0.25, samples=10)
    energy = ahead.observables['E']
    assert energy.is_conserved and not energy.is_zero and not ahead.leaves_D and ahead.reason == 'time'
    assert np.allclose(ahead.t, np.linspace(0, 50, 11)) and ahead.end == 50
    assert np.allclose(energy.curve, change * np.arange(0, 201, 20), rtol=1e-8, atol=0)
    assert abs(energy.rate / (change / 0.25) - 1) < 1e-8 and np.isnan(energy.walk)
    pieces = dalembert.predict(oscillator, 'rk4', 2, step=0.25, pieces=6)
    assert pieces.pieces == 6 and abs(pieces.observables['E'].walk) < 1e-20
    with pytest.raises(dalembert.Error, match='multipliers pass from step to step'):
        dalembert.predict('heisenberg', 'gni', 1, step=0.05)
    both = dalembert.predict(oscillator, ['rk4', 'gni'], 50, step=[0.25, 0.125], samples=10)
    assert list(both) == [('rk4', 0.25), ('rk4', 0.125), ('gni', 0.25), ('gni', 0.125)]
    assert np.array_equal(both['rk4', 0.25].observables['E'].curve, energy.curve)
    half = 0.5 * (-0.125 ** 6 / 72 + 0.125 ** 8 / 576)
    assert abs(both['rk4', 0.125].observables['E'].change / (400 * half) - 1) < 1e-8
    assert 'multipliers' in both['gni', 0.25].message
    assert list(dalembert.predict(oscillator, 'rk4', 1, step=[0.5])) == [('rk4', 0.5)]
    with pytest.raises(dalembert.InputError, match='step: the list is empty'):
        dalembert.predict(oscillator, 'rk4', 1, step=[])
    with pytest.raises(dalembert.InputError, match='samples'):
        dalembert.predict(oscillator, 'rk4', 1, step=0.25, samples=0)


def test_sensitivities():
    """Of x'' = k from x = a^2: x = a^2 + x' t + k t^2/2."""
    fall = dalembert.System('''coordinates: [x]
parameters: {k: 2, a: 1}
accelerations: {x: k}
start: {x: a^2}
''')
    found = dalembert.sensitivities(fall, ['k', 'a', "x'"], 'rk4', 2, step=0.125, samples=5)
    t = found.t
    assert found.components[:2] == ('x', "x'") and np.allclose(t, np.linspace(0, 2, 6))
    assert np.allclose(found.columns['k'][:, :2], np.stack([t ** 2 / 2, t], axis=1))
    assert np.allclose(found.columns['a'][:, :2], [2, 0])
    assert np.allclose(found.columns["x'"][:, :2], np.stack([t, np.ones(6)], axis=1))
    lifted = dalembert.sensitivities(fall, ['pi_x'], 'rk4', 2, step=0.125, space='lifted', start={'e': 2})
    assert abs(lifted.columns['pi_x'][-1, 0] - 1) < 1e-12
    with pytest.raises(dalembert.InputError, match='a tolerance divides its step'):
        dalembert.sensitivities(fall, ['k'], 'taylor', 1, step=0.1, tolerance=1e-9)
    with pytest.raises(dalembert.InputError, match='names'):
        dalembert.sensitivities(fall, 'k', 'rk4', 1, step=0.1)


def test_steer():
    """x'' = u, e = 2, from rest to rest by d in T: S = 6 e d^2/T^3, x = d (3 s^2 - 2 s^3)."""
    cart = dalembert.System("coordinates: [x]\nlagrangian: x'^2/2\ngauge: {e: 2}\nstart: {x: 0.5}\n")
    found = cart.steer({'x': 1.2}, 'gauss4', 2, step=0.125, rest=True)
    best, motion = found.best, found.best.motion
    assert best.S == pytest.approx(12 * 0.7 ** 2 / 8, abs=1e-13) and best.message == '' and found.extremals == (best,)
    s = motion['t'] / 2
    assert np.allclose(motion['t'], np.linspace(0, 2, 17))
    assert np.allclose(motion['x'], 0.5 + 0.7 * (3 * s ** 2 - 2 * s ** 3), rtol=0, atol=1e-13)
    assert motion['pi_e'][-1] * 2 == pytest.approx(best.S) and (best.rank, found.allowed) == (2, 2)
    assert best.conjugate_times == 0 and np.isnan(best.first_conjugate) and found.growth == ()
    freed = cart.steer({'x': 1.2}, 'gauss4', 2, step=0.125, free=["x'"])
    assert freed.best.motion["x'"] == pytest.approx(0.35) and freed.best.conjugate_times is None
    ball = dalembert.System("coordinates: [x]\nparameters: {g: 9}\nlagrangian: x'^2/2 - g*x\n")
    aimed = ball.steer({'x': 3}, 'gauss4', 1, step=0.125, aim=True, parameters={'g': 4}, start_time=-1)
    assert aimed.best.motion["x'"][0] == pytest.approx(5.5) and aimed.best.motion.parameters == {'g': 4}
    assert aimed.best.S == 0 and aimed.best.rank is None and aimed.best.motion['t'][0] == -1
    rod = dalembert.System("coordinates: [x, y, phi]\nlagrangian: phi'^2/2\n"
                           "constraints: [x' - cos(phi), y' - sin(phi)]\nmechanics: vakonomic\n")
    ring = rod.steer({'x': 0, 'y': 0, 'phi': 2 * np.pi}, 'gauss8', 1, step=0.02)
    assert ring.best.S == pytest.approx(2 * np.pi ** 2) and abs(ring.best.motion['g1']).max() < 1e-9
    with pytest.raises(dalembert.InputError, match="'z' is no coordinate"):
        cart.steer({'z': 1}, 'gauss4', 1, step=0.125)
    with pytest.raises(dalembert.InputError, match='free'):
        cart.steer({'x': 1}, 'gauss4', 1, step=0.125, free="x'")


def test_steer_not_found():
    """The nearest motion is kept; a signal keeps those that are found."""
    sleigh = dalembert.System('''coordinates: [x, y, phi]
lagrangian: (x'^2 + y'^2 + phi'^2)/2
constraints: [x'*sin(phi) - y'*cos(phi)]
''').with_effort('constraint')
    target = {'x': 0, 'y': 1, 'phi': 0}
    with pytest.raises(dalembert.StepError, match='no motion was found in 2 iterations') as caught:
        sleigh.steer(target, 'gauss4', 2, step=0.1, rest=True, max_iterations=2)
    nearest = caught.value.partial
    assert nearest.growth == (2, 3) and nearest.best.residual > 1e-3 and len(nearest.best.motion) == 21

    def handler(number, frame):
        raise KeyboardInterrupt
    before = signal.signal(signal.SIGALRM, handler)
    try:
        with pytest.raises(KeyboardInterrupt) as ended:
            signal.setitimer(signal.ITIMER_REAL, 0.5)
            sleigh.steer({'x': 1, 'y': 0, 'phi': 0}, 'gauss4', 2, step=0.1, rest=True, starts=10000)
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)
    assert ended.value.partial.best.S == pytest.approx(6 / 8)
