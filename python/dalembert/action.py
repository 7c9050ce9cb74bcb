"""The actions of the theory on a curve."""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Mapping, Sequence

import numpy as np
import numpy.typing as npt

from ._library import ffi, lib
from .arguments import Settings, array, make_settings, refuse, text
from .errors import call
from .fixed import owned
from .spec import Spec, SystemLike
from .system import System, text_of

FORMS = {lib.DAL_ACTION_EQUATIONS: 'nh8', lib.DAL_ACTION_SECOND_ORDER: 'nh10',
         lib.DAL_ACTION_FIRST_ORDER: 'nh11', lib.DAL_ACTION_HAMILTONIAN: 'nh23'}


@dataclass(frozen=True)
class DiscreteAction:
    """The discrete action of a symplectic method at rows that are compared with its steps.

    Attributes
    ----------
    value : float
        NaN where e is not constant.
    defect : float
        The largest distance of a row from the step before it, divided by the step.
    is_stationary : bool
        Every row is the step from the row before it, up to rounding.
    """

    value: float
    defect: float
    is_stationary: bool


@dataclass(frozen=True)
class Actions:
    """The actions of the theory on a curve.

    Attributes
    ----------
    value, error : dict of str to float
        By equation: ``'nh8'`` of a system with equations, ``'nh10'``, ``'nh11'``, ``'nh23'``; the
        error is the distance to the value with every second row.
    max_constraint : float
        max |D(q, q', t)| at the rows; 0 without constraints.
    discrete : dict of str to DiscreteAction
        By the methods.
    """

    value: dict[str, float]
    error: dict[str, float]
    max_constraint: float
    discrete: dict[str, DiscreteAction]


def find_columns(system: System, curve: Mapping[str, npt.ArrayLike]) -> dict[str, npt.NDArray[np.float64]]:
    """The members of a dal_curve by the names of columns."""
    kinds = {'q': '{}', 'v': "{}'", 'lambda': 'lambda_{}', 'p': 'p_{}', 'pi': 'pi_{}'}
    single = {name: array(f'curve[{name!r}]', curve[name]) for name in ('t', 'e', 'pi_e') if name in curve}
    if 't' not in single or single['t'].ndim != 1:
        raise refuse('curve', 'it has no times t' if 't' not in single else 't is not one-dimensional')
    rows = single['t'].size
    found = dict(single)
    for kind, form in kinds.items():
        names = [form.format(coordinate) for coordinate in system.coordinates]
        missing = [name for name in names if name not in curve]
        if missing and (kind == 'q' or len(missing) < len(names)):
            raise refuse('curve', f'there is no column {missing[0]!r}')
        if not missing:
            columns = [array(f'curve[{name!r}]', curve[name]) for name in names]
            if any(column.shape != (rows,) for column in columns):
                raise refuse('curve', f'the columns of {kind} have other lengths than t')
            found[kind] = np.ascontiguousarray(np.stack(columns, axis=-1))
    if any(values.shape != (rows,) for values in single.values()):
        raise refuse('curve', 'its columns have different lengths')
    return found


def action(system: SystemLike, curve: Mapping[str, npt.ArrayLike], *, methods: Sequence[str] = (),
           parameters: Settings | None = None) -> Actions:
    """Evaluates the actions of the theory on a curve.

    Parameters
    ----------
    system : System or str
        Its F, and for ``'nh23'`` its effort.
    curve : mapping of str to array_like
        Rows: the times ``'t'``, which ascend, and the coordinates; ``"x'"``, ``'lambda_x'``, ``'p_x'``,
        ``'pi_x'``, ``'e'`` and ``'pi_e'`` where there are some.  Cubic splines join the rows.
    methods : sequence of str
        Symplectic methods whose discrete actions are tried; the rows then have velocities and equal
        distances.
    parameters : mapping, optional
        Values other than the defaults.

    Returns
    -------
    Actions
        ``value['nh10']`` is 0 where the curve is a motion of the system, and positive elsewhere.

    Raises
    ------
    InputError
        Missing columns, fewer than 7 rows, times that do not ascend, numbers that are not finite,
        vakonomic motion, a method that is not symplectic.
    """
    one = system if isinstance(system, System) else System.builtin(text('system', system))
    columns = find_columns(one, curve)
    c = ffi.new('dal_curve *', {'rows': columns['t'].size})
    for name, values in columns.items():
        setattr(c, name, ffi.from_buffer('double[]', values))
    made = ffi.new('dal_evaluator **')
    settings, count, _texts = make_settings('parameters', parameters)
    call(lib.dal_evaluator_create, made, one._system, settings, count)
    evaluator = owned(made[0], lib.dal_evaluator_free, one._system)
    one_action, largest = ffi.new('dal_action *'), ffi.new('double *')
    call(lib.dal_evaluator_measure_curve, evaluator, c, largest)
    value, error = {}, {}
    for form, name in FORMS.items():
        if form == lib.DAL_ACTION_EQUATIONS and one._system.equations == 0:
            continue
        call(lib.dal_evaluator_integrate_action, evaluator, c, form, one_action)
        value[name], error[name] = one_action.value, one_action.error
    discrete = {}
    for method in methods:
        discrete.update(try_method(one, c, columns, method, parameters))
    return Actions(value, error, largest[0], discrete)


def try_method(system: System, curve: Any, columns: Mapping[str, npt.NDArray[np.float64]], method: str,
               parameters: Settings | None) -> dict[str, DiscreteAction]:
    """The discrete action of a method, by its name."""
    t, step = columns['t'], lib.dal_curve_step(curve)
    if 'v' not in columns or step == 0:
        raise refuse('methods', 'the rows have no velocities' if 'v' not in columns
                     else 'the rows are at different distances')
    spec = Spec(system, text('methods', method), step=step, parameters=parameters, start_time=float(t[0]))
    found = ffi.new('dal_discrete_action *')
    call(lib.dal_check_discrete_action, spec.c, curve, found)
    return {spec.integrator: DiscreteAction(found.value, found.defect, bool(found.is_stationary))}
