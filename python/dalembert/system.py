"""Systems from text, from files and built-in."""
from __future__ import annotations

import math
import os
from typing import Any, Iterator, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from ._library import ffi, lib
from .arguments import Settings
from .arguments import text as argument
from .errors import Error, InputError, call, encode
from .evaluate import Array, evaluate
from .fixed import Fixed, borrowed, owned

PROPERTIES = tuple(name for name in dir(lib) if name.startswith(('DAL_D_', 'DAL_E_'))
                   ) + ('DAL_AUTONOMOUS', 'DAL_MASS_CONSTANT', 'DAL_VAKONOMIC', 'DAL_SERVO')



def text_of(chars: Any) -> str:
    """A text of the library, '' for NULL."""
    return ffi.string(chars).decode() if chars else ''


def taken_text(function: Any, *arguments: Any) -> str:
    """The text that a function of the library allocates."""
    made = ffi.new('char **')
    call(function, *arguments, made)
    try:
        return text_of(made[0])
    finally:
        lib.free(made[0])


def builtin_systems() -> list[str]:
    """Names of the systems of the library."""
    return list(_names(lib.dal_builtin_name))


def _names(name_at: Any) -> Iterator[str]:
    i = 0
    while (name := name_at(i)) != ffi.NULL:
        yield text_of(name)
        i += 1


EFFORTS = tuple(text_of(lib.dal_effort_name(i)) for i in range(lib.DAL_EFFORT_COUNT))
MECHANICS = tuple(name[len('DAL_MECHANICS_'):].lower().replace('_', '-') for name in sorted(
    (name for name in dir(lib) if name.startswith('DAL_MECHANICS_') and name != 'DAL_MECHANICS_COUNT'),
    key=lambda name: getattr(lib, name)))


class Choices(NamedTuple):
    """What is chosen of a system beside its text."""

    effort: str = EFFORTS[0]
    mechanics: str = MECHANICS[0]
    gauge: str = ''


class Constraints(NamedTuple):
    """D = 0 at points; see `System.constraints`."""

    D: Array
    A: Array
    reactions: Array


def made_system(text: str, name: str, observed: tuple[str, ...], choices: Choices) -> System:
    """A system with these choices that observes these formulas: a copy, or one from a pickle."""
    system = object.__new__(System)
    system._make(text, name, observed, choices)
    return system


