"""Derivatives of runs by starts and parameters."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np

from ._library import ffi, lib
from .arguments import refuse, text, whole
from .errors import call, call_steps, encode
from .fixed import owned
from .run import Array
from .spec import Spec, SystemLike, takes_run_options


@dataclass(frozen=True)
class Sensitivities:
    """Derivatives of the state of a run.

    Attributes
    ----------
    t : ndarray
        Times of the rows.
    components : tuple of str
        Of the state, ``'x'``, ``"x'"``, ...
    columns : dict of str to ndarray
        By each name the derivatives of the components, a row for each time.
    """

    t: Array
    components: tuple[str, ...]
    columns: dict[str, Array]


@takes_run_options
def sensitivities(system: SystemLike, names: Sequence[str], integrator: str | None = None,
                  time: float | None = None, *, samples: int = 1, **settings: Any) -> Sensitivities:
    """Derivatives of a run by parameters and start values, exact for the numerical steps.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; the space is the physical one where it is not given.
    names : sequence of str
        Parameters, ``'k'``, and components of the start, ``'x'``, ``"x'"``, ``'p_x'``, ``'pi_x'``.
    time : float, optional
        The last row.
    samples : int
        Rows after the first, at equal distances.

    Returns
    -------
    Sensitivities
        A method whose steps have no exact tangent is an `InputError` with the reason.
    """
    if isinstance(names, str) or not names:
        raise refuse('names', 'give a list of parameters and components of the start')
    settings.setdefault('space', 'physical')
    spec = Spec(system, integrator, **settings)
    encoded = [ffi.new('char[]', encode(text('names', name))) for name in names]
    made = ffi.new('dal_sensitivity **')
    model = spec.system._model
    call(lib.dal_sensitivity_create, made, model, spec.c, ffi.new('const char *[]', encoded), len(encoded))
    derivatives = owned(made[0], lib.dal_sensitivity_free, model)
    size = lib.dal_sensitivity_dimension(derivatives)
    times = np.linspace(spec.c.start_time, spec.time(time), whole('samples', samples, 1) + 1)
    rows = np.empty((len(encoded), len(times), size))
    for i, t in enumerate(times):
        call_steps(lib.dal_sensitivity_advance, derivatives, t)
        for k in range(len(encoded)):
            rows[k, i] = ffi.unpack(lib.dal_sensitivity_column(derivatives, k), size)
    return Sensitivities(times, spec.create_run()[1], dict(zip(names, rows)))
