"""Arguments: their names in errors and signatures."""
import inspect

import pytest

import dalembert
from dalembert._library import ffi

SLEIGH = 'chaplygin-sleigh'
RUN = dalembert.Run(SLEIGH, 'rk4')
BATCH = dalembert.Batch(SLEIGH, 'rk4', 3)


@pytest.mark.parametrize('argument, function', [
    ('system', lambda: dalembert.Run(3)),
    ('integrator', lambda: dalembert.Run(SLEIGH, 4)),
    ('step', lambda: dalembert.Run(SLEIGH, step='small')),
    ('start_time', lambda: dalembert.Run(SLEIGH, start_time=[0, 1])),
    ('start', lambda: dalembert.Run(SLEIGH, start=3)),
    (r"start\['phi'\]", lambda: dalembert.Run(SLEIGH, start={'phi': 'north'})),
    (r"parameters\['m'\]", lambda: dalembert.Run(SLEIGH, parameters={'m': None})),
    ('option iterations', lambda: dalembert.Run(SLEIGH, iterations=1.5)),
    ('option solver', lambda: dalembert.Run(SLEIGH, solver='both')),
    ('text', lambda: dalembert.System(3)),
    ('name', lambda: dalembert.System.builtin(3)),
    ('steps', lambda: RUN.advance('many')),
    ('steps', lambda: RUN.advance(-1)),
    ('steps', lambda: RUN.advance(1 << 60)),
    ('times', lambda: RUN.trajectory('soon')),
    ('times', lambda: RUN.trajectory([[1, 2]])),
    ('time', lambda: RUN.events('soon')),
    ('state', lambda: RUN.set_state('north')),
    ('state', lambda: RUN.set_state([1, 2])),
    ('name', lambda: RUN.index(0)),
    ('value', lambda: RUN.set_parameter('m', 'heavy')),
    ('name', lambda: RUN.set_parameter(1, 2)),
    ('saved', lambda: RUN.restore('abcdefgh')),
    ('count', lambda: dalembert.Batch(SLEIGH, count='many')),
    ('width', lambda: dalembert.Batch(SLEIGH, width=-1)),
    ('values', lambda: BATCH.set_parameter('m', [1, 2])),
    ('values', lambda: BATCH.set_parameter('m', 'heavy')),
    ('time', lambda: dalembert.trend(SLEIGH, time='long')),
    ('every', lambda: dalembert.trend(SLEIGH, every=0)),
    ('levels', lambda: dalembert.order(SLEIGH, levels=1)),
    ('reference', lambda: dalembert.order(SLEIGH, reference=[1])),
    ('count', lambda: dalembert.lyapunov(SLEIGH, count='all')),
    ('transient', lambda: dalembert.lyapunov(SLEIGH, transient='short')),
    ('on', lambda: dalembert.section(SLEIGH, 3)),
    ('direction', lambda: dalembert.section(SLEIGH, 'phi', direction='up')),
    ('quad_steps', lambda: dalembert.explain(SLEIGH, quad_steps='few')),
    ('lanes', lambda: dalembert.generate(SLEIGH, lanes='two')),
    ('prefix', lambda: dalembert.generate(SLEIGH, prefix=3)),
    ('members', lambda: dalembert.ensemble(SLEIGH, members=0, seed=1, vary={}, times=1)),
    ('seed', lambda: dalembert.ensemble(SLEIGH, members=1, seed='a', vary={}, times=1)),
    ('vary', lambda: dalembert.ensemble(SLEIGH, members=1, seed=1, vary={'m': 2}, times=1)),
    ('times', lambda: dalembert.ensemble(SLEIGH, members=1, seed=1, vary={}, times=[2, 1])),
])
def test_errors_name_the_argument(argument, function):
    with pytest.raises(dalembert.InputError, match=f'^{argument}.*: '):
        function()


def test_unknown_keywords():
    with pytest.raises(dalembert.InputError, match="trend has no argument 'spase'; did you mean 'space'"):
        dalembert.trend(SLEIGH, spase='physical')
    with pytest.raises(dalembert.InputError, match="Run.__init__ has no argument 'qqq'$"):
        dalembert.Run(SLEIGH, qqq=1)


def test_options_are_explicit():
    """All of the library's, with its defaults, wherever a run is made."""
    library = {name for name, _ in ffi.typeof('dal_options').fields}
    functions = [dalembert.Run, dalembert.Batch, dalembert.simulate, dalembert.ensemble, dalembert.explain, dalembert.generate,
                 dalembert.lyapunov, dalembert.order, dalembert.section, dalembert.trend]
    for function in functions:
        parameters = inspect.signature(function).parameters
        assert library | {'parameters', 'start'} <= set(parameters), function
        assert not any(p.kind is p.VAR_KEYWORD for p in parameters.values()), function
    parameters = inspect.signature(dalembert.trend).parameters
    assert (parameters['space'].default, parameters['iterations'].default) == ('lifted', 100)
    defaults = {name: p.default for name, p in parameters.items() if name in library}
    # What is said to be the default is one: the run is the same with it.
    run = dalembert.Run(SLEIGH, 'gauss4', **defaults)
    run.advance(10)
    other = dalembert.Run(SLEIGH, 'gauss4')
    other.advance(10)
    assert run.save() == other.save()


def test_integrators_and_modifiers():
    integrators, modifiers = dalembert.integrators(), dalembert.modifiers()
    assert {'rk4', 'gauss8'} <= set(integrators) and 'project' in modifiers
    assert not set(integrators) & set(modifiers) and not any('+' in name for name in integrators + modifiers)
