"""A whole run in one call: its rows, its trends, its pictures."""
from __future__ import annotations

import base64
import html
from dataclasses import dataclass, field
from typing import Any, Iterable

import numpy as np
import numpy.typing as npt

from . import moving_svg
from ._library import ffi, lib
from .analysis import Trend, classify
from .arguments import refuse, text, whole
from .errors import Error, InputError
from .evaluate import evaluate
from .progress import Progress
from .run import Array, Event, Run, Table, Watch, doubles
from .spec import SystemLike, takes_run_options, time_or_default
from .system import System

NUMBERS = ('x', 'y', 'angle', 'steer', 'width', 'spin', 'wx', 'wy', 'wz')  # of a pose, in the order of a picture
PAIRS = (('x', 'y'), ('x1', 'x2'), ('y1', 'y2'))
FRAMES, PATH_POINTS = 120, 600


@dataclass(frozen=True)
class Trajectory:
    """A run from its start to its end.

    Attributes
    ----------
    system : System
    integrator : str
    step : float
    parameters : dict of str to float
    rows : structured ndarray
        With the columns of ``dalembert run``: ``rows['t']``, ``rows["x'"]``, ``rows['D1']``; of one
        column ``run['x']`` is the same.
    trends : dict of str to Trend
        Of every step, by the names of the observables.
    events : list of Event
    """

    system: System
    integrator: str
    step: float
    parameters: dict[str, float]
    rows: npt.NDArray[np.void]
    trends: dict[str, Trend]
    events: list[Event] = field(default_factory=list)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns."""
        return self.rows.dtype.names or ()

    def __getitem__(self, name: str) -> Array:
        if name not in self.names:
            raise InputError('DAL_NAME', f"no column is named '{name}'; there is {', '.join(self.names)}")
        return self.rows[name]

    def __len__(self) -> int:
        return len(self.rows)

    def __repr__(self) -> str:
        t = self['t']
        span = f't = {t[0]:g} to {t[-1]:g}' if len(t) else 'no rows'
        return f'<Trajectory of {self.system.name} by {self.integrator}, h = {self.step:g}, {span}>'

    def _columns(self, names: Iterable[str]) -> Array:
        return np.stack([self.rows[name] for name in names], axis=-1)

    def pose(self) -> dict[str, Array] | None:
        """Where the body is, and how it is turned, at each row, as the picture of the system says.

        Returns
        -------
        dict of str to ndarray, or None
            ``x``, ``y``, ``angle``, ``steer``, ``width``, ``spin``, ``wx``, ``wy``, ``wz``.  Of a system
            without a picture the place alone, by the first of (x, y), (x1, x2), (y1, y2) that are
            coordinates; None without one.
        """
        coordinates = self.system.coordinates
        callback = lib.python_picture(self.system._system)
        zero = {name: np.zeros(len(self)) for name in NUMBERS}
        if callback == ffi.NULL:
            pair = next((pair for pair in PAIRS if {*pair} <= {*coordinates}), None)
            return None if pair is None or not {*pair} <= {*self.names} else {
                **zero, 'x': self.rows[pair[0]], 'y': self.rows[pair[1]]}
        velocities = [name + "'" for name in coordinates]
        velocities += [f'g{i + 1}' for i in range(self.system._system.multipliers)]
        if not {*coordinates, *velocities} <= {*self.names}:
            return None
        values = evaluate(self.system._system, callback, lib.DAL_PICTURE_COUNT, self._columns(coordinates),
                          self._columns(velocities), self.rows['t'], self.parameters)
        return dict(zip(NUMBERS, values.T))

    def _frames(self, frames: int) -> tuple[Array, dict[str, Array]] | None:
        """Equally distant times, and the poses there."""
        pose = self.pose()
        if pose is None or len(self) < 2 or not all(np.isfinite(values).all() for values in pose.values()):
            return None
        order = np.argsort(self.rows['t'])
        times = self.rows['t'][order]
        at = np.linspace(times[0], times[-1], frames)
        return at, {name: np.interp(at, times, values[order]) for name, values in pose.items()}

    def shapes(self) -> list[dict[str, Any]]:
        """Lines and circles of the body, as the page of a run has them."""
        found, shape = [], ffi.NULL
        while (shape := lib.python_shape(self.system._system, shape)) != ffi.NULL:
            found.append({'pivot': tuple(shape.pivot), 'turn': shape.turn, 'narrowed': shape.is_narrowed,
                          'radius': shape.radius, 'line': [tuple(shape.at[i]) for i in range(shape.count)]})
        return found

    def outlines(self, pose: dict[str, float], size: float) -> list[Array]:
        """The lines of the body at a pose, [points, 2] each, with half its length as the size."""
        lines, circle = [], np.exp(1j * np.linspace(0, 2 * np.pi, 49))
        for shape in self.shapes():
            z = shape['radius'] * circle if shape['radius'] else np.array([complex(*at) for at in shape['line']])
            z = z.real + 1j * z.imag * (pose['width'] if shape['narrowed'] else 1)
            z = complex(*shape['pivot']) + z * np.exp(1j * shape['turn'] * pose['steer'])
            z = complex(pose['x'], pose['y']) + size * z * np.exp(1j * pose['angle'])
            lines.append(np.stack([z.real, z.imag], axis=-1))
        return lines

    def plot(self, *names: str, axes: Any = None) -> Any:
        """Draws by matplotlib.

        Parameters
        ----------
        *names : str
            Columns, drawn against t.  Without names the path with the body (or the coordinates against
            t), and how far D, E, H and invariants have moved.
        axes : matplotlib Axes, optional
            One for names, else two; they are made by default.

        Returns
        -------
        Axes, or an array of two
        """
        pyplot = need_pyplot()
        columns = [self[name] for name in names]
        if axes is None:
            _, axes = pyplot.subplots(1, 1 if names else 2, figsize=(6, 3.6) if names else (9, 3.6), layout='tight')
        if names:
            for name, values in zip(names, columns):
                axes.plot(self.rows['t'], values, label=name)
            label_axes(axes)
            return axes
        self._plot_path(axes[0])
        self._plot_drift(axes[1])
        return axes

    def _plot_path(self, axes: Any) -> None:
        pose = self.pose()
        if pose is None:
            for name in self.system.coordinates:
                if name in self.names:
                    axes.plot(self.rows['t'], self.rows[name], label=name)
            label_axes(axes)
            return
        axes.plot(pose['x'], pose['y'], color='0.7')
        size = extent(pose) / 20
        for i in np.linspace(0, len(self) - 1, min(6, len(self))).astype(int):
            for line in self.outlines({name: float(values[i]) for name, values in pose.items()}, size):
                axes.plot(*line.T, color='0.15', linewidth=1)
        axes.set_aspect('equal', adjustable='datalim')
        axes.set_xlabel('x')
        axes.set_ylabel('y')

    def _plot_drift(self, axes: Any) -> None:
        for name in self.names:
            if name not in self.trends:
                continue
            moved = np.abs(self.rows[name] - self.rows[name][0])
            if np.nanmax(moved, initial=0) > 0:
                axes.plot(self.rows['t'], np.where(moved > 0, moved, np.nan), label=name)
        axes.set_yscale('log')
        axes.set_ylabel('|change|')
        label_axes(axes)

    def animate(self, frames: int = 200, interval: int = 50, axes: Any = None) -> Any:
        """The motion by matplotlib: ``.save('motion.gif')``, ``.to_jshtml()``.

        Parameters
        ----------
        frames : int
            At equally distant times.
        interval : int
            Milliseconds between them.
        axes : matplotlib Axes, optional

        Returns
        -------
        matplotlib.animation.FuncAnimation
            Keep it as long as it moves.

        Raises
        ------
        InputError
            The system has no place in the plane; see `pose`.
        """
        pyplot = need_pyplot()
        from matplotlib.animation import FuncAnimation
        frames, interval = whole('frames', frames, 2), whole('interval', interval, 1)
        at = self._frames(frames)
        if at is None:
            raise refuse('system', f'{self.system.name} has no picture and no two coordinates (x, y), '
                         '(x1, x2) or (y1, y2), or the rows lack them')
        times, pose = at
        if axes is None:
            _, axes = pyplot.subplots(figsize=(5, 5))
        size = extent(pose) / 20
        axes.plot(pose['x'], pose['y'], color='0.85')
        trail, = axes.plot([], [], color='C0')
        bodies = [axes.plot([], [], color='0.15')[0] for _ in self.shapes()]
        axes.set_aspect('equal', adjustable='datalim')

        def draw(i: int) -> list[Any]:
            trail.set_data(pose['x'][:i + 1], pose['y'][:i + 1])
            for body, line in zip(bodies, self.outlines({name: float(v[i]) for name, v in pose.items()}, size)):
                body.set_data(*line.T)
            axes.set_title(f't = {times[i]:.3g}')
            return [trail, *bodies]
        return FuncAnimation(axes.figure, draw, frames=frames, interval=interval)

    def svg(self, frames: int = FRAMES) -> str | None:
        """The motion as an SVG picture that moves by itself; None without a place in the plane."""
        at = self._frames(max(PATH_POINTS, frames))
        if at is None:
            return None
        pose = {name: values.tolist() for name, values in at[1].items()}
        return moving_svg.draw(pose, self.shapes(), self.system.title or self.system.name,
                               whole('frames', frames, 2))

    def _repr_html_(self) -> str:
        """The motion and the trends, for notebooks."""
        svg = self.svg()
        picture = '' if svg is None else (
            '<img style="max-width:100%;width:480px" alt="The motion" src="data:image/svg+xml;base64,'
            f'{base64.b64encode(svg.encode()).decode()}">')
        rows = ''.join(f'<tr><th>{html.escape(name)}</th><td>{trend.first:.6g}</td><td>{trend.last:.6g}</td>'
                       f'<td>{trend.deviation:.2g}</td><td>{trend.size}</td><td>{trend.trend}</td></tr>'
                       for name, trend in self.trends.items() if name in self.names)
        return (f'<p>{html.escape(self.system.title or self.system.name)}: {html.escape(self.integrator)}, '
                f'h = {self.step:g}</p>{picture}<table><tr><th></th><th>first</th><th>last</th>'
                f'<th>|change|</th><th>size</th><th>trend</th></tr>{rows}</table>')


def need_pyplot() -> Any:
    """matplotlib.pyplot, or an error that says where it comes from."""
    try:
        from matplotlib import pyplot
    except ImportError as error:
        raise ImportError('pictures need matplotlib: pip install matplotlib, or on Debian apt install '
                          f'python3-matplotlib ({error})') from None
    return pyplot


def label_axes(axes: Any) -> None:
    """t below, and a legend where there are names."""
    axes.set_xlabel('t')
    if axes.get_legend_handles_labels()[0]:
        axes.legend(fontsize='small')


def extent(pose: dict[str, Array]) -> float:
    """The larger side of the path."""
    return max(float(np.ptp(pose['x'])), float(np.ptp(pose['y']))) or 1.0


@takes_run_options
def simulate(system: SystemLike, integrator: str | None = None, time: float | None = None, *,
             samples: int = 400, observe: str | Iterable[str] = (), compile: bool = False,
             progress: bool | None = None, **settings: Any) -> Trajectory:
    """Runs a system to a time.

    Parameters
    ----------
    system, integrator, **settings
        As of a `Run`.
    time : float, optional
        The default is the system file's.
    samples : int
        Rows after the first, at equal distances in t.
    observe : str or list of str
        Formulas to observe, as by `System.observe`.
    compile : bool
        Compiles the steps, with the same bits; for runs of a second and more.
    progress : bool, optional
        Shows a bar where tqdm is installed; by default on a terminal.

    Returns
    -------
    Trajectory
        With the rows of ``dalembert run``, the same bits.

    Raises
    ------
    StepError
        Its ``partial`` is the trajectory up to the failure.
    """
    samples = whole('samples', samples, 1)
    formulas = (observe,) if isinstance(observe, str) else tuple(observe)
    if formulas:
        system = (system if isinstance(system, System) else System.builtin(text('system', system))).observe(*formulas)
    run = Run(system, integrator, **settings)
    if compile:
        run.compile()
    time, began = time_or_default(run.system, time), run.time
    table, statistics = Table(run, samples + 1), ffi.new('dal_statistics[]', len(run.observable_names))
    with Progress(began, time, progress, 't') as bar:
        watch = Watch(run.system.events, run.dimension, bar)
        handle = ffi.new_handle(watch)
        request = ffi.new('python_request *', {'user': handle, 'rows': doubles(table.values),
                                               'statistics': statistics, 'every': 1})

        def made(status: int) -> Trajectory:
            return Trajectory(run.system, run.integrator, run.step, run.parameters, table.rows(request.made).copy(),
                              classify(run._run, run.observable_names, statistics, status), watch.events)
        try:
            run._call(lib.python_sample, run._run, time, samples, request)
        except Error as error:
            error.partial = made(lib.DAL_STATUS_INTERRUPTED)
            raise
    return made(lib.DAL_STATUS_OK)
