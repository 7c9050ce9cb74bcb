"""Failures of the library as exceptions."""
from __future__ import annotations

import threading
from typing import Any

from ._library import ffi, lib


class Error(Exception):
    """A failure of the library.

    Attributes
    ----------
    status : str
        The kind of failure, ``'DAL_SYNTAX'``.
    message : str
        What failed, with the object and the value.
    line, column : int or None
        The place in the text that was read, from 1.
    partial : object
        What was made before the failure: the rows of a trajectory, the trends of a run.
    """

    def __init__(self, status: str, message: str, line: int | None = None, column: int | None = None):
        super().__init__(status, message, line, column)
        self.status, self.message, self.line, self.column = status, message, line, column
        self.partial: Any = None

    def __str__(self) -> str:
        return f'line {self.line}, column {self.column}: {self.message}' if self.line else self.message


class InputError(Error, ValueError):
    """Something given cannot be used: a text, a name, a number, a start, a method."""


class StepError(Error, ArithmeticError):
    """A step failed, or an event cannot be passed; the run is as it was before it."""


def encode(text: str) -> bytes:
    """A name for the library, where a text ends at its first NUL: it must have none."""
    return refuse_nul(text.encode())


def refuse_nul(text: bytes) -> bytes:
    """The text, unless it has a NUL."""
    if b'\0' in text:
        raise InputError('DAL_ARGUMENT', f'{text.decode(errors="replace")!r} has a NUL')
    return text


STEP = {lib.DAL_STATUS_SINGULAR, lib.DAL_STATUS_SINGULAR_MASS, lib.DAL_STATUS_NOT_FINITE,
        lib.DAL_STATUS_NOT_CONVERGED, lib.DAL_STATUS_GAUGE, lib.DAL_STATUS_RANK, lib.DAL_STATUS_INCONSISTENT,
        lib.DAL_STATUS_EVENT, lib.DAL_STATUS_STOPPED}
OTHER = {lib.DAL_STATUS_IO, lib.DAL_STATUS_INTERRUPTED}

# The exception that ended a callback, to be raised when the library has returned.
_raised = threading.local()


def keep_exception(kind: Any, exception: BaseException, traceback: Any) -> None:
    """For callbacks: the library ends with DAL_STATUS_INTERRUPTED, and check raises the exception."""
    _raised.exception = exception


def make_error(record: Any, stepping: bool) -> Exception:
    """The exception for a dal_error, of a function that takes steps or of another."""
    status, message = record.status, ffi.string(record.message).decode(errors='replace')
    if status == lib.DAL_STATUS_MEMORY:
        return MemoryError(message)
    kind = StepError if stepping and status in STEP else Error if status in OTHER else InputError
    if not message:
        message = ffi.string(lib.dal_status_text(status)).decode()
    return kind(ffi.string(lib.dal_status_name(status)).decode(), message, record.line or None,
                record.column or None)


def check(status: int, record: Any, stepping: bool = False) -> None:
    """Raises what a status says, with the record that the function filled."""
    if status == lib.DAL_STATUS_OK:
        return
    exception = getattr(_raised, 'exception', None)
    _raised.exception = None
    if exception is not None and status == lib.DAL_STATUS_INTERRUPTED:
        raise exception
    record.status = status
    raise make_error(record, stepping)


def call(function: Any, *arguments: Any) -> None:
    """Calls a function of the library whose last argument is a dal_error."""
    record = ffi.new('dal_error *')
    check(function(*arguments, record), record)


def call_steps(function: Any, *arguments: Any) -> None:
    """The same for one that takes steps."""
    record = ffi.new('dal_error *')
    check(function(*arguments, record), record, stepping=True)


@ffi.def_extern(error=lib.DAL_STATUS_INTERRUPTED, onerror=keep_exception)
def python_poll(user: Any, run: Any) -> int:
    """Lets Python handle signals, an exception of which ends the run."""
    return lib.DAL_STATUS_OK


@ffi.def_extern(error=lib.DAL_STATUS_INTERRUPTED, onerror=keep_exception)
def python_progress(user: Any, done: float) -> int:
    """The same, and shows how far it is."""
    if user != ffi.NULL:
        ffi.from_handle(user).show(done)
    return lib.DAL_STATUS_OK


@ffi.def_extern(error=True, onerror=keep_exception)
def python_stop(user: Any) -> bool:
    """The same for a compiler."""
    return False
