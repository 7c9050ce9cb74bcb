"""What is measured along runs: trends, order, exponents, sections, error sources; and generated C.

Every function makes runs of its own from a system, a method and the other arguments of `Run`.
"""
from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Sequence

import numpy as np
import numpy.typing as npt

from ._library import ffi, lib
from .arguments import MAX_INT, array, number, refuse, text, whole
from .errors import Error, call, call_steps, check, encode, keep_exception
from .run import Array, doubles
from .spec import Settings, Spec, SystemLike, chunks, takes_run_options
from .system import taken_text, text_of

# Steps with tangent vectors between two moments in which Python handles signals.
TANGENT_CHUNK = 200


# ---- trends ------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Trend:
    """Size and trend of a quantity x along a run.

    Attributes
    ----------
    count : int
        Values.
    first, last, max_abs : float
        x at the first and at the last, max |x|.
    deviation : float
        max |x - first|.
    amplitude : float
        Half the range about the fitted line.
    rate, rate_low, rate_high : float
        Slope of the line per unit of t, and its 95 % interval, of this run.
    max_drift : float
        max |drift| over the whole series in this interval.
    exponent : float
        Of t; NaN where none can be stated.
    size : str
        ``'exact'``, ``'rounding'`` or ``'larger'``.
    trend : str
        ``'none'``, ``'linear'``, ``'random walk'``, ...
    confidence : float
        Of the trend, 0 to 1; NaN where it is ``'undecided'`` or ``'aborted'``.
    likeliest : str
        Of an undecided trend what has half of the evidence and more, or ``'undecided'``; else the trend.
    conservation : str
        Unless ``'conserved'``, size and trend state nothing.
    """

    count: int
    first: float
    last: float
    max_abs: float
    deviation: float
    amplitude: float
    rate: float
    rate_low: float
    rate_high: float
    max_drift: float
    exponent: float
    size: str
    trend: str
    confidence: float
    likeliest: str
    conservation: str


WORDS = {'size': lib.dal_size_text, 'trend': lib.dal_trend_text, 'likeliest': lib.dal_trend_text,
         'conservation': lib.dal_conservation_text}


def make_trend(t: Any) -> Trend:
    """A dal_trend as a Trend: the members have the same names."""
    values = {name: getattr(t, name) for name in Trend.__dataclass_fields__}
    return Trend(**{**values, **{name: text_of(word(values[name])) for name, word in WORDS.items()}})


def classify(run: Any, names: tuple[str, ...], statistics: Any, status: int) -> dict[str, Trend]:
    """The trends of the observables of a run by their statistics, and the status with which it ended."""
    trends = ffi.new('dal_trend[]', len(names))
    lib.dal_run_classify(run, statistics, status, trends)
    return {name: make_trend(trends[i]) for i, name in enumerate(names)}


@takes_run_options
def trend(system: SystemLike, integrator: str | None = None, time: float | None = None, *, every: int = 1,
          **settings: Any) -> dict[str, Trend]:
    """Runs to a time and classifies how each observable drifts.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`.
    time : float, optional
        The default is the system file's.
    every : int
        Steps between two values.

    Returns
    -------
    dict of str to Trend
        By the names of the observables: ``'D1'``, ``'E'``, ``'H'``, invariants, ``'error'``; without
        what events add to E and to the invariants.

    Raises
    ------
    StepError
        Its ``partial`` has the trends up to the failure.
    """
    spec = Spec(system, integrator, **settings)
    run, _, names = spec.create_run()
    every = whole('every', every, 1)
    statistics = ffi.new('dal_statistics[]', len(names))
    record = ffi.new('dal_error *')
    status = lib.python_sample(run, spec.time(time), 1,
                               ffi.new('python_request *', {'statistics': statistics, 'every': every}), record)
    has_ended = status in (lib.DAL_STATUS_OK, lib.DAL_STATUS_STOPPED)
    found = classify(run, names, statistics, status)
    try:
        check(lib.DAL_STATUS_OK if has_ended else status, record, stepping=True)
    except Error as error:
        error.partial = found
        raise
    return found


# ---- order -------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Order:
    """Errors for decreasing steps, and the slopes between them.

    Attributes
    ----------
    step, error : ndarray
        Step sizes, decreasing; error of (q, v, g), parts of |x| or of its unit.
    evaluations : ndarray of int
        Of the field.
    slope : ndarray
        ``slope[i]`` between ``step[i - 1]`` and ``step[i]``; the first is NaN.
    order : float
        NaN where none can be stated.
    """

    step: Array
    error: Array
    evaluations: npt.NDArray[np.int64]
    slope: Array
    order: float


