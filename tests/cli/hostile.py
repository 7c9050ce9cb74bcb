"""hostile.py PROGRAM PART - texts of others never become commands, markup or C.

    systems       titles, references, names of files and tables, of a system
    studies       titles and labels of a study
    directories   every text of every file that a page is made of
    damage        the same files cut off, with fewer columns and with other numbers (SEED COUNT)

Prints what is wrong, a line for each, and ends with 1 if anything is.  The commands in the texts make
files named canary; there must be none.  Works in the present directory."""
import glob
import html.parser
import json
import os
import random
import re
import shutil
import struct
import subprocess
import sys
import xml.etree.ElementTree as xml

PROGRAM = sys.argv[1]
ALL = '\'"; system "touch canary"; \'; system(\'touch canary\'); # `touch canary` $(touch canary) @ARG0 ${{x}} ' \
    '</script></title></style>--><canary onclick=canary()>&lt;canary&gt; */ #error canary /* *??/ // \\ %s \\input{canary}'
# Texts that may be a name or a title, by what they begin with; and texts with control characters.
PLAIN = [begin + ALL for begin in ('<touch canary #', '|touch canary #', '!touch canary #', '=1+1', '+1', '-e canary ',
                                   '@SUM(1+1)', '"quoted" ', "'quoted' ", '{\\write18{touch canary}}', '`touch canary`')]
CONTROL = ['a\n!touch canary\n', '\x1b[31mred', 'a\x00b', '\x9b31mred', 'a\x7f']
LINES = ['a\n!touch canary\n', '\ttouch canary\r\n*/\n#error canary\n', "a\\\n'\n!touch canary\n"]
wrong = 0


def fail(what, *about):
    global wrong
    wrong += 1
    print(what, *(repr(a)[:300] for a in about), flush=True)


def run(*arguments, allowed=(0,)):
    """The program's status, output and messages; a signal is never allowed."""
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, stdin=subprocess.DEVNULL)
    if done.returncode not in allowed:
        fail('status %d, not one of %s:' % (done.returncode, allowed), arguments, done.stderr)
    if re.search(rb'[\x00-\x09\x0b-\x1f\x7f]', done.stderr):
        fail('a control character in a message:', arguments, done.stderr)
    return done.returncode, done.stdout.decode(), done.stderr.decode('utf-8', 'replace')


def no_canary(about):
    for folder, folders, files in os.walk('.'):
        for name in files + folders:
            if name.startswith('canary'):
                fail('a command was run: ' + os.path.join(folder, name), about)
                os.remove(os.path.join(folder, name))


# ---- pages -------------------------------------------------------------------------------------