class System(Fixed):
    """A mechanical system: coordinates, Lagrangian, forces and constraints.

    Parameters
    ----------
    text : str
        YAML, as in a system file.
    name : str, optional
        For messages.

    Raises
    ------
    InputError
        With the line and the column of what cannot be used.

    Attributes
    ----------
    name, title, reference, text : str
    n, m : int
        Coordinates; constraints.
    lagrangian : str
        Its formula; '' where the text gives accelerations.
    coordinates, invariants, observed, tags, events : tuple of str
        An event is named ``'event 1 (y - r)'``; what is observed, by its formula.
    parameters : dict of str to float
        Default values.
    properties : frozenset of str
        What is known of the constraints and of the energy, as ``'D_LINEAR'``.
    effort : str
        Of the lift, see `with_effort`.
    mechanics : str
        By which the text is read, see `with_mechanics`.
    gauge : str
        Of the lift, see `with_gauge`; '' where it is the text's.
    defaults : dict of str to str
        Method, step and time of a run that shows the motion, where the file gives them.

    Notes
    -----
    The attributes are read-only.
    """

    name: str
    title: str
    reference: str
    text: str
    n: int
    m: int
    lagrangian: str
    coordinates: tuple[str, ...]
    invariants: tuple[str, ...]
    observed: tuple[str, ...]
    effort: str
    mechanics: str
    gauge: str
    tags: tuple[str, ...]
    events: tuple[str, ...]
    parameters: dict[str, float]
    properties: frozenset[str]
    defaults: dict[str, str]
    _model: Any
    _system: Any

    def __init__(self, text: str, name: str = 'system'):
        self._make(argument('text', text), argument('name', name), (), Choices())

    def _make(self, text: str, name: str, observed: tuple[str, ...], choices: Choices) -> None:
        self.name, self.text, self.observed = name, text, observed
        self.effort, self.mechanics, self.gauge = choices
        self._model = self._read()
        for number, formula in enumerate(observed, 1):
            call(lib.dal_model_observe, self._model, encode(formula), number, 1)
        self._system = self._derive(self._model)
        s = self._system
        self.title, self.reference = text_of(s.title), text_of(s.reference)
        self.n, self.m = s.n, s.m
        self.lagrangian = text_of(lib.dal_model_text(self._model, lib.DAL_SECTION_LAGRANGIAN, 0, *[ffi.NULL] * 3))
        self.coordinates = tuple(text_of(s.coordinate[i]) for i in range(s.n))
        self.invariants = tuple(text_of(s.invariant[i]) for i in range(s.invariants - s.observed))
        self.tags = tuple(text_of(s.tag[i]) for i in range(s.tags))
        self.events = tuple(text_of(s.event[i].name) for i in range(s.events))
        self.parameters = {text_of(s.parameter[i]): s.value[i] for i in range(s.parameters)}
        self.properties = frozenset(name[4:] for name in PROPERTIES if s.properties & getattr(lib, name))
        self.defaults = self._read_defaults()

    @classmethod
    def builtin(cls, name: str) -> System:
        """A system of the library, ``'chaplygin-sleigh'``; see `builtin_systems`."""
        text = lib.dal_builtin_text(encode(argument('name', name)))
        if not text:  # the message has the nearest name
            model = ffi.new('dal_model **')
            call(lib.dal_model_builtin, model, encode(name))
        return cls(text_of(text), name)

    @classmethod
    def from_file(cls, path: str | os.PathLike[str]) -> System:
        """The system of a file, with the files of its tables in `text`."""
        model, length = ffi.new('dal_model **'), ffi.new('size_t *')
        with open(path, encoding='utf-8'):  # an error of Python's own where there is none
            call(lib.dal_model_read_file, model, os.fsencode(path))
        read = owned(model[0], lib.dal_model_free)
        return cls(text_of(lib.dal_model_source(read, length)), os.fspath(path))

    def observe(self, *formulas: str) -> System:
        """The same system with formulas that its runs observe, too.

        Parameters
        ----------
        *formulas : str
            ``'abs(h1) - 0.3*m'``, with the names that an invariant may use.  Their values need not
            be conserved; their columns are named by their texts.

        Returns
        -------
        System
            Its runs have the same bits as runs of this system.

        Raises
        ------
        InputError
            With the number of the formula as the line, and the column in it.
        TypeError
            A formula is not a str.
        """
        for formula in formulas:
            if not isinstance(formula, str):
                raise TypeError(f'a formula to observe is a str, not {formula!r}')
        return made_system(self.text, self.name, self.observed + formulas, self._choices())

    def with_effort(self, effort: str) -> System:
        """The same system with another K of the lift, H = pi.K pi/(2e) + pi.F + p.v + mu_e pi_e.

        Parameters
        ----------
        effort : str
            ``'identity'``, ``'mass'``, ``'constraint'`` or ``'controls'``, the columns that the
            system names under ``controls``.

        Returns
        -------
        System
            Where p = pi = 0 its runs have the same bits as runs of this system.

        Raises
        ------
        InputError
            The system has no such effort: no controls, a singular mass matrix, vakonomic motion.
        ValueError
            Another word.
        """
        if effort not in EFFORTS:
            raise ValueError(f"effort: {effort!r} is not one of {', '.join(EFFORTS)}")
        return made_system(self.text, self.name, self.observed, self._choices()._replace(effort=effort))

    def with_mechanics(self, mechanics: str) -> System:
        """The same Lagrangian and constraints, read by another mechanics.

        Parameters
        ----------
        mechanics : str
            ``'lagrange-dalembert'``, ``'vakonomic'``, or ``'system'``, what the text says.

        Returns
        -------
        System
            Where that is not the mechanics of the text it has no exact solution, and its invariants
            are observed, not expected to hold.

        Raises
        ------
        InputError
            The system cannot be read so: accelerations, reactions or impacts with ``'vakonomic'``.
        ValueError
            Another word.
        """
        if mechanics not in MECHANICS:
            raise ValueError(f"mechanics: {mechanics!r} is not one of {', '.join(MECHANICS)}")
        return made_system(self.text, self.name, self.observed, self._choices()._replace(mechanics=mechanics))

    def with_gauge(self, gauge: str) -> System:
        """The same system with another gauge of the lift.

        Parameters
        ----------
        gauge : str
            ``'e = 1, mu_e = 0.1*cos(t)'``: e > 0 at the start, and its rate.  What is not named is 1,
            and 0; ``''``: as the text has it.

        Returns
        -------
        System
            Where p = pi = 0 its runs have the same bits of q and v as runs of this system.

        Raises
        ------
        InputError
            With line 1 and the column of what cannot be used.
        """
        return made_system(self.text, self.name, self.observed, self._choices()._replace(gauge=argument('gauge', gauge)))

    def _choices(self) -> Choices:
        return Choices(self.effort, self.mechanics, self.gauge)

    def _at(self, name: str, callback: Any, shape: tuple[int, ...], q: ArrayLike, v: ArrayLike, t: ArrayLike,
            parameters: Settings | None) -> Any:
        """The numbers of a callback at points, of a shape."""
        if callback == ffi.NULL:
            raise InputError('DAL_UNSUPPORTED', f'{self.name} has no {name}')
        values = evaluate(self._system, callback, math.prod(shape), q, v, t, parameters)
        return values.reshape(values.shape[:-1] + shape)

    def field(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0, *, parameters: Settings | None = None) -> Array:
        """The accelerations F, of the second-order system dv/dt = F(q, v, t).

        Parameters
        ----------
        q, v : array_like, (..., n)
            Coordinates and velocities; of a vakonomic system v has the multipliers g, too.
        t : array_like, (...)
        parameters : mapping of str to float, optional
            Those that differ from their default.

        Returns
        -------
        ndarray, (..., n)
            NaN where F has no value; of a vakonomic system with dg/dt.  The shapes before the last
            axis are broadcast, here and in the functions below.
        """
        s = self._system
        return self._at('field', s.call.field, (s.n + s.multipliers,), q, v, t, parameters)

    def jacobian(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0, *,
                 parameters: Settings | None = None) -> Array:
        """The derivatives of F by q and v: (..., n, 2 n), [F_q F_v]; see `field`."""
        s = self._system
        width = s.n + s.multipliers
        values = self._at('jacobian', s.call.jacobian, (width * (s.n + width),), q, v, t, parameters)
        by_q, by_v = np.split(values, [width * s.n], axis=-1)
        return np.concatenate([by_q.reshape(values.shape[:-1] + (width, s.n)),
                               by_v.reshape(values.shape[:-1] + (width, width))], axis=-1)

    def energy(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0, *, parameters: Settings | None = None) -> Array:
        """The energy E = L_v.v - L: (...); see `field`."""
        return self._at('energy', self._system.energy, (), q, v, t, parameters)

    def energy_gradient(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0, *,
                        parameters: Settings | None = None) -> Array:
        """The derivatives of E by q and v: (..., 2 n), [E_q E_v]; see `field`."""
        n = self.n
        return self._at('energy', self._system.call.energy_normal, (1 + 3 * n,), q, v, t, parameters)[..., 1:1 + 2 * n]

    def constraints(self, q: ArrayLike, v: ArrayLike, t: ArrayLike = 0.0, *,
                    parameters: Settings | None = None) -> Constraints:
        """D(q, v, t), A = D_v, and W^-1 A^T, the accelerations by unit multipliers; see `field`.

        Returns
        -------
        Constraints
            A named tuple of ``D`` (..., m), ``A`` (..., m, n), ``reactions`` (..., n, m).
        """
        n, m = self.n, self.m
        values = self._at('constraints', self._system.call.constraint, (m + 2 * m * n,), q, v, t, parameters)
        D, A, R = np.split(values, [m, m + m * n], axis=-1)
        shape = values.shape[:-1]
        return Constraints(D, A.reshape(shape + (m, n)), R.reshape(shape + (n, m)))

    def latex(self) -> str:
        """The equations as LaTeX, one align* of amsmath.

        They are L, the forces Q, the constraints D = 0, the accelerations F derived from them, and
        the Hamiltonian H of the lift.
        """
        return taken_text(lib.dal_model_latex, self._model)

    def __reduce__(self) -> Any:
        return made_system, (self.text, self.name, self.observed, self._choices())

    def _read(self) -> Any:
        model, text = ffi.new('dal_model **'), self.text.encode()
        call(lib.dal_model_read, model, encode(self.name), text, len(text))
        read = owned(model[0], lib.dal_model_free)
        call(lib.dal_model_set_effort, read, EFFORTS.index(self.effort))
        call(lib.dal_model_set_mechanics, read, MECHANICS.index(self.mechanics))
        if self.gauge:
            call(lib.dal_model_set_gauge, read, encode(self.gauge))
        return read

    @staticmethod
    def _derive(model: Any) -> Any:
        system = ffi.new('dal_system **')
        call(lib.dal_model_system, model, system)
        return borrowed(system[0], model)

    def _read_defaults(self) -> dict[str, str]:
        found, name = {}, ffi.new('char **')
        i = 0
        while text := text_of(lib.dal_model_text(self._model, lib.DAL_SECTION_DEFAULTS, i, name,
                                                 ffi.NULL, ffi.NULL)):
            found[text_of(name[0])] = text
            i += 1
        return found

    def _tangent(self) -> Any:
        """The tangent system."""
        system = ffi.new('dal_system **')
        call(lib.dal_model_tangent, self._model, system)
        return system[0]

    def _with_invariant(self, formula: str) -> System:
        """The same system with one more invariant, the last; errors have columns of the formula."""
        used, number = {*self.coordinates, *self.invariants, *self.parameters}, 1
        while (name := f'section_{number}') in used:
            number += 1
        left, equals, right = formula.partition('=')
        text = f'({left})-({right})' if equals else f'({formula})'
        other = object.__new__(System)
        other.name, other.text = self.name, self.text
        other.effort, other.mechanics, other.gauge = self._choices()
        other._model = other._read()
        try:
            call(lib.dal_model_add, other._model, lib.DAL_SECTION_INVARIANTS, name.encode(),
                 encode(text), 1, 1)
            other._system = self._derive(other._model)
        except Error as error:
            # What follows '=' has three more characters before it: '(' and ')-(' for '='.
            column = (error.column or 0) - (1 if (error.column or 0) <= len(left) + 1 else 3)
            message = error.message.replace(f'invariant {name}: ', '', 1)
            raise type(error)(error.status, message, 1, max(1, column)) from None
        return other

    def __repr__(self) -> str:
        return f'<System {self.name}: {self.n} coordinates, {self.m} constraints>'