@takes_run_options
def order(system: SystemLike, integrator: str | None = None, time: float | None = None, *, levels: int = 4,
          reference: str | npt.ArrayLike | None = None, **settings: Any) -> Order:
    """Measures the order of a method: errors at a time for step, step/2, step/4, ...

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; ``step`` is the largest.
    time : float, optional
        A whole number of the steps.
    levels : int
        Step sizes, from 2 to 8.
    reference : str or array_like, optional
        The method of the reference, by default gauss12, with half the smallest step; or the exact
        state at that time.
    """
    spec = Spec(system, integrator, **settings)
    method, exact, found = ffi.NULL, ffi.NULL, ffi.new('dal_order *')
    if isinstance(reference, str):
        method = ffi.new('dal_method *')
        call(lib.dal_method_parse, method, encode(reference))
    elif reference is not None:
        values = array('reference', reference)
        dimension = len(spec.create_run()[1])
        if values.shape != (dimension,):
            raise refuse('reference', f'a state has shape ({dimension},), not {values.shape}')
        exact = doubles(values)
    observer = ffi.new('dal_observer *', {'poll': lib.python_poll})
    call_steps(lib.dal_order_measure, found, spec.c, spec.time(time), whole('levels', levels, 2, 8), method, exact,
               observer)
    columns = {name: np.array(list(getattr(found, name)[0:levels]))
               for name in ('step', 'error', 'evaluations', 'slope')}
    return Order(**columns, order=found.order)


# ---- Lyapunov exponents ------------------------------------------------------------------------

@dataclass(frozen=True)
class Average:
    """A mean and its 95 % confidence interval."""

    mean: float
    low: float
    high: float


@dataclass(frozen=True)
class Lyapunov:
    """Lyapunov exponents of the motion of a method.

    Attributes
    ----------
    exponents : tuple of Average
        Decreasing after a transient.
    sum, divergence : Average
        Of the exponents; of the field along the motion, NaN where it is not known.
    is_exact : bool
        The derivative of a step is by the tangent system, not by differences.
    holds : bool or None
        Whether the sum agrees with the divergence to within the error of the method; None where they
        cannot be compared.
    """

    exponents: tuple[Average, ...]
    sum: Average
    divergence: Average
    is_exact: bool
    holds: bool | None


def average(function: Any, *arguments: Any) -> Average:
    a = ffi.new('dal_average *')
    function(*arguments, a)
    return Average(a.mean, a.low, a.high)


@takes_run_options
def lyapunov(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
             transient: float = 0.0, count: int = 0, **settings: Any) -> Lyapunov:
    """Computes the Lyapunov exponents of a motion.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; the space is the physical one where it is not given.  On ``'lifted'`` the exponents are of
        (q, v, p, pi), in pairs.
    time, transient : float
        What the means cover, and what goes before; whole numbers of steps.
    count : int
        Exponents; 0: all.
    """
    settings.setdefault('space', 'physical')
    spec = Spec(system, integrator, **settings)
    made = ffi.new('dal_lyapunov **')
    create = lib.dal_lyapunov_create_lifted if settings['space'] == 'lifted' else lib.dal_lyapunov_create
    call(create, made, spec.c, spec.system._tangent(), whole('count', count, 0, MAX_INT))
    study = ffi.gc(made[0], lib.dal_lyapunov_free)
    before = spec.steps(number('transient', transient)) if transient else 0
    for steps in chunks(before, TANGENT_CHUNK):
        call_steps(lib.dal_lyapunov_advance, study, steps)
    lib.dal_lyapunov_discard_transient(study)
    for steps in chunks(spec.steps(spec.time(time)), TANGENT_CHUNK):
        call_steps(lib.dal_lyapunov_advance, study, steps)
    balance, record = ffi.new('dal_balance *'), ffi.new('dal_error *')
    status = lib.dal_lyapunov_balance(study, balance, record)
    if status not in (lib.DAL_STATUS_OK, lib.DAL_STATUS_UNSUPPORTED):
        check(status, record, stepping=True)
    return Lyapunov(
        tuple(average(lib.dal_lyapunov_exponent, study, i) for i in range(lib.dal_lyapunov_count(study))),
        average(lib.dal_lyapunov_sum, study), average(lib.dal_lyapunov_divergence, study),
        bool(lib.dal_lyapunov_is_exact(study)), bool(balance.holds) if status == lib.DAL_STATUS_OK else None)


# ---- sections ----------------------------------------------------------------------------------

