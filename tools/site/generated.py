"""generated.py - pages of the site that the program makes: the landing page, families of methods, the gallery.

What is shown is run when the site is made, by the program of the build.
"""
import csv
import fcntl
import io
import json
import os
import pty
import re
import struct
import subprocess
import tempfile
import termios

import pictures

PLANES = (('x', 'y'), ('X', 'Y'), ('x1', 'y1'), ('q1', 'q2'))
MODIFIED = {'project': 'rk4+project', 'project-energy': 'rk4+project-energy', 'lift': 'rk4+lift',
            'symmetric-project': 'gauss4+symmetric-project'}
SYSTEM, STEP, LEVELS, TIME = 'knife-edge', 0.2, 5, 4


class Program:
    """The program, in a directory of its own."""

    def __init__(self, path):
        self.path = os.path.abspath(path)
        self.place = tempfile.TemporaryDirectory()
        self.environment = {**os.environ, 'NO_COLOR': '1', 'XDG_CACHE_HOME': self.place.name}

    def run(self, *arguments, may_fail=False):
        """What it prints."""
        done = subprocess.run([self.path, *arguments], cwd=self.place.name, capture_output=True, encoding='utf-8',
                              env=self.environment, check=False)
        if done.returncode and not may_fail:
            raise SystemExit(f'dalembert {" ".join(arguments)}: {done.stderr}')
        return done.stdout

    def screen(self, *arguments):
        """What it prints on a terminal of 80 columns."""
        master, slave = pty.openpty()
        fcntl.ioctl(slave, termios.TIOCSWINSZ, struct.pack('HHHH', 40, 80, 0, 0))
        with subprocess.Popen([self.path, *arguments], cwd=self.place.name, stdin=subprocess.DEVNULL, stdout=slave,
                              stderr=subprocess.DEVNULL, env={**self.environment, 'TERM': 'dumb'}):
            os.close(slave)
            text = b''
            while True:
                try:
                    piece = os.read(master, 65536)
                except OSError:
                    break
                if not piece:
                    break
                text += piece
        os.close(master)
        return text.decode().replace('\r\n', '\n').rstrip('\n')


def landing(program, version):
    """The landing page, with the twelve lines of the README and their output."""
    with open('tools/site/landing.md', encoding='utf-8') as file:
        text = file.read()
    with open('README.md', encoding='utf-8') as file:
        readme = file.read()
    skate = re.search(r'```yaml\n(title: A skate.*?)```', readme, re.S)
    commands = re.findall(r'^    build/(dalembert run skate\.yaml .*)$', readme, re.M)
    output = ''
    if program:
        methods = [member for family in families(program) for member in family if not member['is_modifier']]
        text = text.replace('{integrators}', str(len(methods)))
        with open(os.path.join(program.place.name, 'skate.yaml'), 'w', encoding='utf-8') as file:
            file.write(skate.group(1))
        output = '\n\n'.join(f'```text\n$ {line}\n{program.screen(*line.split()[1:])}\n```' for line in commands)
    else: # what the program makes is not there
        text = text.replace('one of\n{integrators} integrators', 'an integrator')
        text = re.sub(r'^- \[[^]]*\]\((gallery|families)\.md\).*\n', '', text, flags=re.M)
    return (text.replace('{skate}', skate.group(0)).replace('{output}', output)
            .replace('{commands}', '\n'.join('    ' + line for line in commands)).replace('{version}', version))


# ---- families of methods ----------------------------------------------------------------------------


def families(program):
    """Lists of descriptors with the same documentation, in their order."""
    groups = {}
    for member in json.loads(program.run('list', 'integrators', '--json'))['integrators']:
        groups.setdefault(member['documentation'], []).append(member)
    return list(groups.values())


