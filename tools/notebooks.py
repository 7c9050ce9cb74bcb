"""notebooks.py [--write] NOTEBOOK... - executes notebooks, and compares the kinds of their outputs with what is stored.

With --write it stores the outputs instead, pictures with a palette of 48 colours.  Any error of a
cell, an output that is missing or of another kind, and a notebook of more than 200 kB fail.
"""
import base64
import io
import os
import sys

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

MAX_BYTES, COLOURS, TIMEOUT = 200000, 48, 600


def kinds(notebook):
    """What the outputs of each cell are, texts of one stream as one."""
    def kind(output):
        return output.get('name') or tuple(sorted(output.get('data', ())))
    return [sorted({kind(output) for output in cell.outputs}, key=str) for cell in notebook.cells if cell.cell_type == 'code']


def shrink(data):
    """A PNG picture with fewer colours."""
    from PIL import Image
    file = io.BytesIO()
    picture = Image.open(io.BytesIO(base64.b64decode(data))).convert('RGB')
    picture.quantize(COLOURS).save(file, format='png', optimize=True)
    return base64.b64encode(file.getvalue()).decode() + '\n'


def execute(path):
    """The notebook with the outputs of this execution."""
    notebook = nbformat.read(path, as_version=4)
    folder = os.path.dirname(os.path.abspath(path))
    NotebookClient(notebook, timeout=TIMEOUT, record_timing=False, resources={'metadata': {'path': folder}}).execute()
    return notebook


def store(notebook, path):
    """Writes it, pictures shrunk."""
    notebook.metadata = {'kernelspec': notebook.metadata.kernelspec, 'language_info': {'name': 'python'}}
    for cell in notebook.cells:
        for output in cell.get('outputs', ()):
            if 'image/png' in output.get('data', {}):
                output.data['image/png'] = shrink(output.data['image/png'])
                output.data.pop('text/plain', None)
    nbformat.write(notebook, path)


def main(paths, write):
    failures = 0
    for path in paths:
        try:
            notebook = execute(path)
        except CellExecutionError as error:
            print(f'{path}: {error}', file=sys.stderr)
            failures += 1
            continue
        if write:
            store(notebook, path)
        stored = nbformat.read(path, as_version=4)
        for cell in notebook.cells:
            for output in cell.get('outputs', ()):
                if 'image/png' in output.get('data', {}):
                    output.data.pop('text/plain', None)
        if kinds(stored) != kinds(notebook):
            print(f'{path}: its outputs are not of the kinds that are stored: run tools/notebooks.py --write',
                  file=sys.stderr)
            failures += 1
        if os.path.getsize(path) > MAX_BYTES:
            print(f'{path}: {os.path.getsize(path)} bytes, {MAX_BYTES} at most', file=sys.stderr)
            failures += 1
    return failures > 0


if __name__ == "__main__":
    sys.exit(main([path for path in sys.argv[1:] if path != '--write'], '--write' in sys.argv))
