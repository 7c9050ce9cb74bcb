"""A system at many points."""
from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ._library import ffi, lib
from .arguments import Settings, array, make_settings, refuse
from .errors import call
from .fixed import owned

Array = npt.NDArray[np.float64]


def evaluate(system: Any, callback: Any, size: int, q: npt.ArrayLike, v: npt.ArrayLike, t: npt.ArrayLike = 0.0,
             parameters: Settings | None = None) -> Array:
    """The numbers of a callback of a dal_system, (…, size), at points q (…, n), v (…, n) and times t (…).

    The shapes before the last axis are broadcast.  Of a vakonomic system v has the multipliers, too.
    Where the callback has no values they are NaN.
    """
    made = ffi.new('dal_evaluator **')
    settings, count, _texts = make_settings('parameters', parameters)
    call(lib.dal_evaluator_create, made, system, settings, count)
    evaluator = owned(made[0], lib.dal_evaluator_free, system)
    points = {'q': array('q', q), 'v': array('v', v)}
    for (name, values), width in zip(points.items(), (system.n, system.n + system.multipliers)):
        if values.shape[-1] != width:
            raise refuse(name, f'its last axis has {values.shape[-1]} numbers, not {width}')
    times = array('t', t).reshape(np.shape(t))
    try:
        shape = np.broadcast_shapes(points['q'].shape[:-1], points['v'].shape[:-1], times.shape)
    except ValueError:
        raise refuse('q, v, t', 'their shapes cannot be broadcast: ' + ', '.join(
            str(a.shape) for a in (*points.values(), times))) from None
    spread = [np.ascontiguousarray(np.broadcast_to(a, shape + a.shape[-1:])) for a in points.values()]
    when = np.ascontiguousarray(np.broadcast_to(times, shape))
    out = np.empty(shape + (size,))
    numbers = [ffi.from_buffer('double[]', a) for a in (when, *spread, out)]
    lib.python_evaluate(evaluator, callback, when.size, *numbers[:3], spread[1].shape[-1], size, numbers[3])
    return out
