"""Directories that the program left: runs, studies, ensembles."""
from __future__ import annotations

import csv
import json
import os
from dataclasses import dataclass
from typing import Any, Union

import numpy as np

from .analysis import Trend
from .errors import InputError, StepError
from .members import Ensemble
from .simulate import Trajectory
from .system import System

Path = Union[str, 'os.PathLike[str]']
Row = dict  # of a table: column: float, str, or None where it is empty


# Columns of texts, which may look like numbers.
TEXTS = {'label', 'system', 'integrator', 'bits', 'run', 'message', 'quantity', 'expected', 'observable'}


def read_table(path: Path) -> list[Row]:
    """The rows of a CSV file, in which what can be read as a number is one."""
    def value(name: str, text: str) -> Any:
        try:
            return text or None if name in TEXTS else float(text)
        except ValueError:
            return text or None
    with open(path, newline='', encoding='utf-8') as file:
        return [{name: value(name, text) for name, text in row.items()} for row in csv.DictReader(file)]


def read_trend(row: Row) -> Trend:
    """The trend of a row of summary.csv, which leaves some members out."""
    numbers = {name: np.nan if row[column] is None else row[column] for name, column in (
        ('first', 'first'), ('last', 'final'), ('max_abs', 'maximum'), ('deviation', 'deviation'),
        ('amplitude', 'amplitude'), ('rate', 'rate'), ('rate_low', 'rate_low'), ('rate_high', 'rate_high'),
        ('exponent', 'exponent'), ('confidence', 'confidence'))}
    size, trend = row['size'] or '', row['trend'] or ''
    return Trend(**numbers, count=0, max_drift=np.nan, size=size, trend=trend, likeliest=trend,
                 conservation='conserved' if size else '')


def load_run(directory: Path, manifest: dict[str, Any]) -> Trajectory:
    """The run of a directory."""
    given, summary = manifest['input'], os.path.join(directory, 'summary.csv')
    system = read_system(directory, given['system'])
    rows = np.load(os.path.join(directory, 'trajectory.npy'), max_header_size=1 << 20)
    trends = read_table(summary) if os.path.exists(summary) else []
    integrator = manifest.get('integrator', manifest.get('method'))  # `method` until 0.4
    return Trajectory(system, integrator, float(given['step']), {**system.parameters, **given['set']}, rows,
                      {row['observable']: read_trend(row) for row in trends})


def read_system(directory: Path, name: str) -> System:
    """The copy of a system file in a directory, or the built-in system of this name."""
    copy = os.path.join(directory, 'system.yaml')
    return System.from_file(copy) if os.path.exists(copy) else System.builtin(name)


@dataclass(frozen=True)
class Study:
    """A study: every integrator on every system with every step.

    Attributes
    ----------
    directory : str or None
        Where its files are; None where they are gone.
    status : str
        ``'done'``, ``'failed'``, or ``'unmet'``: done, but not as expected.
    cells, quantities, expectations : list of dict
        The rows of ``cells.csv``, ``quantities.csv`` and ``expectations.csv``, which docs/formats.md
        describes; None where a column is empty.  ``pandas.DataFrame(study.cells)`` is a table.
    """

    directory: str | None
    status: str
    cells: list[Row]
    quantities: list[Row]
    expectations: list[Row]

    @property
    def met(self) -> bool:
        """Whether all is as expected."""
        return all(row['met'] == 'yes' for row in self.expectations)

    def trajectory(self, cell: Row) -> Trajectory:
        """The run of a cell."""
        if self.directory is None or not cell['run']:
            raise InputError('DAL_ARGUMENT', 'cell: its run has no rows, or the study no directory')
        found = load(os.path.join(self.directory, cell['run']))
        assert isinstance(found, Trajectory)
        return found

    def __repr__(self) -> str:
        return f'<Study of {len(self.cells)} cells: {self.status}>'


def load_study(directory: Path, manifest: dict[str, Any], kept: bool = True) -> Study:
    """The study of a directory."""
    tables = (read_table(path) if os.path.exists(path) else [] for path in (
        os.path.join(directory, f'{name}.csv') for name in ('cells', 'quantities', 'expectations')))
    return Study(os.fspath(directory) if kept else None, manifest['status'], *tables)


def load_ensemble(directory: Path, manifest: dict[str, Any]) -> Ensemble:
    """The ensemble of a directory."""
    def array(name: str) -> Any:
        return np.load(os.path.join(directory, name), max_header_size=1 << 20)
    members = array('members.npy')
    rows = array('rows.npy') if os.path.exists(os.path.join(directory, 'rows.npy')) else array('final.npy')[None]
    when = sorted({row['t'] for row in read_table(os.path.join(directory, 'statistics.csv'))},
                  key=lambda t: abs(t - manifest['input'].get('from', 0)))
    names = tuple(name for name in rows.dtype.names if name != 't')
    failures = {int(row['member']): StepError('DAL_' + str(row['reason']), str(row['message']))
                for row in read_table(os.path.join(directory, 'failures.csv'))}
    return Ensemble(names, np.array(when[-len(rows):]), np.stack([rows[name] for name in names], axis=-1),
                    {name: members[name] for name in members.dtype.names if name not in ('status', 't')}, failures)


def load(directory: Path) -> Trajectory | Study | Ensemble:
    """What ``dalembert run``, ``study`` or ``ensemble`` left in a directory.

    Parameters
    ----------
    directory : path

    Returns
    -------
    Trajectory, Study or Ensemble
        Trends of a loaded trajectory lack ``count`` and ``max_drift``.

    Raises
    ------
    InputError
        It is no such directory.
    """
    path = os.path.join(directory, 'manifest.json')
    try:
        with open(path, encoding='utf-8') as file:
            manifest = json.load(file)
    except (OSError, ValueError) as error:
        raise InputError('DAL_IO', f'directory: {os.fspath(directory)} has no run, study or ensemble ({error})'
                         ) from None
    if 'study' in manifest:
        return load_study(directory, manifest)
    return (load_ensemble if 'ensemble' in manifest else load_run)(directory, manifest)
