"""python_reference.py - the reference of the package of Python as a page, read from its sources.

What __init__.py exports is documented: signatures with their type hints, and docstrings.
"""
import ast
import glob
import re
import textwrap

PACKAGE = 'python/dalembert/'


def exported():
    """The names that the package exports, in their order, and the definitions of all of its modules."""
    with open(PACKAGE + '__init__.py', encoding='utf-8') as file:
        tree = ast.parse(file.read())
    names = []
    for node in tree.body:
        if isinstance(node, ast.Assign) and getattr(node.targets[0], 'id', '') == '__all__':
            names = ast.literal_eval(node.value)
    definitions = {}
    for path in sorted(glob.glob(PACKAGE + '*.py')):
        with open(path, encoding='utf-8') as file:
            for node in ast.parse(file.read()).body:
                if isinstance(node, (ast.ClassDef, ast.FunctionDef)):
                    definitions[node.name] = node
    return names, definitions


def signature(node, name):
    """name(arguments) -> result, without self, broken where it is long."""
    arguments = node.args
    if arguments.args and arguments.args[0].arg in ('self', 'cls'):
        arguments.args = arguments.args[1:]
    result = f' -> {ast.unparse(node.returns)}' if node.returns else ''
    text = f'{name}({ast.unparse(arguments)}){result}'
    if len(text) < 90:
        return text
    inside = textwrap.fill(ast.unparse(arguments), 84, break_long_words=False, break_on_hyphens=False)
    return f'{name}(\n' + textwrap.indent(inside, '    ') + f'){result}'


def documentation(node):
    """A docstring as Markdown: a section of numpy's form is a list, of names with what they are."""
    text = (ast.get_docstring(node) or '').replace('``', '`')
    text = re.sub(r'^(\w[\w ]*)\n-+$', r'\n**\1**\n', text, flags=re.M)
    out, in_section = [], False
    for line in text.split('\n'):
        in_section |= line.startswith('**')
        if line.startswith('>>>') or not in_section or not line.strip() or line.startswith('**'):
            out.append('    ' * line.startswith('>>>') + line)
        else:
            out.append(line if line.startswith(' ') else f'- `{line.replace(" : ", "`: *", 1)}*  ' if ' : ' in line else f'- `{line}`')
    return '\n'.join(out)


def entry(node, name, level):
    """A heading, what is called, and its docstring; literal lines stay literal."""
    doc = documentation(node)
    called = f'```python\n{signature(node, name)}\n```\n' if isinstance(node, ast.FunctionDef) else ''
    return f'{"#" * level} `{name}`\n\n{called}\n{doc}\n'


def is_property(node):
    """Whether a method is read as an attribute."""
    return any(getattr(decorator, 'id', '') == 'property' for decorator in node.decorator_list)


def class_text(node):
    """A class, its constructor and its public methods."""
    out = [entry(node, node.name, 2)]
    attributes = []
    for item in node.body:
        if not isinstance(item, ast.FunctionDef):
            continue
        if item.name == '__init__':
            out.append(f'```python\n{signature(item, node.name)}\n```\n\n{documentation(item)}\n')
        elif item.name.startswith('_') or not ast.get_docstring(item):
            continue
        elif is_property(item):
            attributes.append(f'- `{item.name}`: ' + ' '.join(ast.get_docstring(item).split()))
        else:
            out.append(entry(item, f'{node.name}.{item.name}', 3))
    return '\n'.join(out[:2] + ['\n'.join(attributes) + '\n'] + out[2:])


def page():
    """The page as Markdown."""
    names, definitions = exported()
    out = ['# Python reference\n\nEvery class and function of the package `dalembert`; [Python](python.md) shows how they '
           'are used.\n']
    for name in names:
        node = definitions.get(name)
        if isinstance(node, ast.ClassDef):
            out.append(class_text(node))
        elif node:
            out.append(entry(node, name, 2))
    return '\n'.join(out)
