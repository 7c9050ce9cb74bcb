"""The drift of D, E and invariants, predicted before a run."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ._library import ffi, lib
from .arguments import whole
from .errors import call_steps, check
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
    leaves_D: bool
    is_quad: bool
    pieces: int


@takes_run_options
def predict(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
            pieces: int = 0, samples: int = 200, quad_steps: int = 200000, **settings: Any) -> Prediction:
    """Predicts the drift of D, E and the invariants along a run.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; the space is the physical one where it is not given.
    time : float, optional
        Where the run ends, a whole number of steps.
    pieces : int
        Pieces of that length of the exact motion, for the random walk of chaotic motion; 500 say it to 10 %.
    samples : int
        Rows of the curves after the first.
    quad_steps : int
        Single steps in quad precision, at most, where rounding hides what they change; 0 takes none.

    Returns
    -------
    Prediction
        What cannot be predicted is an `Error` with the reason.
    """
    settings.setdefault('space', 'physical')
    spec = Spec(system, integrator, **settings)
    made = ffi.new('dal_prediction **')
    observer = ffi.new('dal_predict_observer *', {'step': lib.python_progress})
    chosen = ffi.new('dal_predict_settings *', {'pieces': whole('pieces', pieces, 0),
                                                'rows': whole('samples', samples, 1),
                                                'quad_steps': whole('quad_steps', quad_steps, 0)})
    call_steps(lib.dal_predict_create, made, spec.c, spec.time(time), chosen, observer)
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
                      text_of(p.message), bool(p.leaves_D), bool(p.is_quad), p.pieces)
