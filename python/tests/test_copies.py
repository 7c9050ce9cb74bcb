"""Pickles and copies: they continue with the same bits, apart from what they are copies of."""
import copy
import pickle

import numpy as np
import pytest

import dalembert

COPIES = [copy.copy, copy.deepcopy, lambda thing: pickle.loads(pickle.dumps(thing))]


@pytest.mark.parametrize('copied', COPIES)
def test_system(copied):
    system = dalembert.System.builtin('chaplygin-sleigh').observe('h1 + m')
    other = copied(system)
    assert (other.text, other.name, other.observed) == (system.text, system.name, ('h1 + m',))
    assert dalembert.Run(other, 'rk4').observable_names == dalembert.Run(system, 'rk4').observable_names


@pytest.mark.parametrize('copied', COPIES)
@pytest.mark.parametrize('method', ['gauss4+project', 'rk4'])
def test_run(copied, method):
    run = dalembert.Run('chaplygin-sleigh', method, step=0.03, parameters={'m': 2}, start={'y1': 0.25},
                        start_time=1, space='physical')
    run.advance(7)
    run.set_parameter('I', 3)
    run.advance(5)
    other = copied(run)
    assert (other.time, other.steps, other.step) == (run.time, run.steps, run.step)
    assert other.parameters == run.parameters == {'m': 2, 'I': 3, 'v0': 1, 'omega': 1}
    before = run.save()
    other.advance(20)
    assert run.save() == before
    run.advance(20)
    assert other.save() == run.save()


def test_results():
    found = dalembert.order('chaplygin-sleigh', 'gauss4', 1, step=0.25, levels=3)
    assert np.array_equal(copy.deepcopy(found).error, pickle.loads(pickle.dumps(found)).error)


@pytest.mark.parametrize('copied', COPIES)
def test_batch(copied):
    with pytest.raises(TypeError, match='a Batch cannot be copied'):
        copied(dalembert.Batch('chaplygin-sleigh', 'rk4', 2))
