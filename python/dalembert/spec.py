"""What a run is made from: system, method, options, parameters, start."""
from __future__ import annotations

from typing import Any, Iterator, Literal, Mapping, Optional, TypedDict, Union, get_args

from ._library import ffi, lib
from .arguments import Settings, keywords, make_settings, number, refuse, text
from .errors import call, encode
from .fixed import owned
from .system import System, text_of

SystemLike = Union[System, str]


class Options(TypedDict, total=False):
    """Options of a run, as on the command line, with underscores."""

    space: Literal['lifted', 'physical']
    solver: Literal['auto', 'fixed-point', 'newton']
    iterations: int
    extend_energy: bool
    reactions: bool
    consistent: bool
    bare: bool
    tolerance: float
    solver_tolerance: float
    extra_iterations: int
    sums: Literal['compensated', 'plain']
    precision: Literal['double', 'quad']


class RunOptions(Options, total=False):
    """What a run takes beside system and integrator."""

    step: Optional[float]
    parameters: Optional[Mapping[str, float]]
    start: Optional[Mapping[str, float]]
    start_time: float


def default_of(name: str, hint: Any) -> Any:
    """The default of an option, by the library."""
    if name not in Options.__annotations__:
        return 0.0 if name == 'start_time' else None
    value = getattr(lib.dal_options_default(), name)
    return get_args(hint)[int(value)] if get_args(hint) else value


takes_options = keywords(Options, default_of)
takes_run_options = keywords(RunOptions, default_of)


def names_where(modifier: bool) -> list[str]:
    """Names of the modifiers of the library, or of its integrators."""
    found, i = [], 0
    while (integrator := lib.dal_integrator_at(i)) != ffi.NULL:
        if bool(integrator.properties & lib.DAL_MODIFIER) == modifier:
            found.append(text_of(integrator.name))
        i += 1
    return found


def integrators() -> list[str]:
    """Names of the integrators of the library; see `modifiers`."""
    return names_where(modifier=False)


def modifiers() -> list[str]:
    """Names of the modifiers of the library, ``'project'``: a method is ``'rk4+project'``."""
    return names_where(modifier=True)


def option_text(value: Any) -> str:
    if isinstance(value, bool):
        return 'on' if value else 'off'
    return repr(float(value)) if isinstance(value, float) else str(value)


def names_of(name_at: Any, run: Any, count: int) -> tuple[str, ...]:
    buffer = ffi.new('char[]', 256)
    return tuple(text_of(name_at(run, i, buffer, len(buffer))) for i in range(count))


def time_or_default(system: System, time: float | None) -> float:
    """A time, or the default one of the system."""
    if time is None:
        if 'time' not in system.defaults:
            raise refuse('time', f'{system.name} has no default: give one')
        time = float(system.defaults['time'])
    return number('time', time)


class Spec:
    """A dal_run_spec with all that it points to."""

    def __init__(self, system: SystemLike, integrator: str | None, step: float | None = None,
                 parameters: Settings | None = None, start: Settings | None = None,
                 start_time: float = 0.0, **options: Any):
        self.system = system if isinstance(system, System) else System.builtin(text('system', system))
        defaults = self.system.defaults
        integrator = integrator or defaults.get('integrator')
        if integrator is None:
            raise refuse('integrator', f'{self.system.name} has no default: give one')
        self.c = ffi.new('dal_run_spec *')
        self.use(self.system)
        self.c.options = lib.dal_options_default()
        call(lib.dal_method_parse, ffi.addressof(self.c, 'method'), encode(text('integrator', integrator)))
        if step is None and 'step' in defaults:
            step = float(defaults['step'])
        for name, value in {**({} if step is None else {'step': number('step', step)}), **options}.items():
            call(lib.dal_options_set, ffi.addressof(self.c, 'options'), encode(name.replace('_', '-')),
                 encode(option_text(value)))
        self.c.start_time = number('start_time', start_time)
        # Both must live as long as the spec.
        self._parameters = make_settings('parameters', parameters)
        self._start = make_settings('start', start)
        self.c.parameters, self.c.parameter_count = self._parameters[:2]
        self.c.start, self.c.start_count = self._start[:2]

    def use(self, system: System) -> None:
        """Takes another system, which has the coordinates of the first."""
        self._system = system._system
        self.c.system = self._system

    def create_run(self) -> tuple[Any, tuple[str, ...], tuple[str, ...]]:
        """A dal_run, the names of its state and of its observables."""
        made = ffi.new('dal_run **')
        call(lib.dal_run_create, made, self.c)
        run = owned(made[0], lib.dal_run_free, self._system)
        return (run, names_of(lib.dal_run_component_name, run, lib.dal_run_dimension(run)),
                names_of(lib.dal_run_observable_name, run, lib.dal_run_observables(run)))

    @property
    def step(self) -> float:
        return self.c.options.step

    @property
    def integrator(self) -> str:
        buffer = ffi.new('char[]', 256)
        return text_of(lib.dal_method_name(ffi.addressof(self.c, 'method'), buffer, len(buffer)))

    def time(self, time: float | None) -> float:
        """A time, or the default one of the system."""
        return time_or_default(self.system, time)

    def steps(self, time: float) -> int:
        """The number of steps to a time, which it must be a whole number of."""
        steps = lib.dal_whole_steps(self.c.start_time, time, self.step)
        if steps == 0:
            raise refuse('time', f'{time:g} is not a whole number of steps of {self.step:g}')
        return steps


def chunks(count: int, size: int) -> Iterator[int]:
    """count in parts, between which Python handles signals."""
    while count > 0:
        yield min(count, size)
        count -= size