@dataclass(frozen=True)
class Section:
    """Crossings of a surface.

    Attributes
    ----------
    rows : structured ndarray
        A row for each crossing: ``crossing``, ``t``, ``direction`` and the state.
    up, down : int
        Crossings by direction, in ``rows`` or not.
    touches : int
        Minima of the distance that are no crossings.
    unresolved : int
        Steps that may hide crossings.
    """

    rows: npt.NDArray[np.void]
    up: int
    down: int
    touches: int
    unresolved: int


@ffi.def_extern(error=lib.DAL_STATUS_INTERRUPTED, onerror=keep_exception)
def python_cross(user: Any, run: Any, crossing: Any) -> int:
    """Adds a row to the list that user is a handle of."""
    rows, dimension = ffi.from_handle(user)
    rows.append((len(rows) + 1, crossing.t, crossing.direction,
                 *ffi.unpack(lib.dal_run_state(run), dimension)))
    return lib.DAL_STATUS_OK


@takes_run_options
def section(system: SystemLike, on: str, integrator: str | None = None, time: float | None = None, *,
            direction: int = 0, **settings: Any) -> Section:
    """Finds where a motion crosses a surface.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`.
    on : str
        A formula that is 0 on the surface, ``'phi'``, or an equation, ``'y = 2*x'``.
    time : float, optional
        A whole number of steps.
    direction : int
        1: upwards, -1: downwards, 0: both.
    """
    spec = Spec(system, integrator, **settings)
    changed = spec.system._with_invariant(text('on', on))
    spec.use(changed)
    run, names, _ = spec.create_run()
    count = changed._system.invariants
    rows: list[tuple[float, ...]] = []
    handle = ffi.new_handle((rows, len(names)))
    surface = ffi.new('dal_poincare *', {
        'callback': changed._system.invariant_values, 'count': count, 'index': count - 1,
        'direction': whole('direction', direction, -1, 1), 'user': handle, 'cross': lib.python_cross,
        'poll': lib.python_poll})
    found = ffi.new('dal_crossings *')
    call_steps(lib.dal_run_crossings, run, spec.time(time), surface, found)
    columns = [('crossing', 'i8'), ('t', 'f8'), ('direction', 'i8'), *((name, 'f8') for name in names)]
    return Section(np.array(rows, dtype=columns), found.up, found.down, found.touches,
                   found.unresolved)


# ---- invariants --------------------------------------------------------------------------------

@dataclass(frozen=True)
class Invariant:
    """What a motion conserves on D = 0.

    Attributes
    ----------
    formula : str
        With the names of the system.
    terms : int
        Products that it adds up.
    independent : bool
        Functionally, of those before it.
    is_new : bool
        Likewise of E and of the invariants of the system, too.
    exact : bool
        Its rate vanishes to the digits of quad precision, not only of doubles.
    at_any_parameters : bool
        It is conserved with other parameters, too.
    """

    formula: str
    terms: int
    independent: bool
    is_new: bool
    exact: bool
    at_any_parameters: bool


@dataclass(frozen=True)
class Measure:
    """A density rho(q), rho dq dv being an invariant measure on D = 0.

    Attributes
    ----------
    formula : str
        Of rho**power.
    power : float
        1, -1, 2, -2, 0.5 or 4.
    exact, at_any_parameters : bool
        As of an `Invariant`.
    """

    formula: str
    power: float
    exact: bool
    at_any_parameters: bool


@dataclass(frozen=True)
class Invariants:
    """Invariants of a motion among sums of products.

    Attributes
    ----------
    invariants : tuple of Invariant
        A basis, simple ones of low degree first.
    measure : Measure or None
        None: it was not sought, or there is none.
    atoms : tuple of str
        Factors of the products.
    products, functions : int
        Products, and how many independent functions they are on D = 0.
    independent : int
        How many of the invariants are functionally independent.
    least_change, largest_zero : float
        The singular values on both sides of the gap, relative to the largest; NaN: there is none.
    """

    invariants: tuple[Invariant, ...]
    measure: Measure | None
    atoms: tuple[str, ...]
    products: int
    functions: int
    independent: int
    least_change: float
    largest_zero: float


