"""holds_json.py FILE EXPRESSION - each line of a file .lines, or the file, is JSON d, of which this is true.

Names must not come twice in an object, and numbers must be finite.  The expression may use csv rows
of other files, as rows('table.csv'), and whether two numbers are near()."""
import csv
import json
import math
import sys


def refuse(word):
    raise ValueError(word)


def once(pairs):
    assert len(dict(pairs)) == len(pairs), pairs
    return dict(pairs)


def number(x):
    return type(x) in (int, float)


def near(x, y, limit=1e-9):
    return number(x) and abs(x - y) <= limit * max(abs(y), 1e-300)


def rows(path):
    with open(path, encoding='utf-8', newline='') as table:
        return list(csv.DictReader(table))


def cell(text):
    """What JSON has for a cell of a CSV file."""
    if text == '':
        return None
    try:
        return float(text)
    except ValueError:
        return text


path, expression = sys.argv[1:]
with open(path, encoding='utf-8') as file:
    text = file.read()
lines = text.splitlines() if path.endswith('.lines') else [text]
assert lines
names = {'number': number, 'near': near, 'rows': rows, 'cell': cell, 'math': math}
for line in lines:
    d = json.loads(line, parse_constant=refuse, object_pairs_hook=once)
    assert eval('(' + expression + ')', {'d': d, **names}), d
