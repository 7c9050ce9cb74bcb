"""Runs and batches."""
from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any, Mapping, Union

import numpy as np
import numpy.typing as npt

from ._library import ffi, lib
from .arguments import Settings, array, make_settings, number, refuse, text, whole
from .errors import Error, InputError, call, call_steps, check, encode, keep_exception, make_error, refuse_nul
from .fixed import Fixed, owned
from .progress import Progress
from .spec import Spec, SystemLike, chunks, takes_options, takes_run_options
from .system import System, text_of

Array = npt.NDArray[np.float64]

# Steps between two moments in which Python handles signals: less than a second.
CHUNK = 10000


def doubles(array: Array) -> Any:
    """The memory of an array for the library, which may write there."""
    return ffi.from_buffer('double[]', array, require_writable=array.flags.writeable)


def native_options(cache: str | os.PathLike[str] | None, compiler: str) -> tuple[Any, Any]:
    """dal_native_options, and the texts that must live as long."""
    if cache is None:
        above = os.environ.get('XDG_CACHE_HOME') or os.path.join(os.path.expanduser('~'), '.cache')
        os.makedirs(above, mode=0o700, exist_ok=True)
        cache = os.path.join(above, 'dalembert')
    texts = ffi.new('char[]', refuse_nul(os.fsencode(cache))), ffi.new('char[]', encode(compiler))
    return ffi.new('dal_native_options *', {'cache': texts[0], 'compiler': texts[1],
                                            'stop': lib.python_stop}), texts


def is_consistent(status: int, record: Any) -> bool:
    """What the status of a parameter that was set says; others are raised."""
    if status != lib.DAL_STATUS_INCONSISTENT:
        check(status, record)
    return status != lib.DAL_STATUS_INCONSISTENT


@dataclass(frozen=True)
class Event:
    """An event of a run.

    Attributes
    ----------
    event : int
        Its place in ``System.events``.
    name : str
        ``'event 1 (y - r)'``.
    t : float
    direction : int
        1: its formula increased along the run, -1: it decreased.
    before, state : ndarray
        The state before and after it, [dimension].
    """

    event: int
    name: str
    t: float
    direction: int
    before: Array
    state: Array


def state_at(numbers: Any, dimension: int) -> Array:
    """A copy of a state."""
    return np.frombuffer(ffi.buffer(numbers, 8 * dimension), dtype=np.float64).copy()


class Watch:
    """What keeps the events of a run, and a bar that follows its time."""

    def __init__(self, names: tuple[str, ...], dimension: int, bar: Progress | None = None):
        self.events: list[Event] = []
        self.show = bar.show if bar else lambda time: None
        self._names, self._dimension = names, dimension

    def add(self, run: Any, event: Any) -> None:
        """Adds an event."""
        self.events.append(Event(event.event, self._names[event.event], event.t, event.direction,
                                 state_at(event.before, self._dimension),
                                 state_at(lib.dal_run_state(run), self._dimension)))


@ffi.def_extern(error=lib.DAL_STATUS_INTERRUPTED, onerror=keep_exception)
def python_event(user: Any, run: Any, event: Any) -> int:
    """Adds an event to the watch that user is a handle of."""
    ffi.from_handle(user).add(run, event)
    return lib.DAL_STATUS_OK


class Table:
    """Rows of t, state and observables that a run fills."""

    def __init__(self, run: Run, rows: int):
        self.names = ('t',) + run.names + run.observable_names
        self.values = np.empty((rows, len(self.names)))

    def rows(self, made: int) -> npt.NDArray[np.void]:
        """The first rows, as a structured array with the columns of ``dalembert run``."""
        kept = [i for i, name in enumerate(self.names) if not name.startswith('|')]
        columns = np.dtype({'names': [self.names[i] for i in kept], 'formats': ['f8'] * len(kept),
                            'offsets': [8 * i for i in kept], 'itemsize': 8 * len(self.names)})
        return self.values.view(columns)[:made, 0]


