"""Builds the package dalembert; pyproject.toml has what it needs, docs/python.md says how."""
import os
import shutil
import sys
import tempfile

from setuptools import setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
import extension  # noqa: E402

# Nothing is written into the source tree.
work = tempfile.TemporaryDirectory()


class BuildExtension(build_ext):
    """Makes the library before the extension, where there is no build of it."""

    def pre_run(self, ext, ffi):
        if not extension.is_made():
            ext.extra_objects = [extension.make_library(os.path.join(work.name, 'library'))]


class SourceDistribution(sdist):
    """Has the sources of the library in library/."""

    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, [name for name in files if os.path.exists(name)])
        for name in ('backend.py', 'extension.py', 'observers.c'):
            shutil.copy(os.path.join(HERE, name), base_dir)
        extension.copy_sources(os.path.join(base_dir, 'library'))


setup(
    version=extension.version(),
    packages=['dalembert'],
    package_data={'dalembert': ['py.typed']},
    zip_safe=False,
    cffi_modules=['extension.py:ffi'],
    cmdclass={'build_ext': BuildExtension, 'sdist': SourceDistribution},
    options={'build': {'build_base': work.name}, 'egg_info': {'egg_base': work.name}},
)
