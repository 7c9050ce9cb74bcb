"""What pyproject.toml declares, against what the package and its build import."""
import ast
import pathlib
import re
import sys
from importlib import metadata

import pytest

import dalembert

HERE = pathlib.Path(__file__).resolve().parent.parent
OWN = {'backend', 'extension'}


@pytest.fixture
def declared():
    tomllib = pytest.importorskip('tomllib')
    return tomllib.loads((HERE / 'pyproject.toml').read_text(encoding='utf-8'))


def names(requirements):
    return {re.match('[a-z]+', requirement)[0] for requirement in requirements}


def imported(paths):
    """The packages of others that these files import whenever they run."""
    found = set()
    for path in paths:
        for node in ast.parse(path.read_text(encoding='utf-8')).body:
            if isinstance(node, ast.Import):
                found |= {alias.name for alias in node.names}
            elif isinstance(node, ast.ImportFrom) and node.level == 0:
                found.add(node.module)
    return {name.split('.')[0] for name in found} - set(sys.stdlib_module_names) - OWN


def test_build_requires_what_it_imports(declared):
    required = declared['build-system']['requires']
    # Older setuptools make wheels by wheel.
    assert names(required) == imported(HERE.glob('*.py')) | {'wheel'}


def test_missing_requirements_are_named(declared):
    text = (HERE / 'backend.py').read_text(encoding='utf-8')
    constants = {node.targets[0].id: ast.literal_eval(node.value) for node in ast.parse(text).body
                 if isinstance(node, ast.Assign)}
    required = declared['build-system']['requires']
    assert set(constants['NEEDED']) == names(required)
    assert f'setuptools>={constants["SETUPTOOLS"]}' in required


def test_package_depends_on_what_it_imports(declared):
    # The extension module needs a module of cffi.
    assert names(declared['project']['dependencies']) == imported((HERE / 'dalembert').glob('*.py')) | {'cffi'}


def test_installed_metadata(declared):
    found = metadata.metadata('dalembert')
    assert found['Version'] == dalembert.__version__
    assert found['Requires-Python'] == declared['project']['requires-python']
    required = [name for name in metadata.requires('dalembert') if 'extra ==' not in name]
    assert names(required) == names(declared['project']['dependencies'])


def test_extras_are_what_functions_import(declared):
    extras = names(sum(declared['project']['optional-dependencies'].values(), []))
    text = ''.join(path.read_text(encoding='utf-8') for path in (HERE / 'dalembert').glob('*.py'))
    found = {name.split('.')[0] for name in re.findall(r'^ +from ([a-z.]+) import', text, re.M)}
    assert found == extras