class Run(Fixed):
    """One motion of a system by a method.

    Parameters
    ----------
    system : System or str
        A system, or the name of a built-in one.
    integrator : str, optional
        ``'rk4'``, ``'gauss8+project'``; the default is the system file's.
    step : float, optional
        Step size h, negative: backwards in t; the default is the system file's, or 0.01.
    parameters : mapping of str to float, optional
        Those that differ from their default.
    start : mapping of str to float, optional
        Components of the state, ``{"x'": 0.5}``; the system gives the rest.
    start_time : float
        t of the start.
    **options
        Options of the command line, with underscores: ``space='physical'``,
        ``solver_tolerance=1e-12``, ``precision='quad'``.

    Attributes
    ----------
    system : System
    integrator : str
    names, observable_names : tuple of str
        Of the components of the state, and of the observables.
    dimension : int
        Numbers in a state.

    Notes
    -----
    While steps are taken other threads of Python run.  A run itself belongs to one thread at a time.
    The attributes are read-only.
    """

    system: System
    integrator: str
    names: tuple[str, ...]
    observable_names: tuple[str, ...]
    dimension: int
    _run: Any
    _arguments: tuple[tuple[System, str], dict[str, Any]]

    @takes_options
    def __init__(self, system: SystemLike, integrator: str | None = None, *, step: float | None = None,
                 parameters: Settings | None = None, start: Settings | None = None,
                 start_time: float = 0.0, **options: Any):
        spec = Spec(system, integrator, step, parameters, start, start_time, **options)
        self.system, self.integrator = spec.system, spec.integrator
        self._arguments = (self.system, self.integrator), {
            'step': spec.step, 'parameters': dict(parameters or {}), 'start': dict(start or {}),
            'start_time': start_time, **options}
        self._run, self.names, self.observable_names = spec.create_run()
        self.dimension = len(self.names)

    @property
    def time(self) -> float:
        """The present time."""
        return lib.dal_run_time(self._run)

    @property
    def step(self) -> float:
        """The step size h."""
        return lib.dal_run_step_size(self._run)

    @property
    def steps(self) -> int:
        """Steps since the start."""
        return lib.dal_run_steps(self._run)

    @property
    def evaluations(self) -> int:
        """Evaluations of the field since the start."""
        return lib.dal_run_evaluations(self._run)

    @property
    def state(self) -> Array:
        """A copy of the present state, [dimension], ordered as `names`."""
        return state_at(lib.dal_run_state(self._run), self.dimension)

    def set_state(self, state: npt.ArrayLike, time: float | None = None) -> None:
        """Replaces the state and, where it is given, the time; clears all other memory of steps."""
        values = array('state', state)
        if values.shape != (self.dimension,):
            raise refuse('state', f'it has shape ({self.dimension},), not {values.shape}')
        call(lib.dal_run_set_state, self._run, self.time if time is None else number('time', time), doubles(values))

    @property
    def observables(self) -> Array:
        """D1, .., E, H, norms, invariants, what is observed and the error, ordered as `observable_names`."""
        values = np.empty(len(self.observable_names))
        check(lib.dal_run_observe(self._run, doubles(values)), ffi.new('dal_error *'), stepping=True)
        return values

    @property
    def parameters(self) -> dict[str, float]:
        """The parameter values."""
        values, system = lib.dal_run_parameters(self._run), lib.dal_run_system(self._run)
        return {text_of(system.parameter[i]): values[i] for i in range(system.parameters)}

    def index(self, name: str) -> int:
        """The place in `state` of a component, ``"phi'"``."""
        place = lib.dal_run_component_index(self._run, encode(text('name', name)))
        if place < 0:
            raise InputError('DAL_NAME', f"no component of the state is named '{name}'")
        return place

    def set_parameter(self, name: str, value: float) -> bool:
        """Sets a parameter between two steps.

        Returns
        -------
        bool
            Whether the constraints hold at the present state with this value.

        Raises
        ------
        InputError
            The value cannot be used; nothing is changed.
        """
        record = ffi.new('dal_error *')
        return is_consistent(lib.dal_run_set_parameter(
            self._run, encode(text('name', name)), number('value', value), record), record)

    def advance(self, steps: int = 1) -> None:
        """Takes a number of steps, or those before the first that fails.

        An event that stops the run ends the call; see `stopped`.

        Raises
        ------
        StepError
            Names the constraint and the time; the run is as it was before that step.
        """
        for count in chunks(whole('steps', steps, 0), CHUNK):
            self._call(lib.dal_run_advance, self._run, count)
            if self.stopped is not None:
                return

    def _call(self, function: Any, *arguments: Any) -> None:
        """Calls a function that takes steps, unless an event has stopped the run; one may."""
        was_stopped = self.stopped is not None
        try:
            call_steps(function, *arguments)
        except Error as error:
            if error.status != 'DAL_STOPPED' or was_stopped:
                raise

    def events(self, time: float) -> list[Event]:
        """Advances the run to a time and gives the events on the way.

        An event that stops the run is the last one.

        Raises
        ------
        StepError
            Its ``partial`` has the events before the failure, as of a ball that comes to rest.
        """
        watch = Watch(self.system.events, self.dimension)
        handle = ffi.new_handle(watch)
        try:
            self._call(lib.python_sample, self._run, number('time', time), 1,
                       ffi.new('python_request *', {'user': handle}))
        except Error as error:
            error.partial = watch.events
            raise
        return watch.events

    @property
    def event_counts(self) -> tuple[int, ...]:
        """How often each event of the system has happened."""
        return tuple(lib.dal_run_event_count(self._run, i) for i in range(len(self.system.events)))

    @property
    def stopped(self) -> int | None:
        """The event that stopped the run, by its place in ``System.events``; None: none did."""
        return lib.dal_run_stopped(self._run) - 1 if lib.dal_run_stopped(self._run) else None

    @property
    def jumps(self) -> Array:
        """What events have added to E and to the invariants, 0 elsewhere; ordered as `observables`."""
        return np.array([lib.dal_run_event_jump(self._run, i) for i in range(len(self.observable_names))])

    def trajectory(self, times: npt.ArrayLike) -> npt.NDArray[np.void]:
        """Advances the run and gives a row at each time.

        The run takes steps h only, and ends at the last step before the last time.  A shorter
        step of the same method gives a row between two steps.

        Parameters
        ----------
        times : array_like
            From the present time on, in the direction of the step.

        Returns
        -------
        numpy structured array
            With the columns of ``dalembert run``: ``rows['t']``, ``rows["x'"]``, ``rows['D1']``.
            Where an event stops the run, its row is the last.

        Raises
        ------
        StepError
            Its ``partial`` has the rows before the failure.
        """
        when = array('times', times)
        direction = np.sign(self.step)
        if when.ndim != 1 or len(when) == 0 or not np.all(direction * np.diff(when) > 0):
            order = 'increasing' if direction > 0 else 'decreasing'
            raise refuse('times', f'they must be {order} numbers, one at least')
        if not direction * (when[0] - self.time) >= -1e-9 * abs(self.step):
            raise refuse('times', f'{when[0]:g} lies before the present t = {self.time:g}')
        table = Table(self, len(when))
        request = ffi.new('python_request *', {'times': doubles(when), 'rows': doubles(table.values)})
        try:
            self._call(lib.python_sample, self._run, when[-1], len(when), request)
        except Error as error:
            error.partial = table.rows(request.made)
            raise
        return table.rows(request.made)

    def save(self) -> bytes:
        """All that passes from one step to the next."""
        count = ffi.new('size_t *')
        numbers = lib.dal_run_save(self._run, count)
        return bytes(ffi.buffer(numbers, 8 * count[0]))

    def restore(self, saved: bytes) -> None:
        """Continues where a run of the same system, method and options was saved, with the same bits."""
        if not isinstance(saved, bytes) or len(saved) % 8:
            raise refuse('saved', f'{saved!r:.40} is not what save gives')
        numbers = np.frombuffer(saved, dtype=np.float64)
        call(lib.dal_run_restore, self._run, doubles(numbers), len(numbers))

    def __reduce__(self) -> Any:
        return continued, (type(self), *self._arguments, self.save())

    def compile(self, cache: str | os.PathLike[str] | None = None, compiler: str = 'cc') -> None:
        """Compiles the steps, with the same bits; for runs of a second and more.

        Parameters
        ----------
        cache : path, optional
            A directory of this user alone; the default is the program's.
        compiler : str, optional
            A C compiler.
        """
        options, _texts = native_options(cache, compiler)
        call(lib.dal_run_native, self._run, options)

    @property
    def is_compiled(self) -> bool:
        """Whether the steps are compiled."""
        return bool(lib.dal_run_is_native(self._run))

    def __repr__(self) -> str:
        return f'<Run of {self.system.name} by {self.integrator}, h = {self.step:g}, t = {self.time:g}>'


