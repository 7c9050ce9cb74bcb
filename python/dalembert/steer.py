"""The cheapest way from a state to another."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from ._library import ffi, lib
from .arguments import MAX_INT, Settings, make_settings, number, refuse, text, whole
from .errors import call_steps, check, encode, keep_exception
from .fixed import owned
from .run import Array, Run
from .simulate import Trajectory
from .spec import Spec, SystemLike, takes_run_options
from .system import System, text_of


@dataclass(frozen=True)
class Extremal:
    """A motion that ends at the target, or the nearest to one.

    Attributes
    ----------
    S : float
        The action, e (pi_e(T) - pi_e(0)); int L dt of vakonomic motion.
    motion : Trajectory
        A row for each step, with the columns ``'t'``, ``'x'``, ``"x'"``, ``'p_x'``, ``'pi_x'``, ``'pi_e'``;
        of vakonomic motion with ``'g1'``.
    message : str
        Why it does not end at the target; '' where it does.
    residual : float
        The largest jump between its pieces and distance from the ends, relative.
    distance : float
        Of its end from the target.
    max_D : float
        max \\|D\\| along it.
    condition : float
        Of the last matrix of Newton's method.
    iterations : int
    rank : int or None
        Of d(q, v)(T)/d(p, pi)(0).
    conjugate_times : int or None
        Before T: with none S is a local minimum.  None: not known.
    first_conjugate : float
        Near the first of them; NaN without one.
    """

    S: float
    motion: Trajectory
    message: str
    residual: float
    distance: float
    max_D: float
    condition: float
    iterations: int
    rank: int | None
    conjugate_times: int | None
    first_conjugate: float


@dataclass(frozen=True)
class Steering:
    """Motions to a target, the cheapest first, and what can be reached.

    Attributes
    ----------
    extremals : tuple of Extremal
    growth : tuple of int
        The growth vector of the velocities that D = 0 allows; empty where there is none.
    allowed : int or None
        The rank that d(q, v)(T)/d(p, pi)(0) can have.
    """

    extremals: tuple[Extremal, ...]
    growth: tuple[int, ...]
    allowed: int | None

    @property
    def best(self) -> Extremal:
        """The cheapest one."""
        return self.extremals[0]


@ffi.def_extern(error=lib.DAL_STATUS_INTERRUPTED, onerror=keep_exception)
def python_iterate(user: Any, guess: int, iteration: int, residual: float) -> int:
    """Lets Python handle signals, an exception of which ends the search."""
    return lib.DAL_STATUS_OK


def known(count: int) -> int | None:
    return count if count >= 0 else None


def read_extremal(x: Any, run: Run, t: Array) -> Extremal:
    """An extremal of the library; a run of the system names its columns."""
    width = len(run.names)
    rows = np.empty((len(t), 1 + width))
    rows[:, 0], rows[:, 1:] = t, np.array(ffi.unpack(x.z, len(t) * width)).reshape(len(t), width)
    columns = np.dtype([(name, float) for name in ('t', *run.names)])
    motion = Trajectory(run.system, run.integrator, run.step, run.parameters, rows.view(columns).reshape(len(t)), {})
    return Extremal(x.S, motion, text_of(x.message), x.residual, x.distance, x.max_D, x.condition, x.iterations,
                    known(x.rank), known(x.conjugate_times), x.first_conjugate)


@takes_run_options
def steer(system: SystemLike, target: Settings, integrator: str | None = None, time: float | None = None, *,
          rest: bool = False, aim: bool = False, free: Sequence[str] = (), starts: int = 1, seed: int = 1,
          max_iterations: int = 200, max_residual: float = 1e-11, **settings: Any) -> Steering:
    """Finds the cheapest motions from a start to a target, by the lift.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; the cost is the effort of the system, see `System.with_effort`.
    target : mapping of str to float
        Values of ``'x'``, ``"x'"`` at the end; what is not named is free there.
    time : float, optional
        Of the end, a whole number of steps.
    rest : bool
        Velocities that are not named are 0 at both ends.
    aim : bool
        Without cost: the velocities of the start are free on D = 0.
    free : sequence of str
        Components of the start that are free, too.
    starts : int
        First guesses: the straight line, and bent ones that are drawn by the seed. Where none of them leads to the
        target up to 8 more are made, and then the end of a motion to another one is moved to it.
    seed : int
    max_iterations : int
        For each guess.
    max_residual : float
        Of a motion that is found.

    Returns
    -------
    Steering

    Raises
    ------
    StepError
        No motion ends at the target; ``partial`` is the Steering, whose best motion is the nearest.
        An exception that a signal raises has ``partial``, too.
    """
    if isinstance(free, str):
        raise refuse('free', 'give a list of components of the start')
    settings['space'] = 'physical'
    spec = Spec(system, integrator, **settings)
    names = [ffi.new('char[]', encode(text('free', name))) for name in free]
    frees = ffi.new('const char *[]', names)
    targets, count, _texts = make_settings('target', target)
    chosen = ffi.new('dal_steer_settings *', {
        'target': targets, 'targets': count, 'free_starts': frees, 'frees': len(names), 'rest': bool(rest),
        'aim': bool(aim), 'starts': whole('starts', starts, 1, MAX_INT), 'seed': whole('seed', seed, 0),
        'iterations': whole('max_iterations', max_iterations, 1, MAX_INT),
        'tolerance': number('max_residual', max_residual)})
    observer = ffi.new('dal_steer_observer *', {'step': lib.python_iterate})
    made = ffi.new('dal_steering **')
    call_steps(lib.dal_steer_create, made, spec.system._model, spec.c, spec.time(time), chosen, observer)
    c = owned(made[0], lib.dal_steer_free)
    t, run = np.array(ffi.unpack(c.t, c.rows)), Run(system, integrator, **{
        **settings, 'start': None, 'space': 'lifted' if c.dimension > 3 * c.n else 'physical'})
    extremals = tuple(read_extremal(c.extremal[i], run, t) for i in range(c.count))
    growth = tuple(c.growth.rank[i] for i in range(c.growth.levels)) if c.has_growth else ()
    found = Steering(extremals, growth, known(c.allowed))
    raise_unless_found(c, found)
    return found


def raise_unless_found(c: Any, found: Steering) -> None:
    """Raises what has ended the search, or the reason why no motion ends at the target."""
    statuses = [c.extremal[i].status for i in range(c.count)]
    interrupted = not statuses or lib.DAL_STATUS_INTERRUPTED in statuses
    if not interrupted and statuses[0] == lib.DAL_STATUS_OK:
        return
    record = ffi.new('dal_error *', {'message': (found.best.message if statuses else '').encode()})
    try:
        check(lib.DAL_STATUS_INTERRUPTED if interrupted else statuses[0], record, stepping=True)
    except BaseException as error:
        error.partial = found  # type: ignore[attr-defined]
        raise


System.steer = steer  # type: ignore[attr-defined]
