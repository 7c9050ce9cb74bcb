"""read_json.py READER - compares the program's reader of JSON with Python's.

Documents are drawn: texts with all kinds of escapes, numbers, objects and arrays within each other
down to the depth that the program reads, blanks anywhere; and the same with a few bytes changed,
most of which are no JSON.  READER is read_json.c, compiled."""
import json
import random
import re
import subprocess
import sys

DEPTH = 32
DOCUMENTS = 20000


class Number(str):
    pass


class Pairs(list):
    pass


def refuse(word):
    raise ValueError(word)


# ---- what is expected ----

def show(value, depth=1):
    if depth > DEPTH and isinstance(value, list):
        raise ValueError('too deep')
    if isinstance(value, Pairs):
        return '{' + ''.join(show(k) + ':' + show(v, depth + 1) + ',' for k, v in value) + '}'
    if isinstance(value, list):
        return '[' + ''.join(show(v, depth + 1) + ',' for v in value) + ']'
    if isinstance(value, Number):
        return str(value)
    if isinstance(value, str):
        # Python keeps half of a surrogate pair.
        text = re.sub('[\ud800-\udfff]', '\ufffd', value)
        return '"' + text.encode().hex() + '"'
    return json.dumps(value)


def expected(document):
    try:
        value = json.loads(document.decode(), object_pairs_hook=Pairs, parse_int=Number,
                           parse_float=Number, parse_constant=refuse)
        return show(value) if isinstance(value, Pairs) else 'refused'
    except ValueError:  # of which the errors of json and of UTF-8 are
        return 'refused'


# ---- drawing documents ----

def blank():
    return random.choice(['', '', '', ' ', '\n', '\t', '\r\n  '])


def character():
    kind = random.randrange(8)
    if kind == 0:
        return '\\' + random.choice('"\\/bfnrt')
    if kind == 1:
        return '\\u%04X' % random.choice([0, 0x1f, 0x41, 0xe9, 0x7ff, 0x800, 0x2028, 0xd7ff,
                                          0xd800, 0xdbff, 0xdc00, 0xdfff, 0xe000, 0xffff])
    if kind == 2:
        high, low = random.randrange(0xd800, 0xdc00), random.randrange(0xdc00, 0xe000)
        return '\\u%04x\\u%04x' % (high, low)
    if kind == 3:
        return random.choice('\x7f\x80\xe9\u07ff\u0800\u2028\ufeff\uffff\U00010000\U0010ffff')
    return random.choice('abc xyz/\'{}[],:#&*!|>%@`-?~')


def text():
    return '"' + ''.join(character() for _ in range(random.randrange(6))) + '"'


def number():
    digits = random.choice(['0', '7', '10', '123456789012345678901234567890', '0', '9'])
    fraction = random.choice(['', '', '.0', '.5', '.00012300'])
    exponent = random.choice(['', '', 'e5', 'E+05', 'e-300', 'E999'])
    return random.choice(['', '-']) + digits + fraction + exponent


def value(depth):
    kind = random.randrange(7 if depth > 1 else 4)
    if kind == 0:
        return random.choice(['true', 'false', 'null'])
    if kind < 3:
        return number()
    if kind == 3:
        return text()
    if kind == 4:
        return pairs(depth - 1)
    items = (blank() + value(depth - 1) + blank() for _ in range(random.randrange(4)))
    return '[' + (','.join(items) or blank()) + ']'


def pairs(depth):
    members = (blank() + text() + blank() + ':' + blank() + value(depth) + blank()
               for _ in range(random.randrange(4)))
    return '{' + (','.join(members) or blank()) + '}'


def nested():
    depth = random.randrange(DEPTH - 3, DEPTH + 3)
    opened = [random.choice(['[', '{"a":']) for _ in range(depth)]
    closed = [']' if part == '[' else '}' for part in reversed(opened)]
    inner = random.choice(['0', '[' + ','.join(['[]', '{}'] * DEPTH) + ']'])
    return '{"a":' + ''.join(opened) + inner + ''.join(closed) + '}'


def changed(document):
    document = bytearray(document)
    for _ in range(random.randrange(1, 3)):
        place = random.randrange(len(document) + 1)
        other = random.choice([b'"', b'\\', b'{', b'}', b'[', b']', b',', b':', b'0', b'-', b'.', b'e',
                               b'u', b'NaN', b'Infinity', b'nul', b"'", b'#', b'\n', b'\0', b'\x1f',
                               b'\xff', b'\xc0\x80', b'\xed\xa0\x80', b'\xf4\x90\x80\x80', b'a'])
        document[place:place + random.randrange(2)] = random.choice([other, b''])
    return bytes(document)


def draw():
    document = (nested() if random.randrange(20) == 0 else
                blank() + pairs(5) + blank() if random.randrange(10) else value(3)).encode()
    return changed(document) if random.randrange(2) else document


random.seed(20260101)
documents = [draw() for _ in range(DOCUMENTS)]
stdin = b''.join(b'%d\n%s' % (len(document), document) for document in documents)
found = subprocess.run(sys.argv[1], input=stdin, stdout=subprocess.PIPE,
                       stderr=subprocess.DEVNULL, check=True).stdout.decode().splitlines()
refused = 0
assert len(found) == DOCUMENTS, len(found)
for document, one in zip(documents, found):
    other = expected(document)
    refused += other == 'refused'
    if one != other:
        sys.exit('%r is read as\n%s, not as\n%s' % (document, one, other))
assert DOCUMENTS / 4 < refused < DOCUMENTS * 3 / 4, refused