def continued(kind: type[Run], arguments: Any, options: dict[str, Any], saved: bytes) -> Run:
    """A run that continues where another one was saved: a copy, or one from a pickle."""
    run = kind(*arguments, **options)
    run.restore(saved)
    return run


LaneValues = Mapping[str, Union[float, npt.ArrayLike]]


def count_lanes(count: int | None, *values: LaneValues | None) -> int:
    """The length of the arrays among the values, which must be one."""
    count = None if count is None else whole('count', count, 1)
    lengths = {len(np.atleast_1d(value)) for group in values for value in (group or {}).values()
               if np.ndim(value) > 0}
    lengths |= set() if count is None else {count}
    if len(lengths) > 1:
        raise refuse('parameters, start', f'they have different numbers of lanes: {sorted(lengths)}')
    lanes = lengths.pop() if lengths else 1
    if lanes < 1:
        raise refuse('parameters, start', 'a batch has one lane at least')
    return lanes


def lane(values: LaneValues | None, i: int) -> dict[str, float]:
    """The values of one lane."""
    return {name: np.asarray(value)[i] if np.ndim(value) else value  # type: ignore[misc]
            for name, value in (values or {}).items()}


class Batch(Fixed):
    """Many runs of one system and method, called lanes, that differ in parameters and start.

    Each lane has the bits of a single run.

    Parameters
    ----------
    system, integrator, step, **options
        As of a `Run`.
    count : int, optional
        The number of lanes; by default the length of the values given as arrays.
    parameters, start : mapping of str to float or array_like, optional
        A number for all lanes, or an array with one for each.

    Attributes
    ----------
    system : System
    integrator : str
    step : float
    count : int
        Lanes.
    names : tuple of str
        Of the components of a state.
    dimension : int
        Numbers in a state.
    """

    system: System
    integrator: str
    step: float
    count: int
    names: tuple[str, ...]
    dimension: int
    _batch: Any

    @takes_run_options
    def __init__(self, system: SystemLike, integrator: str | None = None, count: int | None = None, *,
                 step: float | None = None, parameters: LaneValues | None = None,
                 start: LaneValues | None = None, width: int = 0, **options: Any):
        self.count = count_lanes(count, parameters, start)
        spec = Spec(system, integrator, step, lane(parameters, 0), lane(start, 0), **options)
        self.system, self.integrator, self.step = spec.system, spec.integrator, spec.step
        self.names = spec.create_run()[1]
        self.dimension = len(self.names)
        batch = ffi.new('dal_batch **')
        call(lib.dal_batch_create, batch, spec.c, self.count, whole('width', width, 0, 1 << 20))
        self._batch = owned(batch[0], lib.dal_batch_free, self.system._system)
        for i in range(1, self.count):
            self._start(i, lane(parameters, i), lane(start, i))

    def _start(self, i: int, parameters: Settings, start: Settings) -> None:
        p, s = make_settings('parameters', parameters), make_settings('start', start)
        call(lib.dal_batch_start, self._batch, i, p[0], p[1], s[0], s[1])

    def set_parameter(self, name: str, values: float | npt.ArrayLike) -> npt.NDArray[np.bool_]:
        """Sets a parameter of all lanes, to a number or to one for each; see `Run.set_parameter`.

        Returns
        -------
        ndarray of bool, [lanes]
            Whether the constraints of a lane hold at its present state.
        """
        record = ffi.new('dal_error *')
        try:
            numbers = np.broadcast_to(array('values', values).squeeze(), self.count)
        except ValueError:
            raise refuse('values', f'a number or {self.count} of them') from None
        of = encode(text('name', name))
        statuses = (lib.dal_batch_set_parameter(self._batch, i, of, value, record)
                    for i, value in enumerate(numbers))
        return np.array([is_consistent(status, record) for status in statuses])

    def advance(self, steps: int = 1) -> None:
        """Takes steps in every lane that has not failed; `errors` names those that have.

        Raises
        ------
        StepError
            When no lane remains.
        """
        for count in chunks(whole('steps', steps, 0), max(100, CHUNK // self.count)):
            if lib.dal_batch_advance(self._batch, count) != lib.DAL_STATUS_OK:
                raise next(error for error in self.errors if error is not None)

    def state(self) -> Array:
        """The states of all lanes, [lanes, dimension]; of one that failed, that before the failure."""
        states = np.empty((self.count, self.dimension))
        lib.dal_batch_states(self._batch, doubles(states))
        return states

    @property
    def time(self) -> Array:
        """The present time of each lane, [lanes]."""
        return np.array([lib.dal_batch_time(self._batch, i) for i in range(self.count)])

    @property
    def errors(self) -> list[Exception | None]:
        """For each lane why its step failed, or None."""
        record, found = ffi.new('dal_error *'), []
        for i in range(self.count):
            failed = lib.dal_batch_status(self._batch, i, record) != lib.DAL_STATUS_OK
            found.append(make_error(record, stepping=True) if failed else None)
        return found

    def compile(self, cache: str | os.PathLike[str] | None = None, compiler: str = 'cc') -> None:
        """Compiles the steps, with the same bits; see `Run.compile`."""
        options, _texts = native_options(cache, compiler)
        call(lib.dal_batch_native, self._batch, options)

    @property
    def is_compiled(self) -> bool:
        """Whether the steps are compiled."""
        return bool(lib.dal_batch_is_native(self._batch))

    def __len__(self) -> int:
        return self.count

    def __reduce__(self) -> Any:
        raise TypeError('a Batch cannot be copied: keep its arguments and its state()')

    def __repr__(self) -> str:
        return f'<Batch of {self.count} lanes of {self.system.name} by {self.integrator}, h = {self.step:g}>'
