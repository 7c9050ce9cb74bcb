"""The drift of D, E and invariants, predicted before a run."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Dict, Iterable, Sequence, Tuple, Union, overload

import numpy as np

from ._library import ffi, lib
from .arguments import refuse, whole
from .errors import Error, call_steps, check
from .run import Array
from .spec import Spec, SystemLike, takes_run_options
from .system import text_of


@dataclass(frozen=True)
class Predicted:
    """What a run will change of one observable.

    Attributes
    ----------
    is_conserved : bool
        By the exact motion; all numbers are NaN where it is not.
    is_zero : bool
        The mean rate is 0 by reversibility.
    curve : ndarray
        The changes at the times of the `Prediction`.
    change, max_change : float
        At the end of the curve; the largest \\|change\\|.
    rate, margin : float
        The mean rate per unit of t, and half its interval.
    walk, walk_margin : float
        s^2 of the random walk, its variance per unit of t, and half its interval of 68 %; NaN without
        pieces.
    """

    is_conserved: bool
    is_zero: bool
    curve: Array
    change: float
    max_change: float
    rate: float
    margin: float
    walk: float
    walk_margin: float


@dataclass(frozen=True)
class Prediction:
    """What a run will change, predicted from single steps on the exact motion.

    Attributes
    ----------
    t : ndarray
        Times of the curves.
    observables : dict of str to Predicted
        ``'D1'``, ``'E'``, invariants.
    end : float
        t where the curves end.
    reason : str
        Why: ``'time'``; ``'defect'``, D may have moved the motion too far; ``'failed'``.
    message : str
        Of a step that failed, or empty.
    in_phase : float
        t to which what oscillates is in phase with a run, within about 1 %; NaN: to the end, or not known.
    leaves_D : bool
        Whether steps leave D = 0, above rounding.
    is_quad : bool
        Single steps are in quad precision, since rounding limits doubles.
    pieces : int
        That were completed.
    """

    t: Array
    observables: dict[str, Predicted]
    end: float
    reason: str
    message: str
    in_phase: float
    leaves_D: bool
    is_quad: bool
    pieces: int


Predictions = Dict[Tuple[str, float], Union[Prediction, Error]]


def predict_one(spec: Spec, time: float | None, settings: Any) -> Prediction:
    made = ffi.new('dal_prediction **')
    observer = ffi.new('dal_predict_observer *', {'step': lib.python_progress})
    call_steps(lib.dal_predict_create, made, spec.c, spec.time(time), settings, observer)
    p = ffi.gc(made[0], lib.dal_prediction_free)
    if p.reason == lib.DAL_PREDICTION_INTERRUPTED:
        check(lib.DAL_STATUS_INTERRUPTED, ffi.new('dal_error *'))
    count, rows = p.observables, p.rows
    changes = np.array(ffi.unpack(p.change, rows * count)).reshape(rows, count)
    found = {}
    for i in range(count):
        q = p.predicted[i]
        found[text_of(q.name)] = Predicted(bool(q.is_conserved), bool(q.is_zero), changes[:, i].copy(), q.change,
                                           q.max_change, q.rate, q.margin, q.walk, q.walk_margin)
    return Prediction(np.array(ffi.unpack(p.t, rows)), found, p.end, text_of(lib.dal_prediction_end_name(p.reason)),
                      text_of(p.message), p.in_phase, bool(p.leaves_D), bool(p.is_quad), p.pieces)


def predict_all(specs: Sequence[Spec], time: float | None, settings: Any) -> Predictions:
    made = ffi.new('dal_exact_motion **')
    if lib.dal_exact_motion_create(made, specs[0].c, 0, ffi.NULL) == lib.DAL_STATUS_OK:
        motion = ffi.gc(made[0], lib.dal_exact_motion_free)
        settings.motion = motion
    found: Predictions = {}
    for spec in specs:  # where there is no motion, each prediction says the reason
        try:
            found[spec.integrator, spec.step] = predict_one(spec, time, settings)
        except Error as error:
            if error.status == 'DAL_INTERRUPTED':
                raise
            found[spec.integrator, spec.step] = error
    return found


@overload
def predict(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
            step: float | None = None, pieces: int = 0, samples: int = 200, quad_steps: int = 200000,
            **settings: Any) -> Prediction: ...


@overload
def predict(system: SystemLike, integrator: Sequence[str], time: float | None = None, *,
            step: float | Sequence[float] | None = None, pieces: int = 0, samples: int = 200, quad_steps: int = 200000,
            **settings: Any) -> Predictions: ...


@overload
def predict(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
            step: Sequence[float], pieces: int = 0, samples: int = 200, quad_steps: int = 200000,
            **settings: Any) -> Predictions: ...


@takes_run_options
def predict(system: SystemLike, integrator: str | Sequence[str] | None = None, time: float | None = None, *,
            step: float | Sequence[float] | None = None, pieces: int = 0, samples: int = 200, quad_steps: int = 200000,
            **settings: Any) -> Prediction | Predictions:
    """Predicts the drift of D, E and the invariants along a run, or along runs by several methods and steps.

    Parameters
    ----------
    system, **settings
        As of a `Run`; the space is the physical one where it is not given.
    integrator : str or list of str, optional
        The method, or several.
    step : float or list of float, optional
        The step, or several.
    time : float, optional
        Where the runs end, a whole number of steps.
    pieces : int
        Pieces of that length of the exact motion, for the random walk of chaotic motion; 500 say it to 10 %.
    samples : int
        Rows of the curves after the first.
    quad_steps : int
        Single steps in quad precision, at most, where rounding hides what they change; 0 takes none.

    Returns
    -------
    Prediction or dict
        What cannot be predicted is an `Error` with the reason.  A list of methods or steps gives a dict of
        (integrator, step) to the `Prediction`, or to the `Error`; all share one exact motion.
    """
    settings.setdefault('space', 'physical')
    chosen = ffi.new('dal_predict_settings *', {'pieces': whole('pieces', pieces, 0),
                                                'rows': whole('samples', samples, 1),
                                                'quad_steps': whole('quad_steps', quad_steps, 0)})
    methods = [integrator] if integrator is None or isinstance(integrator, str) else list(integrator)
    steps = list(step) if isinstance(step, Iterable) else [step]
    for name, values in (('integrator', methods), ('step', steps)):
        if not values:
            raise refuse(name, 'the list is empty')
    specs = [Spec(system, method, size, **settings) for method in methods for size in steps]
    if methods == [integrator] and not isinstance(step, Iterable):
        return predict_one(specs[0], time, chosen)
    return predict_all(specs, time, chosen)
