"""Finds the library and describes the extension module dalembert._library to cffi.

The declarations come from the public headers, as the compiler's preprocessor writes them out;
the compiler then compares them with the headers.

    DALEMBERT_BUILD    a directory that `make` made, the library of which is linked statically
    DALEMBERT_PREFIX   where `make install` put the library, below DESTDIR

Without them ../build is taken where it has a library; else the library is made from its sources,
in the tree or, in a source distribution, in library/.
"""
import os
import re
import shlex
import shutil
import subprocess
import sys

import cffi

HERE = os.path.dirname(os.path.abspath(__file__))
HEADERS = ('dalembert.h', 'dalembert_analysis.h', 'dalembert_codegen.h')  # and what they include
STATIC = 'libdalembert.a'

# Where the sources of the library are, and which of them make it.
SOURCES = next((directory for directory in (os.path.join(HERE, 'library'), os.path.dirname(HERE))
                if os.path.exists(os.path.join(directory, 'include', HEADERS[0]))), None)
MAKING = ('Makefile', 'LICENSE', 'bench/bench.mk', 'include', 'integrators', 'lib', 'systems', 'tools',
          'cli/report/report_body.c', 'cli/report/report_body.h')

# What observers.c adds, and free for texts that the library allocates.
ADDED = '''
extern "Python" dal_status python_poll(void *user, dal_run *run);
extern "Python" dal_status python_event(void *user, dal_run *run, const dal_occurrence *event);
extern "Python" dal_status python_cross(void *user, dal_run *run, const dal_crossing *crossing);
extern "Python" dal_status python_progress(void *user, double done);
extern "Python" dal_status python_iterate(void *user, int guess, int iteration, double residual);
extern "Python" bool python_stop(void *user);
typedef struct python_request {
    void *user;
    const double *times;
    double *rows;
    dal_statistics *statistics;
    long long every;
    long long made;
} python_request;
dal_status python_sample(dal_run *run, double T, long long count, python_request *request, dal_error *error);
void python_evaluate(dal_evaluator *evaluator, dal_callback *callback, long long count, const double *t,
                     const double *q, const double *v, int width, int size, double *out);
typedef struct body_shape {
    double pivot[2], turn;
    bool is_narrowed;
    double radius;
    int count;
    double at[6][2];
    ...;
} body_shape;
dal_callback *python_picture(const dal_system *system);
const body_shape *python_shape(const dal_system *system, const body_shape *shape);
#define DAL_PICTURE_COUNT ...
void free(void *text);
#define DAL_VERSION_MAJOR ...
#define DAL_VERSION_MINOR ...
#define DAL_VERSION_PATCH ...
'''


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, stdout=subprocess.PIPE, **options).stdout


def fail(reason):
    sys.exit(f'dalembert: {reason}: run make, or set DALEMBERT_BUILD or DALEMBERT_PREFIX')


def copy_sources(directory):
    """Copies what makes the library into a new directory."""
    for name in MAKING:
        source, copy = os.path.join(SOURCES, name), os.path.join(directory, name)
        if os.path.isdir(source):
            shutil.copytree(source, copy)
        else:
            os.makedirs(os.path.dirname(copy), exist_ok=True)
            shutil.copy(source, copy)


def make_library(directory):
    """Makes the static library in a new directory; its path."""
    copy_sources(directory)
    # BUILD is relative: make has no paths with blanks.
    made = os.path.join('build', STATIC)
    try:
        subprocess.run(['make', 'BUILD=build', made], check=True, cwd=directory)
    except (OSError, subprocess.CalledProcessError):
        sys.exit('dalembert: the library cannot be made: it needs make, a C compiler and libyaml')
    return os.path.join(directory, made)


def in_tree(build=None):
    """How to compile and link with a build of the source tree, or with one that is still to be made."""
    if build and not os.path.exists(os.path.join(build, STATIC)):
        fail(f'no {STATIC} in {build}')
    return {'include_dirs': [os.path.join(SOURCES, 'include'), SOURCES],
            'extra_objects': [os.path.join(build, STATIC)] if build else [],
            'libraries': ['yaml', 'm'], 'extra_link_args': ['-pthread', '-Wl,--exclude-libs,ALL']}


def installed(prefix):
    """How to compile and link with an installed library, by pkg-config."""
    stage = os.environ.get('DESTDIR', '')
    found = [directory for directory, _, names in os.walk(stage + prefix) if 'dalembert.pc' in names]
    if not found:
        fail(f'no dalembert.pc below {stage + prefix}')
    environment = dict(os.environ, PKG_CONFIG_PATH=os.pathsep.join(found))
    try:
        flags = shlex.split(run('pkg-config', '--cflags', '--libs', 'dalembert', env=environment))
        include, libraries = (run('pkg-config', '--variable=' + name, 'dalembert', env=environment).strip()
                              for name in ('includedir', 'libdir'))
    except (OSError, subprocess.CalledProcessError):
        fail(f'pkg-config does not find the library below {stage + prefix}')
    # In /usr the loader searches by itself.
    return {'include_dirs': [stage + include, os.path.join(SOURCES, 'include'), SOURCES],
            'library_dirs': [stage + libraries], 'extra_link_args': flags,
            'runtime_library_dirs': [] if prefix == '/usr' else [libraries]}


def find_library():
    build, prefix = os.environ.get('DALEMBERT_BUILD'), os.environ.get('DALEMBERT_PREFIX')
    if not SOURCES:
        fail('no sources of the library')
    if prefix and not build:
        return installed(prefix)
    beside = os.path.join(SOURCES, 'build')
    return in_tree(build or (beside if os.path.exists(os.path.join(beside, STATIC)) else None))


def is_made():
    """Whether there is a library; else make_library makes it."""
    return bool(LIBRARY.get('extra_objects') or LIBRARY.get('library_dirs'))


def read_headers(directory, names=HEADERS, read=None):
    """The texts of headers, each once and after those that it includes."""
    read, texts = set() if read is None else read, []
    for name in names:
        if name in read:
            continue
        read.add(name)
        with open(os.path.join(directory, name), encoding='utf-8') as file:
            text = file.read()
        included = re.findall(r'^#include "(.*)"$', text, re.M)
        texts += [read_headers(directory, included, read), text]
    return '\n'.join(texts)


def version():
    """The version that the headers state."""
    text = read_headers(LIBRARY['include_dirs'][0])
    return '.'.join(re.findall(r'#define DAL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)', text))


def make_ffi():
    compiler = shlex.split(os.environ.get('CC', 'cc'))
    text = re.sub(r'^#include.*$', '', read_headers(LIBRARY['include_dirs'][0]), flags=re.M)
    declarations = run(*compiler, '-E', '-P', '-x', 'c', '-', input=text)
    with open(os.path.join(HERE, 'observers.c'), encoding='utf-8') as file:
        source = file.read()
    made = cffi.FFI()
    made.cdef(declarations + ADDED)
    made.set_source('dalembert._library', source, **LIBRARY)
    return made


LIBRARY = find_library()
ffi = make_ffi()
