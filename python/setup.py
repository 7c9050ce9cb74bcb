"""Installs the package dalembert; docs/python.md says how."""
import os
import sys
import tempfile

from setuptools import setup

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import extension  # noqa: E402

# Nothing is written into the source tree.
work = tempfile.TemporaryDirectory()

setup(
    name='dalembert',
    version=extension.version(),
    description='Geometric integrators for nonholonomic mechanics',
    license='BSD-2-Clause',
    packages=['dalembert'],
    package_data={'dalembert': ['py.typed']},
    python_requires='>=3.9',
    install_requires=['cffi', 'numpy'],
    cffi_modules=['extension.py:ffi'],
    zip_safe=False,
    options={'build': {'build_base': work.name}, 'egg_info': {'egg_base': work.name}},
)
