"""Models as functions of points, against formulas by hand."""
import numpy as np
import pytest

import dalembert

# A mass matrix that depends on q; F by hand from d/dt (r^2 a') = -k r^2 sin a - c a', r = 2 + cos a:
#   W = r^2,  r^2 a'' - r sin(a) a'^2 = -k r^2 sin a - c a'
HAND = """
coordinates: [a]
parameters: {k: 3, c: 0.5}
let: {r: 2 + cos(a)}
lagrangian: r^2*a'^2/2
forces: {a: -k*r^2*sin(a) - c*a' + t}
"""
# The blade is at a distance a from the centre of mass, so that W^-1 A^T is no multiple of A^T.
SLEIGH = """
coordinates: [x, y, phi]
parameters: {m: 2, J: 5, a: 0.5}
lagrangian: m/2*(x'^2 + y'^2) + J/2*phi'^2 - m*y
constraints: [x'*sin(phi) - y'*cos(phi) + a*phi']
"""


def force(a, da, t=0, k=3, c=0.5):
    r = 2 + np.cos(a)
    return (-k * r**2 * np.sin(a) - c * da + t + r * np.sin(a) * da**2) / r**2


def test_field():
    system = dalembert.System(HAND)
    a, da = np.linspace(-3, 3, 7)[:, None], np.linspace(-2, 2, 5)
    q, v = np.broadcast_arrays(a, da)
    found = system.field(q[..., None], v[..., None])
    assert found.shape == (7, 5, 1)
    assert found[..., 0] == pytest.approx(force(a, da), rel=1e-13)
    assert system.field([1], [2], 3, parameters={'k': -1})[0] == pytest.approx(force(1, 2, 3, k=-1), rel=1e-13)
    times = system.field([1.0], [2.0], [0, 1, 2])
    assert times.shape == (3, 1) and times[:, 0] == pytest.approx(force(1, 2, np.arange(3)), rel=1e-13)


def test_jacobian():
    """Against differences of the formula by hand."""
    system = dalembert.System(HAND)
    d = 1e-5
    found = system.jacobian([[0.4], [1.3]], [[-1], [2]])
    assert found.shape == (2, 1, 2)
    for values, a, da in zip(found, (0.4, 1.3), (-1, 2)):
        by_q = (force(a + d, da) - force(a - d, da)) / (2 * d)
        by_v = (force(a, da + d) - force(a, da - d)) / (2 * d)
        assert values[0] == pytest.approx([by_q, by_v], rel=1e-8)


def test_energy():
    system = dalembert.System(SLEIGH)
    q, v = np.random.default_rng(1).normal(size=(2, 4, 3))
    assert system.energy(q, v) == pytest.approx(v[:, 0]**2 + v[:, 1]**2 + 2.5 * v[:, 2]**2 + 2 * q[:, 1])
    gradient = system.energy_gradient(q, v)
    assert gradient == pytest.approx(np.stack([0 * q[:, 0], 0 * q[:, 0] + 2, 0 * q[:, 0], 2 * v[:, 0], 2 * v[:, 1],
                                               5 * v[:, 2]], axis=-1))
    assert system.energy([0, 1, 0], [0, 0, 0]).shape == ()


def test_constraints():
    system = dalembert.System(SLEIGH)
    q, v = np.random.default_rng(2).normal(size=(2, 4, 3))
    s, c = np.sin(q[:, 2]), np.cos(q[:, 2])
    found = system.constraints(q, v)
    assert found.D[:, 0] == pytest.approx(v[:, 0] * s - v[:, 1] * c + 0.5 * v[:, 2])
    assert found.A[:, 0] == pytest.approx(np.stack([s, -c, 0 * s + 0.5], axis=-1))
    assert found.reactions.shape == (4, 3, 1)
    assert found.reactions[..., 0] == pytest.approx(found.A[:, 0] / [2, 2, 5])


def test_two_constraints():
    """A wheel of two constraints, with W = diag(2, 3, 5)."""
    system = dalembert.System("coordinates: [x, y, a]\nlagrangian: x'^2 + 3/2*y'^2 + 5/2*a'^2\n"
                              "constraints: [\"x' - cos(a)*a'\", \"y' - sin(a)*a'\"]\n")
    A = np.array([[1, 0, -np.cos(0.3)], [0, 1, -np.sin(0.3)]])
    found = system.constraints([7, 8, 0.3], [1, 2, 4])
    assert found.D == pytest.approx([1 - 4 * np.cos(0.3), 2 - 4 * np.sin(0.3)])
    assert found.A == pytest.approx(A) and found.reactions == pytest.approx((A / [2, 3, 5]).T)


def test_vakonomic():
    system = dalembert.System.builtin('chaplygin-sleigh-vakonomic')
    run = dalembert.Run(system, 'rk4', step=1e-3, space='physical')
    before = run.state
    run.advance(2)
    after = run.state
    field = system.field(*np.split((before + after) / 2, [3]))
    assert (after - before)[3:] / 2e-3 == pytest.approx(field, abs=1e-5)


def test_refusals(oscillator):
    system = dalembert.System(SLEIGH)
    with pytest.raises(dalembert.InputError, match='^q: its last axis has 2 numbers, not 3'):
        system.field([1, 2], [1, 2, 3])
    with pytest.raises(dalembert.InputError, match='^v: '):
        system.field([1, 2, 3], 'fast')
    with pytest.raises(dalembert.InputError, match='^q, v, t: '):
        system.field(np.zeros((2, 3)), np.zeros((4, 3)))
    with pytest.raises(dalembert.InputError, match="'kk'"):
        system.field([0] * 3, [0] * 3, parameters={'kk': 1})
    with pytest.raises(dalembert.InputError, match='^parameters'):
        oscillator.field([0], [0], parameters={'k': 'stiff'})
    with pytest.raises(dalembert.InputError, match='has no constraints'):
        oscillator.constraints([0], [0])


def test_no_values():
    """x'' = sqrt(x) has none below 0."""
    system = dalembert.System('coordinates: [x]\naccelerations: {x: sqrt(x)}\n')
    assert np.array_equal(system.field([[4], [-1]], [[0], [0]]), [[2], [np.nan]], equal_nan=True)