def figure(program, family):
    """Errors of members against steps, as a picture and a command."""
    names = [member['integrator'] for member in family]
    system = 'isokinetic' if names == ['isokinetic-splitting'] else SYSTEM
    methods = [(MODIFIED.get(name, f'stormer-verlet+{name}') if member['is_modifier'] else name)
               for name, member in zip(names, family)]
    arguments = ['order', system, '--integrators', ','.join(methods), '--step', str(STEP), '--levels', str(LEVELS),
                 '--time', str(TIME)]
    found = json.loads(program.run(*arguments, '--json', may_fail=True))
    curves = []
    for method in found['methods']:
        levels = [level for level in method['levels'] if level['error']]
        if levels:
            curves.append((method['integrator'], [level['step'] for level in levels], [level['error'] for level in levels]))
    return (pictures.orders(curves, f'Errors of {", ".join(methods)} against the step') if curves else None,
            'dalembert ' + ' '.join(arguments))


def family_name(family):
    """The name of a family: its members, the first and the last of many."""
    names = [member['integrator'] for member in family]
    plus = '+' if family[0]['is_modifier'] else ''
    names = [plus + name for name in names]
    return ', '.join(names) if len(names) < 4 else f'{names[0]} … {names[-1]}'


def family_pages(program, typesetter, write):
    """Writes a page for each family and one that lists them; returns their names and titles."""
    listed, index = [], ['# Families of methods\n\nThe equations of each family, its source, its order and what it '
                         'preserves, as its descriptors say. [Integrators](integrators.md) has all methods in one table.\n']
    for family in families(program):
        title, stem = family_name(family), family[0]['integrator']
        picture, command = figure(program, family)
        rows = ''.join(
            f'| `{member["integrator"]}` | {member["order"] or "-"} | {", ".join(member["properties"]) or "-"} | '
            f'{", ".join(member["preserves"]) or "-"} | {member["summary"]} | {member["reference"]} |\n' for member in family)
        text = (f'# {title}\n\n{typesetter.paragraph(family[0]["documentation"])}\n\n'
                f'| method | order | properties | preserves | what it is | reference |\n|---|---|---|---|---|---|\n{rows}\n')
        if picture:
            write(f'families/{stem}.svg', picture)
            text += (f'![Errors against the step, on two logarithmic scales]({stem}.svg)\n\n'
                     f'*The error at the end against the step:*\n\n    {command}\n')
        write(f'families/{stem}.md', text)
        listed.append({title: f'families/{stem}.md'})
        index.append(f'- [{title}](families/{stem}.md): {family[0]["summary"]}')
    write('families.md', '\n'.join(index) + '\n')
    return [{'All families': 'families.md'}] + listed


# ---- the gallery ------------------------------------------------------------------------------------


def plane(coordinates):
    """The two columns that a picture shows: a plane, else the first two coordinates, else q and its velocity."""
    for pair in PLANES:
        if set(pair) <= set(coordinates):
            return pair
    return tuple(coordinates[:2]) if len(coordinates) > 1 else (coordinates[0], coordinates[0] + "'")


def gallery_page(program, write):
    """Writes the gallery and its pictures."""
    out = ['# Gallery\n\nEvery built-in system by the defaults of its file: the path, and a point that moves along it as the '
           'motion does. [Systems](systems.md) says what each file means.\n']
    for system in json.loads(program.run('list', 'systems', '--json'))['systems']:
        name = system['system']
        x, y = plane(system['coordinates'])
        rows = list(csv.reader(io.StringIO(program.run('run', name, '--columns', f'{x},{y}', '--samples', '360'))))
        columns = [rows[0].index(column) for column in (x, y)]
        values = [[float(row[column]) for row in rows[1:]] for column in columns]
        write(f'gallery/{name}.svg', pictures.motion(*values, (x, y), f'{system["title"]}: {y} over {x}'))
        out.append(f'## {system["title"]}\n\n![{y} over {x}, moving](gallery/{name}.svg)\n\n'
                   f'    dalembert run {name} -o {name}\n    dalembert report {name}\n')
    write('gallery.md', '\n'.join(out))
