"""Bars of tqdm, where it is installed."""
from __future__ import annotations

import sys
from typing import Any


class Progress:
    """A bar that follows a number from begin to end.

    Parameters
    ----------
    shown : bool or None
        None: on a terminal, after a second.
    """

    def __init__(self, begin: float, end: float, shown: bool | None, unit: str):
        self._begin, self._bar = begin, _make_bar(abs(end - begin), shown, unit)

    def show(self, now: float) -> None:
        """Moves the bar."""
        if self._bar:
            self._bar.update(abs(now - self._begin) - self._bar.n)

    def __enter__(self) -> Progress:
        return self

    def __exit__(self, *exception: Any) -> None:
        if self._bar:
            self._bar.close()


def _make_bar(total: float, shown: bool | None, unit: str) -> Any:
    if shown is False or (shown is None and not sys.stderr.isatty()):
        return None
    try:
        from tqdm import tqdm
    except ImportError:
        return None
    return tqdm(total=total, unit=unit, leave=False, delay=0 if shown else 1,
                bar_format='{l_bar}{bar}| {n:.4g}/{total:.4g} {unit}, {remaining} left')
