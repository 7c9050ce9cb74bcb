"""Arguments of functions: what is not of their kind is an InputError that names the argument."""
from __future__ import annotations

import difflib
import functools
import inspect
import operator
from typing import Any, Callable, Mapping, TypeVar, get_type_hints

import numpy as np
import numpy.typing as npt

from ._library import ffi
from .errors import InputError, encode

Settings = Mapping[str, float]

# The largest int of C.
MAX_INT = (1 << 31) - 1

Function = TypeVar('Function', bound=Callable[..., Any])


def refuse(name: str, reason: str) -> InputError:
    """The error of an argument."""
    return InputError('DAL_ARGUMENT', f'{name}: {reason}')


def number(name: str, value: Any) -> float:
    """An argument that is a number."""
    try:
        return float(value)
    except (TypeError, ValueError):
        raise refuse(name, f'{value!r} is not a number') from None


def whole(name: str, value: Any, low: int, high: int = (1 << 53) - 1) -> int:
    """An argument that is a whole number from low to high."""
    try:
        count = operator.index(value)
    except TypeError:
        raise refuse(name, f'{value!r} is not a whole number') from None
    if not low <= count <= high:
        raise refuse(name, f'{count} is not from {low} to {high}' if high <= MAX_INT else f'{count} is below {low}'
                     if count < low else f'{count} is too large')
    return count


def text(name: str, value: Any) -> str:
    """An argument that is a str."""
    if not isinstance(value, str):
        raise refuse(name, f'{value!r} is not a str')
    return value


def array(name: str, values: Any) -> npt.NDArray[np.float64]:
    """An argument that is an array of numbers."""
    try:
        return np.ascontiguousarray(values, dtype=np.float64)
    except (TypeError, ValueError):
        raise refuse(name, f'{values!r:.60} is not an array of numbers') from None


def make_settings(what: str, values: Settings | None) -> tuple[Any, int, list[Any]]:
    """An array of dal_setting, its length, and the texts that must live as long."""
    if values is not None and not isinstance(values, Mapping):
        raise refuse(what, f'{values!r} is not a mapping of names to numbers')
    items = list((values or {}).items())
    array = ffi.new('dal_setting[]', max(1, len(items)))
    texts = [ffi.new('char[]', encode(text(what, name))) for name, _ in items]
    for i, (name, value) in enumerate(items):
        array[i].name, array[i].value = texts[i], number(f'{what}[{name!r}]', value)
    return array, len(items), texts


def keywords(options: type, default: Callable[[str, Any], Any]) -> Callable[[Function], Function]:
    """Gives functions that end in ``**options`` the keywords of a TypedDict.

    They are in the signature, with their types and defaults, so that help and completion show them;
    any other keyword is an error that names it and the nearest one.
    """
    hints = get_type_hints(options)

    def decorate(function: Function) -> Function:
        signature = inspect.signature(function)
        own = [p for p in signature.parameters.values() if p.kind is not p.VAR_KEYWORD]
        given = {p.name for p in own}
        added = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, annotation=hint, default=default(name, hint))
                 for name, hint in hints.items() if name not in given]
        known = sorted(given | set(hints))

        @functools.wraps(function)
        def checked(*arguments: Any, **named: Any) -> Any:
            for name in named:
                if name not in known:
                    near = difflib.get_close_matches(name, known, 1)
                    raise InputError('DAL_NAME', f"{function.__qualname__} has no argument '{name}'"
                                     + (f"; did you mean '{near[0]}'?" if near else ''))
            return function(*arguments, **named)

        checked.__signature__ = signature.replace(parameters=own + added)  # type: ignore[attr-defined]
        return checked  # type: ignore[return-value]

    return decorate
