"""The build backend of pyproject.toml: setuptools', which first says what is missing.

With --no-build-isolation pip takes what is installed.
"""
import importlib.util
import sys

NEEDED = ('setuptools', 'wheel', 'cffi')
SETUPTOOLS = 61  # the first that reads the metadata in pyproject.toml


def check_requirements():
    missing = [name for name in NEEDED if importlib.util.find_spec(name) is None]
    if 'setuptools' not in missing:
        import setuptools
        if int(setuptools.__version__.split('.')[0]) < SETUPTOOLS:
            missing.append(f'setuptools {SETUPTOOLS} or newer')
        # Version 70.1 makes wheels itself.
        if 'wheel' in missing and importlib.util.find_spec('setuptools.command.bdist_wheel'):
            missing.remove('wheel')
    if missing:
        sys.exit(f'dalembert: missing to build it: {", ".join(missing)}: pip installs them from an index without '
                 "--no-build-isolation; Debian's packages are python3-setuptools, python3-wheel and python3-cffi")


check_requirements()
from setuptools.build_meta import *  # noqa: E402, F401, F403