class Page(html.parser.HTMLParser):
    """Elements and attributes of a page, what its scripts hold, and its words."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.attributes, self.scripts, self.words = set(), set(), [], ''
        self.inside = None
        self.feed(text)
        self.close()

    def handle_starttag(self, tag, attributes):
        self.tags.add(tag)
        self.attributes |= {name for name, value in attributes}
        self.inside = tag
        if tag == 'script':
            self.scripts.append((dict(attributes).get('type'), ''))

    def handle_data(self, data):
        if self.inside == 'script':
            kind, text = self.scripts[-1]
            self.scripts[-1] = kind, text + data
        else:
            self.words += data

    def handle_endtag(self, tag):
        self.inside = None


def check_page(directory, script, about):
    """The page has its own elements alone, and the script that every page has; returns its words."""
    with open(directory + '/report/index.html', encoding='utf-8', errors='replace') as file:
        page = Page(file.read())
    alien = {tag for tag in page.tags if tag not in TAGS} | {a for a in page.attributes if a.startswith('on')}
    if alien:
        fail('markup on a page:', alien, about)
    for kind, text in page.scripts:
        if kind == 'application/json':
            json.loads(text)
        elif kind == 'module' and script and text != script or kind is None and text != library() or \
                kind not in ('module', None):
            fail('another script on a page:', text, about)
    check_figures(directory + '/report', about)
    return page


def library():
    """The script of charts as a page has it."""
    parts = [read(os.path.join(os.environ['DALEMBERT_UPLOT'], name)).decode() for name in ('LICENSE', 'uPlot.iife.min.js')]
    return '\n/* uPlot 1.6.32\n\n%s*/\n%s' % tuple(parts)


TAGS = ('html head meta style title body nav main b h1 h2 h3 p dl dt dd ol ul li a table thead tbody tr th td div figure noscript '
        'figcaption details summary pre small strong code br script span math mtable mtr mtd mrow mi mn mo mtext '
        'mspace mfrac msqrt msub msup msubsup mover').split()


def check_figures(directory, about):
    """Scripts are statements of the program, with all texts in single quotes; pictures are drawn things."""
    statement = re.compile(r"(set |plot \\$|  \$curve\d+ |  keyentry |  '' using |\$curve\d+ << END$|END$|[-+.,0-9einfa]*$)")
    for name in sorted(os.listdir(directory)):
        if name != 'index.html' and not re.fullmatch(r'[A-Za-z0-9-]+\.(gp|svg|pdf|tex)', name):
            fail('a file is named', name, about)
        path = os.path.join(directory, name)
        if name.endswith('.svg'):
            for element in xml.parse(path).iter():
                if element.tag.rsplit('}')[-1] in ('script', 'canary', 'foreignObject', 'a'):
                    fail('markup in %s:' % path, element.tag, about)
        if name.endswith('.tex') and re.search(r'\\(input|write)', read(path).decode('utf-8', 'replace')):
            fail('a command of TeX in %s' % path, about)
        if not name.endswith('.gp'):
            continue
        with open(path, encoding='utf-8', errors='replace') as file:
            text = re.sub(r"'(?:[^'\n]|'')*'", "''", file.read())
        for line in text.splitlines():
            if not statement.match(line):
                fail('no statement of ours in %s:' % path, line, about)
            if re.search(r'["`!;@|]|<(?!< END)', line.replace('<<', '<< ', 0)) and not re.fullmatch(r'\$curve\d+ << END', line):
                fail('a text outside of quotes in %s:' % path, line, about)


def report(directory, about, allowed=(0,), script=None, paper=()):
    shutil.rmtree(directory + '/report', ignore_errors=True)
    status, out, messages = run('report', directory, *paper, allowed=allowed)
    no_canary(about)
    return status, (check_page(directory, script, about) if status == 0 else None), messages


# ---- systems and studies -----------------------------------------------------------------------

SYSTEM = '''coordinates: [x, y]
parameters: {k: 1}
lagrangian: (x'^2 + y'^2)/2 - k*x^2/2
constraints: [y' - k]
start: {x: 1, y': k}
invariants: {c: x'^2 + k*x^2}
'''
MOTION = '--integrator rk4 --step 0.25 --time 1'.split()


def write(path, text, mode='w'):
    with open(path, mode, **({} if 'b' in mode else {'encoding': 'utf-8', 'newline': ''})) as file:
        file.write(text)


def compiler():
    cc = os.environ.get('CC', 'cc').split()
    return cc if shutil.which(cc[0]) else None


def check_source(path, about):
    """Names have letters, digits and _ of a text; all else of it is in the first comment."""
    with open(path, encoding='utf-8') as file:
        head = file.read()
    if not head.startswith('/* ') or re.search(r'(?<!_)canary', head[head.index('*/'):]):
        fail('a text is no comment in C:', about)
    for words in ('-std=c11 -pedantic -trigraphs', '-x c++ -std=c++17 -Wno-unused') if compiler() else ():
        done = subprocess.run(compiler() + words.split() + ['-Wcomment', '-Werror=comment', '-fsyntax-only', path],
                              capture_output=True)
        if done.returncode != 0:
            fail('no C:', about, done.stderr)


def use_system(text, path):
    """Every command that writes what a system is called."""
    for name in ('kept', 'orders', 'cut', 'exponents'):
        shutil.rmtree(name, ignore_errors=True)
    run('run', path, *MOTION, '--output', 'kept')
    page = report('kept', text)[1]
    if page and ' '.join(text.split()) not in ' '.join(page.words.split()):
        fail('the title is not on the page:', text)
    data = json.loads(run('check', path, '--json', allowed=(0, 1))[1])
    if data['title'] != text:
        fail('the title is another in JSON:', text, data['title'])
    run('section', path, '--on', 'x', *MOTION, '--output', 'cut')
    report('cut', text)
    json.loads(run('section', path, '--on', 'x', *MOTION, '--json')[1])
    run('order', path, '--integrators', 'rk4', '--levels', '2', '--time', '1', '--output', 'orders')
    report('orders', text)
    no_canary(text)


def systems():
    for text in PLAIN[:4] + LINES:
        # A string of JSON is one of YAML.
        write('hostile.yaml', 'title: %s\nreference: %s\n' % (json.dumps(text), json.dumps(text)) + SYSTEM)
        use_system(text, './hostile.yaml')
        run('generate', './hostile.yaml', '--integrator', 'rk4', '--output', 'hostile.c')
        check_source('hostile.c', text)
    for text in CONTROL[1:]:
        write('hostile.yaml', 'title: %s\n' % json.dumps(text) + SYSTEM)
        messages = run('run', './hostile.yaml', *MOTION, allowed=(2,))[2]
        if not re.search(r'hostile\.yaml:1:8: a text holds (the control character U\+00|a NUL)', messages):
            fail('no reason:', messages)
    for text in PLAIN + ['a\n!touch canary\n']:
        # As the name of the file.
        path = './' + text.replace('/', ':') + '.yaml'
        write(path, SYSTEM)
        shutil.rmtree('exponents', ignore_errors=True)
        shutil.rmtree('orders', ignore_errors=True)
        run('lyapunov', path, *MOTION, '--output', 'exponents')
        report('exponents', text)
        run('order', path, '--integrators', 'rk4', '--levels', '2', '--time', '1', '--output', 'orders')
        report('orders', text)
        run('generate', path, '--integrator', 'rk4', '--output', 'hostile.c')
        no_canary(text)
        os.remove(path)
    check_source('hostile.c', path)
    for text in PLAIN + CONTROL:
        # As a name in a system, and as a head of a table.
        write('hostile.yaml', SYSTEM + 'let: {%s: 1}\n' % json.dumps(text))
        run('run', './hostile.yaml', *MOTION, allowed=(2,))
        write('hostile.csv', 't,v,"%s"\n0,1,2\n2,1,2\n' % text)
        write('hostile.yaml', SYSTEM + 'tables: {f: {file: hostile.csv, at: t, value: v}}\nforces: {x: f(t)}\n')
        run('run', './hostile.yaml', *MOTION, '--output', '-', allowed=(0, 2))
        if '\x00' not in text:
            run('run', 'chaplygin-sleigh', *MOTION, '--observe', text, allowed=(2,))
        no_canary(text)


def studies():
    labels = [text.replace('/', ':')[:100] for text in PLAIN if text[0] != '.']
    write('hostile.yaml', SYSTEM)
    write('labels.yaml', 'title: %s\nintegrators: [rk4, gauss4]\nstep: [0.5, 0.25]\ntime: 2\nstarts: physical\nsystems:\n'
          % json.dumps(PLAIN[0]) + ''.join('  - {system: hostile.yaml, label: %s}\n' % json.dumps(label) for label in labels)
          + 'expect: {all: {rk4: {state: done}}}\n')
    shutil.rmtree('studied', ignore_errors=True)
    run('study', 'labels.yaml', '--output', 'studied')
    no_canary(labels)
    page = report('studied', labels)[1]
    if not page:
        return
    for text in labels + [PLAIN[0]]:
        if ' '.join(text.split()) not in ' '.join(page.words.split()):
            fail('no such text on the page:', text)
    data = [json.loads(text) for kind, text in page.scripts if kind == 'application/json']
    found = [part['label'] for part in data if 'label' in part]
    if found != labels:
        fail('other labels in the data:', found)
    for text in CONTROL:
        write('labels.yaml', 'integrators: rk4\nstep: 0.5\ntime: 2\nsystems: [{system: hostile.yaml, label: %s}]\n'
              % json.dumps(text))
        messages = run('study', 'labels.yaml', '--output', 'refused', allowed=(2,))[2]
        if 'labels.yaml:4:41: label' not in messages:
            fail('no reason:', messages)
        if os.path.exists('refused'):
            fail('a study was begun:', text)


# ---- directories -------------------------------------------------------------------------------


def make_directories():
    """One of each kind."""
    write('motion.yaml', SYSTEM)
    write('bounces.yaml', SYSTEM + "events: [{when: x', set: {x: x}}]\n")
    write('one.yaml', 'title: one\nintegrators: [rk4]\nstep: [0.5, 0.25]\ntime: 2\nstarts: physical\n'
          'systems: [{system: motion.yaml, label: one}]\nexpect: {one: {rk4: {D: {at most: 1}}}}\n')
    run('study', 'one.yaml', '--output', 'a-study', '--no-page')
    run('run', 'bounces.yaml', *MOTION[:-1], '4', '--observe', 'x^2', '--output', 'a-run')
    run('order', 'motion.yaml', '--integrators', 'rk4,gauss4,isokinetic-splitting', '--levels', '2', '--time', '1',
        '--output', 'an-order')
    run('section', 'motion.yaml', '--on', 'x', '--integrator', 'rk4', '--step', '0.25', '--time', '10',
        '--output', 'a-section')
    run('ensemble', 'motion.yaml', '--integrator', 'rk4', '--step', '0.25', '--times', '0.5,1,1.5', '--members', '20',
        '--seed', '1', '--vary', 'x=normal(0,0.1)', '--output', 'an-ensemble', '--no-page')
    run('lyapunov', 'motion.yaml', *MOTION, '--output', 'exponents')
    return {'exponents': ['lyapunov.csv', 'lyapunov.json', 'lyapunov.yaml'], 'a-study': ['cells.csv', 'expectations.csv', 'series/one.csv', 'study.yaml', 'manifest.json'],
            'a-run': ['trajectory.npy', 'summary.csv', 'events.csv', 'manifest.json', 'system.yaml'],
            'an-order': ['order.csv', 'order.json', 'order.yaml'],
            'a-section': ['section.csv', 'section.json'],
            'an-ensemble': ['statistics.csv', 'histograms.csv', 'cloud.csv', 'manifest.json']}


def read(path):
    with open(path, 'rb') as file:
        return file.read()


def quoted(text):
    return '"' + text.replace('"', '""') + '"'


def hostile_tables(bytes, text):
    """A table with the text as each of its heads, and then in all cells of each column."""
    rows = [line.split(',') for line in bytes.decode().splitlines()]
    for column in range(len(rows[0])):
        for first, last in ((0, 1), (1, len(rows))):
            table = [[quoted(text) if i == column and first <= k < last else cell for i, cell in enumerate(row)]
                     for k, row in enumerate(rows) if len(row) == len(rows[0])]
            yield '\n'.join(map(','.join, table)).encode('utf-8', 'surrogateescape') + b'\n'


def hostile_json(bytes, text):
    """An object with the text in place of each of its texts and numbers, and as each of its names."""
    def places(value, path):
        members = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for name, member in members:
            yield path + [name]
            yield from places(member, path + [name])

    for path in places(json.loads(bytes), []):
        for renames in (False, True):
            whole = value = json.loads(bytes)
            for name in path[:-1]:
                value = value[name]
            if renames and isinstance(value, dict):
                value[text] = value.pop(path[-1])
            elif not renames and not isinstance(value[path[-1]], (dict, list)):
                value[path[-1]] = text
            else:
                continue
            yield json.dumps(whole, indent=2).encode()


def hostile_heads(bytes, text):
    """A .npy file with the text as the name of each of its columns."""
    length = struct.unpack('<H', bytes[8:10])[0]
    header = bytes[10:10 + length].decode()
    for name in re.findall(r"\((['\"].*?['\"]), '<f8'\)", header):
        mark = '"' if "'" in text else "'"
        changed = header.rstrip().replace('(%s,' % name, '(%s%s%s,' % (mark, text.replace(mark, ''), mark), 1).encode()
        changed += b' ' * (-(11 + len(changed)) % 64) + b'\n'
        yield bytes[:8] + struct.pack('<H', len(changed)) + changed + bytes[10 + length:]


def hostile_yaml(bytes, text):
    yield bytes.replace(b'title: one', b'title: ' + json.dumps(text).encode())


def change_file(directory, name, bytes, about, script):
    path = os.path.join(directory, name)
    whole = read(path)
    write(path, bytes, 'wb')
    status, page, messages = report(directory, about, allowed=(0, 2), script=script)
    write(path, whole, 'wb')
    return status, messages


def directories():
    """Every text of every file alone; then those that are drawn, by gnuplot."""
    forms = {'.csv': hostile_tables, '.json': hostile_json, '.npy': hostile_heads, '.yaml': hostile_yaml}
    made = make_directories()
    for directory, files in made.items():
        script = [text for kind, text in report(directory, 'as it was')[1].scripts if kind == 'module'][0]
        for name in files:
            for text in (PLAIN[0], CONTROL[0]):
                for changed in forms[os.path.splitext(name)[1]](read(os.path.join(directory, name)), text):
                    about = (directory, name, text)
                    status, messages = change_file(directory, name, changed, about, script)
                    # Numbers alone are read of events.csv; lines are part of texts in YAML and JSON.
                    is_refused = text == CONTROL[0] and name.endswith(('.csv', '.npy')) and name != 'events.csv'
                    if is_refused and (status != 2 or 'control character U+00' not in messages):
                        fail('a control character was read:', about, messages)
    if shutil.which('gnuplot'):
        pictures()


# Columns whose cells are drawn, with their files; and whose heads are (None: the last column).
DRAWN = [('a-study', ['cells.csv', 'series/one.csv'], 'integrator'), ('an-order', ['order.csv'], 'integrator'),
         ('an-ensemble', ['statistics.csv', 'histograms.csv'], 'column'), ('a-section', ['section.csv'], None),
         ('a-run', ['trajectory.npy'], 'x'), ('an-ensemble', ['cloud.csv'], 'x')]


def pictures():
    os.remove('a-section/section.json') # which names the columns; without it the last two are drawn
    for directory, files, column in DRAWN:
        for text in PLAIN[:3]:
            whole = {name: read(os.path.join(directory, name)) for name in files}
            for name, bytes in whole.items():
                if name.endswith('.npy'):
                    changed = list(hostile_heads(bytes, text))[1]
                else:
                    heads = bytes.decode().splitlines()[0].split(',')
                    is_head = name in ('section.csv', 'cloud.csv')
                    changed = list(hostile_tables(bytes, text))[2 * heads.index(column or heads[-1]) + (not is_head)]
                write(os.path.join(directory, name), changed, 'wb')
            report(directory, (directory, text), paper=['--svg'])
            drawn = [file for file in os.listdir(directory + '/report') if file.endswith('.svg')
                     and 'touch canary' in ''.join(xml.parse(directory + '/report/' + file).getroot().itertext())]
            if not drawn:
                fail('the text is in no picture:', directory, column, text)
            report(directory, (directory, text), paper=['--pdf'])
            if not any(b'touch canary' in read(file) for file in glob.glob(directory + '/report/*.tex')):
                fail('the text is in no labels of TeX:', directory, column, text)
            for name, bytes in whole.items():
                write(os.path.join(directory, name), bytes, 'wb')


# ---- damage ------------------------------------------------------------------------------------


def change(random, bytes):
    """Cut off, with a column less, other numbers, or other bytes."""
    kind = random.randrange(5)
    if kind == 0:
        return bytes[:random.randrange(len(bytes) + 1)]
    lines = bytes.split(b'\n')
    if kind == 1 and b',' in lines[0]:
        column = random.randrange(lines[0].count(b',') + 1)
        rows = [line.split(b',') for line in lines]
        return b'\n'.join(b','.join(row[:column] + row[column + 1:]) for row in rows)
    if kind == 2:
        del lines[random.randrange(len(lines))]
        return b'\n'.join(lines)
    if kind == 3:
        numbers = list(re.finditer(rb'[-+0-9.e]+', bytes))
        if numbers:
            found = random.choice(numbers)
            other = random.choice([b'', b'nan', b'inf', b'-1', b'0', b'1e999', b'-1e308', b'99999999999999999999', b'0x1p5', b'text'])
            return bytes[:found.start()] + other + bytes[found.end():]
    changed = bytearray(bytes)
    for _ in range(random.randrange(1, 4)):
        if changed:
            changed[random.randrange(len(changed))] = random.choice([0, 10, 34, 44, 255, random.randrange(256)])
    return changed


def damage():
    choices = random.Random(int(sys.argv[3]))
    count = int(sys.argv[4])
    made = 0
    for directory, files in make_directories().items():
        if report(directory, 'as it was')[0] != 0:
            fail('no page:', directory)
        for name in files:
            path = os.path.join(directory, name)
            whole = read(path)
            for _ in range(count):
                write(path, change(choices, whole), 'wb')
                made += report(directory, path, allowed=(0, 2, 3, 4))[0] == 0
            write(path, whole, 'wb')
    if made == 0:
        fail('no damaged directory has a page')


{'systems': systems, 'studies': studies, 'directories': directories, 'damage': damage}[sys.argv[2]]()
sys.exit(wrong > 0)