def invariants(system: SystemLike, degree: int = 2, *, factors: Sequence[str] = (), measure: bool = False,
               parameters: Settings | None = None, start: Settings | None = None,
               start_time: float = 0.0) -> Invariants:
    """Finds what a motion conserves, from its formulas.

    Parameters
    ----------
    system, parameters, start, start_time
        As of a `Run`.
    degree : int
        The highest degree of the products, 1 to 8.
    factors : sequence of str
        Further factors of the products, ``'1/hypot(x, y)'``.
    measure : bool
        Finds an invariant measure, too.
    """
    spec = Spec(system, 'rk4', parameters=parameters, start=start, start_time=start_time)
    texts = [ffi.new('char[]', encode(text('factors', formula))) for formula in factors]
    listed = ffi.new('char *[]', texts)
    settings = ffi.new('dal_invariants_settings *', {
        'degree': whole('degree', degree, 1, 8), 'with': ffi.cast('const char *const *', listed), 'with_count': len(texts),
        'measures': measure})
    made = ffi.new('dal_invariants **')
    call(lib.dal_find_invariants, made, spec.system._model, spec.c, settings)
    found = ffi.gc(made[0], lib.dal_invariants_free)
    listed_invariants = tuple(
        Invariant(text_of(i.formula), i.terms, bool(i.independent), bool(i.is_new), bool(i.exact),
                  bool(i.at_any_parameters)) for i in found.invariant[0:found.count])
    density = found.measure if found.measures else None
    return Invariants(
        listed_invariants, density and Measure(text_of(density.formula), density.power, bool(density.exact),
                                               bool(density.at_any_parameters)),
        tuple(text_of(found.atom[i]) for i in range(found.atoms)), found.products, found.functions,
        found.independent, found.least_change, found.largest_zero)


# ---- Dirac's procedure -------------------------------------------------------------------------

@dataclass(frozen=True)
class DiracConstraint:
    """A constraint formula = 0.

    Attributes
    ----------
    formula : str
        With the names of the system.
    stage : int
        That found it; 0: it is primary.
    source : str or None
        The constraint whose conservation requires it.
    is_first_class : bool
        Else it is one of the second class.
    form : str
        The formula, where first class less what has brackets with the second class.
    """

    formula: str
    stage: int
    source: str | None
    is_first_class: bool
    form: str


@dataclass(frozen=True)
class Dirac:
    """Dirac's procedure for the action of a system.

    Attributes
    ----------
    is_complete : bool
        False: a condition contradicts the others, or is irregular; what follows classes is empty.
    dimensions, dimension : int
        Of the phase space; of the motion, -1 where it is not known.
    stages : int
        Until no further constraint is found.
    hamiltonian, on_surface : str
        Without its multipliers; with them, on the surface.
    constraints : tuple of DiracConstraint
        In the order of stages.
    steps : tuple of (int, str, str, str)
        Stage, constraint, outcome (``'holds'``, ``'fixes'``, ``'adds'``, ``'irregular'``,
        ``'contradicts'``, ``'stops'``) and condition of each conservation.
    multipliers : dict of str to (str or None)
        Values on the surface; None: free.
    first_class, second_class : int
        How many constraints.
    brackets : dict of (str, str) to str
        Dirac brackets of q and v that are not 0.
    gauge : dict of str to dict of str to str
        Of each free multiplier what its gauge transformation changes, and by what.
    """

    is_complete: bool
    dimensions: int
    dimension: int
    stages: int
    hamiltonian: str
    on_surface: str
    constraints: tuple[DiracConstraint, ...]
    steps: tuple[tuple[int, str, str, str], ...]
    multipliers: dict[str, str | None]
    first_class: int
    second_class: int
    brackets: dict[tuple[str, str], str]
    gauge: dict[str, dict[str, str]]


def dirac(system: SystemLike, *, parameters: Settings | None = None, start: Settings | None = None,
          start_time: float = 0.0) -> Dirac:
    """Carries out Dirac's procedure for the action of a system: of the lift with its effort, or of
    vakonomic motion.

    Parameters
    ----------
    system, parameters, start, start_time
        As of a `Run`; points near the start decide what vanishes on the surface.
    """
    spec = Spec(system, 'rk4', parameters=parameters, start=start, start_time=start_time)
    made = ffi.new('dal_dirac **')
    call(lib.dal_dirac_create, made, spec.system._model, spec.c)
    d = ffi.gc(made[0], lib.dal_dirac_free)
    formulas = [text_of(d.constraint[a].phi.text) for a in range(d.constraints)]
    names = [text_of(d.multiplier[b].name.text) for b in range(d.primaries)]
    return Dirac(
        bool(d.is_complete), 2 * d.pairs, d.dimension, d.stages, text_of(d.hamiltonian.text),
        text_of(d.on_surface.text),
        tuple(DiracConstraint(formulas[a], d.constraint[a].stage,
                              formulas[d.constraint[a].source] if d.constraint[a].source >= 0 else None,
                              bool(d.constraint[a].first_class), text_of(d.constraint[a].form.text))
              for a in range(d.constraints)),
        tuple((s.stage, formulas[s.constraint], text_of(lib.dal_dirac_outcome_name(s.outcome)),
               text_of(s.condition.text)) for s in d.step[0:d.steps]),
        {names[b]: None if d.multiplier[b].is_free else text_of(d.multiplier[b].value.text)
         for b in range(d.primaries)} if d.is_complete else {},
        d.first_class, d.second_class,
        {(text_of(b.left.text), text_of(b.right.text)): text_of(b.value.text)
         for b in d.bracket[0:d.brackets]},
        {names[g.multiplier]: {**{text_of(g.changed[k].text): text_of(g.change[k].text)
                                  for k in range(g.changes)},
                               names[g.multiplier]: text_of(g.of_multiplier.text)}
         for g in d.generator[0:d.generators]})


