"""Ensembles: members whose starts and parameters are drawn."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Iterable, Mapping, Union

import numpy as np
import numpy.typing as npt

from ._library import ffi, lib
from .arguments import Settings, array, refuse, text, whole
from .errors import call, encode, make_error
from .run import CHUNK, Array, doubles, native_options
from .spec import Spec, SystemLike, chunks, takes_options

# Members that are stepped together.
LANES = 256


@dataclass(frozen=True)
class Ensemble:
    """The members of an ensemble at some times.

    Attributes
    ----------
    names : tuple of str
        Of the components of a state.
    times : ndarray, [times]
    states : ndarray, [times, members, dimension]
        NaN of a member from its failure on.
    draws : dict of str to ndarray, [members]
        What was added, for each name that varies.
    failures : dict of int to Exception
        Why members failed, by their numbers.
    """

    names: tuple[str, ...]
    times: Array
    states: Array
    draws: dict[str, Array]
    failures: dict[int, Exception]

    def mean(self) -> Array:
        """The mean state of those that have not failed, [times, dimension]."""
        return np.nanmean(self.states, axis=1)

    def quantiles(self, p: npt.ArrayLike) -> npt.NDArray[np.float64]:
        """Quantiles of each component, [p, times, dimension]."""
        return np.nanquantile(self.states, p, axis=1)

    def covariance(self) -> Array:
        """The covariance matrix of the state at each time, [times, dimension, dimension]."""
        kept = (states[np.isfinite(states).all(axis=1)] for states in self.states)
        return np.array([np.atleast_2d(np.cov(states, rowvar=False)) for states in kept])


def make_variations(vary: Mapping[str, str] | Iterable[str]) -> tuple[Any, int]:
    """An array of dal_variation, and its length."""
    items = vary.items() if isinstance(vary, Mapping) else (tuple(text('vary', one).split('=', 1)) for one in vary)
    texts = ['='.join(text(f'vary[{item[0]!r}]', part) for part in item) for item in items]
    made = ffi.new('dal_variation[]', max(1, len(texts)))
    for i, one in enumerate(texts):
        call(lib.dal_variation_parse, ffi.addressof(made, i), encode(one))
    return made, len(texts)


@takes_options
def ensemble(system: SystemLike, integrator: str | None = None, *, members: int, seed: int,
             vary: Mapping[str, str] | Iterable[str], times: Union[float, npt.ArrayLike],
             step: float | None = None, parameters: Settings | None = None, start: Settings | None = None,
             start_time: float = 0.0, compile: bool = False, **options: Any) -> Ensemble:
    """Runs members whose starts and parameters are drawn, as ``dalembert ensemble`` does.

    Parameters
    ----------
    system, integrator, step, parameters, start, start_time, **options
        As of a `Run`.  Unless ``consistent`` is given, velocities are moved to D = 0.
    members, seed : int
        The draws of a member depend on the seed, the name and its number alone.
    vary : mapping of str to str
        What is added to a start value or parameter: ``{"x'": 'normal(0,0.1)', 'k': 'uniform(1,2)'}``.
    times : float or array_like
        Increasing, in the direction of the step, and whole numbers of steps from start_time.
    compile : bool
        Compiles the steps, with the same bits.
    """
    spec = Spec(system, integrator, step, parameters, start, start_time,
                **{'consistent': True, **options})
    when = array('times', times)
    members, seed = whole('members', members, 1), whole('seed', seed, 0)
    steps = np.array([0 if t == start_time else spec.steps(t) for t in when], dtype=np.int64)
    if len(when) == 0 or np.any(np.diff(steps) <= 0):
        raise refuse('times', 'they must lead away from the start, one after the other')
    variations, count = make_variations(vary)
    made = ffi.new('dal_ensemble **')
    call(lib.dal_ensemble_create, made, spec.c, variations, count, seed, min(members, LANES))
    c = ffi.gc(made[0], lib.dal_ensemble_free)
    batch = lib.dal_ensemble_batch(c)
    if compile:
        native, _texts = native_options(None, 'cc')
        call(lib.dal_batch_native, batch, native)
    run = spec.create_run()
    names = run[1]
    states, draws = np.empty((len(when), members, len(names))), np.empty((members, count))
    failures: dict[int, Exception] = {}
    for first in range(0, members, LANES):
        lanes = min(LANES, members - first)
        lib.dal_ensemble_start(c, first, lanes)
        lib.dal_ensemble_draws(c, doubles(draws[first:first + lanes]))
        taken = 0
        for i, until in enumerate(steps):
            for some in chunks(int(until) - taken, max(100, CHUNK // lanes)):
                lib.dal_batch_advance(batch, some)
            taken = int(until)
            lib.dal_ensemble_states(c, doubles(states[i, first:first + lanes]))
        record = ffi.new('dal_error *')
        for i in range(lanes):
            if lib.dal_batch_status(batch, i, record) != lib.DAL_STATUS_OK:
                failures[first + i] = make_error(record, stepping=True)
    labels = [ffi.string(variations[i].name).decode() for i in range(count)]
    return Ensemble(names, when, states, {name: draws[:, i] for i, name in enumerate(labels)}, failures)
