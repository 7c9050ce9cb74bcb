"""What the program does from beginning to end: studies, and checks of a system."""
from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import tempfile
from dataclasses import dataclass
from typing import Any, Mapping, Sequence

from .arguments import Settings, number, refuse, text, whole
from .errors import Error, InputError, StepError
from .load import Path, Row, Study, load
from .spec import SystemLike
from .system import System

KINDS = {2: InputError, 3: StepError}  # by exit status; others are an Error


def find_program() -> str:
    """The program: DALEMBERT_PROGRAM, or along PATH."""
    found = os.environ.get('DALEMBERT_PROGRAM') or shutil.which('dalembert')
    if not found:
        raise FileNotFoundError("the program 'dalembert' is not found: put it on PATH (make install), or its path "
                                'into DALEMBERT_PROGRAM')
    return found


def call_program(arguments: Sequence[str], done: Sequence[int]) -> str:
    """The output of the program, where it ends with one of these statuses."""
    result = subprocess.run([find_program(), *arguments], text=True, capture_output=True)
    if result.returncode not in done:
        lines = [line[len('dalembert: '):] for line in result.stderr.split('\n') if line.startswith('dalembert: ')]
        kind = KINDS.get(result.returncode, Error)
        raise kind('DAL_ARGUMENT' if kind is InputError else 'DAL_IO',
                   '; '.join(lines) or f'{arguments[0]}: the program ends with status {result.returncode}')
    return result.stdout


# ---- studies -----------------------------------------------------------------------------------

def write_system(system: System, directory: str, names: set[str]) -> str:
    """The path of a new file of a system."""
    if system.observed:
        raise refuse('study', f'{system.name} observes formulas: a study has them under expect')
    base = re.sub(r'\W+', '-', os.path.splitext(os.path.basename(system.name))[0]).strip('-') or 'system'
    name, number_ = base, 1
    while name in names:
        number_ += 1
        name = f'{base}-{number_}'
    names.add(name)
    path = os.path.join(directory, name + '.yaml')
    with open(path, 'w', encoding='utf-8') as file:
        file.write(system.text)
    return path


def write_study(given: Mapping[str, Any], directory: str) -> str:
    """The path of a study file; JSON is YAML."""
    def entry(one: Any) -> Any:
        if not isinstance(one, Mapping):
            return entry({'system': one}) if isinstance(one, System) else path_or_name(one)
        system = one.get('system')
        if not isinstance(system, System):
            return {**one, 'system': path_or_name(system)}
        path = write_system(system, directory, names)
        return {'label': os.path.splitext(os.path.basename(path))[0], **one, 'system': path}

    def path_or_name(one: Any) -> Any:
        return os.path.abspath(one) if isinstance(one, os.PathLike) or os.path.isfile(str(one)) else one
    names: set[str] = set()
    systems = given.get('systems', [])
    systems = [entry(one) for one in (systems if isinstance(systems, (list, tuple)) else [systems])]
    path = os.path.join(directory, 'study.yaml')
    try:
        content = json.dumps({**given, 'systems': systems}, default=lambda value: value.tolist())
    except (AttributeError, TypeError, ValueError):
        raise refuse('study', 'it has a value that is no text, number, list or mapping') from None
    with open(path, 'w', encoding='utf-8') as file:
        file.write(content)
    return path


def study(study: Mapping[str, Any] | Path, directory: Path | None = None, *, threads: int | None = None,
          page: bool = False, force: bool = False) -> Study:
    """Runs systems x integrators x steps, as ``dalembert study`` does.

    Parameters
    ----------
    study : mapping, or path
        What a study file has; the systems of a mapping may be `System`.
    directory : path, optional
        Keeps the files there; without it they are removed after the tables are read.
    threads : int, optional
        Cells at a time.
    page : bool
        Makes the page of the study.
    force : bool
        Overwrites what the directory holds.

    Returns
    -------
    Study
        Also where cells failed or expectations are not met: see ``status``.
    """
    with tempfile.TemporaryDirectory() as work:
        path = write_study(study, work) if isinstance(study, Mapping) else os.fspath(study)
        kept = os.path.join(work, 'study') if directory is None else os.fspath(directory)
        arguments = ['study', path, '--output', kept]
        arguments += [] if threads is None else ['--threads', str(whole('threads', threads, 1))]
        arguments += [option for option, given in (('--no-page', not page), ('--force', force)) if given]
        call_program(arguments, (0, 1, 3))
        found = load(kept)
        assert isinstance(found, Study)
        return Study(found.directory if directory is not None else None, found.status, found.cells, found.quantities,
                     found.expectations)


# ---- checks ------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Check:
    """What an examination of a system found.

    Attributes
    ----------
    items : list of dict
        ``section``, ``item``, ``result`` (``'ok'``, ``'FAIL'``, ``'not measured'``, ``'info'``),
        ``value``, ``at_least``, ``at_most``, ``text``.
    methods : list of dict
        ``integrator``, ``accepted``, ``reason``, ``preserves``: which methods the system takes.
    """

    items: list[Row]
    methods: list[Row]

    @property
    def ok(self) -> bool:
        """Whether no item failed, and all were measured."""
        return all(item['result'] in ('ok', 'info') for item in self.items)

    def __str__(self) -> str:
        return '\n'.join(f"{item['result']:>12}  {item['item']}: {item['text']}" for item in self.items)

    def __repr__(self) -> str:
        wrong = [item['item'] for item in self.items if item['result'] not in ('ok', 'info')]
        return f'<Check of {len(self.items)} items: {", ".join(wrong) or "ok"}>'


def check(system: SystemLike, *, parameters: Settings | None = None, start: Settings | None = None,
          start_time: float = 0.0) -> Check:
    """Examines a system before a run, as ``dalembert check`` does: constraints, energy, derivatives.

    Parameters
    ----------
    system, parameters, start, start_time
        As of a `Run`.
    """
    arguments = ['--json', '--from', repr(number('start_time', start_time))]
    for what, option, values in (('parameters', '--set', parameters), ('start', '--start', start)):
        for name, value in (values or {}).items():
            arguments += [option, f"{text(what, name)}={number(f'{what}[{name!r}]', value)!r}"]
    with tempfile.TemporaryDirectory() as work:
        path = write_system(system, work, set()) if isinstance(system, System) else text('system', system)
        found = json.loads(call_program(['check', path, *arguments], (0, 1)))
    return Check(found['items'], found['methods'])