# ---- error sources -----------------------------------------------------------------------------

@dataclass(frozen=True)
class Shares:
    """What the drift of an observable comes from.

    Attributes
    ----------
    trend : Trend
        Along the whole run.
    share : dict of str to float
        Of the change, 0 to 1, by source: ``'motion'``, ``'truncation'``, ``'branches'``,
        ``'coefficients'``, ``'solver'``, ``'rounding'``, which add up to 1, and ``'projection'``;
        NaN: not known.
    margin : dict of str to float
        Half the 95 % interval of a share.
    how : dict of str to str
        How a share was found, in words.
    is_motion : bool
        The motion itself makes at least half of the change.
    is_conserved : bool
        The exact motion conserves the observable.
    sentence : str
        What the observable does, and by which sources.
    """

    trend: Trend
    share: dict[str, float]
    margin: dict[str, float]
    how: dict[str, str]
    is_motion: bool
    is_conserved: bool
    sentence: str


def summarise(budget: Any, observable: int) -> str:
    buffer = ffi.new('char[]', 1024)
    return text_of(lib.dal_error_budget_summarise(budget, observable, buffer, len(buffer)))


def describe(budget: Any, observable: int, source: int) -> str:
    buffer = ffi.new('char[]', 1024)
    return text_of(lib.dal_error_budget_describe(budget, observable, source, buffer, len(buffer)))


@takes_run_options
def explain(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
            quad_steps: int = 10000, **settings: Any) -> dict[str, Shares]:
    """Finds how much of the drift of every observable is truncation, solver, rounding, projection.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`.
    time : float, optional
        A whole number of steps.
    quad_steps : int
        The first steps are taken in quad precision as well; 0: none.

    Returns
    -------
    dict of str to Shares
        By the names of the observables.
    """
    spec = Spec(system, integrator, **settings)
    made = ffi.new('dal_error_budget **')
    observer = ffi.new('dal_error_budget_observer *', {'step': lib.python_progress})
    call_steps(lib.dal_error_budget_create, made, spec.c, spec.steps(spec.time(time)),
               whole('quad_steps', quad_steps, 0), observer)
    budget = ffi.gc(made[0], lib.dal_error_budget_free)
    sources = {i: text_of(lib.dal_error_source_name(i)) for i in range(lib.DAL_ERROR_SOURCES)}
    found = {}
    for i in range(budget.observables):
        shares = budget.shares[i]
        found[text_of(shares.name)] = Shares(
            make_trend(shares.whole), {name: shares.share[k] for k, name in sources.items()},
            {name: shares.margin[k] for k, name in sources.items()},
            {name: describe(budget, i, k) for k, name in sources.items()}, bool(shares.is_motion),
            bool(shares.is_conserved), summarise(budget, i))
    return found


# ---- generated C -------------------------------------------------------------------------------

@takes_run_options
def generate(system: SystemLike, integrator: str | None = None, *, lanes: int = 1,
             prefix: str | None = None, field: bool = False, **settings: Any) -> str:
    """Writes one C file that steps a system by a method, with the bits of a `Run`.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`; its parameters and start are the defaults of the file.
    lanes : int
        Systems at a time: 1, 2, 4, 8 or 16.
    prefix : str, optional
        Begins every public name.
    field : bool
        Adds functions of a point: F, its Jacobian, D and A, E.

    Returns
    -------
    str
        The file; its first comment explains its use.
    """
    spec = Spec(system, integrator, **settings)
    name = ffi.NULL if prefix is None else ffi.new('char[]', encode(text('prefix', prefix)))
    return taken_text(lib.dal_generate, spec.c, ffi.new('dal_generate_options *', {
        'lanes': whole('lanes', lanes, 1, MAX_INT), 'prefix': name, 'with_field': bool(field)}))
