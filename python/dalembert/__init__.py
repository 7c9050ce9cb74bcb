"""dalembert - geometric integrators for nonholonomic mechanics.

>>> import dalembert
>>> run = dalembert.simulate('chaplygin-sleigh', 'gauss4+project', 10, step=0.01)
>>> float(run['t'][-1]), run.trends['D1'].size
(10.0, 'rounding')

Systems come from YAML text (`System`), files and the library; `simulate` runs one to a time, a `Run`
steps one motion, a `Batch` many, `ensemble` many with drawn starts; `trend`, `order`, `lyapunov`,
`section` and `explain` measure them, `check` a system, `study` many methods; `load` reads what the
program left; `invariants` finds what a motion conserves, `dirac` the constraints of its action,
`action` its value on a curve; `predict` says what a run will do to D, E and invariants;
`sensitivities` are derivatives of a run; `steer` finds the cheapest way to a state; `generate` writes C.
"""
from ._library import lib
from .action import Actions, DiscreteAction, action
from .analysis import (Average, Dirac, DiracConstraint, Invariant, Invariants, Lyapunov, Measure, Order,
                       Section, Shares, Trend, dirac, explain, generate, invariants, lyapunov, order,
                       section, trend)
from .errors import Error, InputError, StepError
from .load import Study, load
from .members import Ensemble, ensemble
from .predict import Predicted, Prediction, predict
from .program import Check, check, study
from .run import Batch, Event, Run
from .sensitivities import Sensitivities, sensitivities
from .simulate import Trajectory, simulate
from .spec import integrators, modifiers
from .steer import Extremal, Steering, steer
from .system import System, builtin_systems

__version__ = f'{lib.DAL_VERSION_MAJOR}.{lib.DAL_VERSION_MINOR}.{lib.DAL_VERSION_PATCH}'

__all__ = ['Actions', 'Average', 'Batch', 'Check', 'Dirac', 'DiracConstraint', 'DiscreteAction', 'Ensemble',
           'Error', 'Event', 'Extremal', 'InputError', 'Invariant', 'Invariants', 'Lyapunov', 'Measure',
           'Order', 'Predicted', 'Prediction', 'Run', 'Section', 'Sensitivities', 'Shares', 'Steering',
           'StepError', 'Study', 'System', 'Trajectory', 'Trend', 'action', 'builtin_systems', 'check',
           'dirac', 'ensemble', 'explain', 'generate', 'integrators', 'invariants', 'load', 'lyapunov',
           'modifiers', 'order', 'predict', 'section', 'sensitivities', 'simulate', 'steer', 'study',
           'trend']
