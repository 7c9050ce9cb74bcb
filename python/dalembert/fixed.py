"""Objects whose attributes are set once, and objects of the library that keep others alive."""
from __future__ import annotations

from typing import Any, ClassVar

from ._library import ffi


class Fixed:
    """An object whose declared attributes are read-only: the library relies on them."""

    _fixed: ClassVar[frozenset[str]] = frozenset()

    def __init_subclass__(cls) -> None:
        cls._fixed = cls._fixed | frozenset(cls.__annotations__)

    def __setattr__(self, name: str, value: Any) -> None:
        if name in self._fixed and name in self.__dict__:
            raise AttributeError(f"attribute '{name}' of a {type(self).__name__} is read-only")
        object.__setattr__(self, name, value)

    def __delattr__(self, name: str) -> None:
        if name in self._fixed:
            raise AttributeError(f"attribute '{name}' of a {type(self).__name__} is read-only")
        object.__delattr__(self, name)


def owned(pointer: Any, free: Any, *kept: Any) -> Any:
    """An object of the library that is freed with its last reference; what is kept lives as long."""
    def release(last: Any, _kept: tuple[Any, ...] = kept) -> None:
        free(last)
    return ffi.gc(pointer, release)


def borrowed(pointer: Any, *owners: Any) -> Any:
    """An object that its owners free; they live as long as it does."""
    return owned(pointer, lambda last: None, *owners)
