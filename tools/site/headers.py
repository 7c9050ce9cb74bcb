"""headers.py HEADER - writes a header as Doxygen reads it (an input filter).

The headers have plain comments.  The one above a declaration, or after it on its line, documents
it; the first one documents the header, and /* ---- title ---- */ begins a group.  Lines that are
indented within a comment are formulas.  X-lists are written out, a row with its texts and its
comment; several declarators on a line become one each.
"""
import glob
import html
import re
import sys

COMMENT = r'/\*(?:[^*]|\*(?!/))*\*/'
QUOTED = r'"(?:[^"\\]|\\.)*"'


def split_arguments(text):
    """The arguments of a macro call: split at commas outside of parentheses and quotes."""
    parts, depth = [''], 0
    for token in re.findall(QUOTED + r'|.', text, re.S):
        depth += (token == '(') - (token == ')')
        if token == ',' and depth == 0:
            parts.append('')
        else:
            parts[-1] += token
    return [re.sub(r'\s+', ' ', part).strip() for part in parts]


def function_names():
    """The functions of the public headers, which a text links as name()."""
    names = set()
    for path in glob.glob('include/*.h'):
        with open(path, encoding='utf-8') as file:
            names |= set(re.findall(r'^[a-z][^\n;=#(]*?\b(dal_\w+)\(', file.read(), re.M))
    return names


FUNCTIONS = function_names()


def escape(text):
    text = re.sub(r'\bdal_\w+\b(?!\()', lambda name: name.group() + '()' * (name.group() in FUNCTIONS), text)
    text = re.sub(r'[\\@%#]', r'\\\g<0>', html.escape(text, quote=False).replace('&amp;', '&'))
    return re.sub(r'^- ', r'\\- ', text)


def documentation(text):
    """The text of a comment for Doxygen."""
    lines = [re.sub(r'^\s*\*( |$)', '', line) for line in text.strip().split('\n')]
    starred = [number == 0 or re.match(r'\s*\*( |$)', line) is not None
               for number, line in enumerate(text.strip().split('\n'))]
    out, formula = [], False
    for line, star in zip(lines, starred):
        now = star and line.startswith('    ')
        if now != formula:
            out.append('@verbatim' if now else '@endverbatim')
        formula = now
        if not now:
            line = escape(line.strip())
            line = re.sub(r'^Errors: |(?<=[.:\]] )\s*Errors: ', '\n@par Errors\n', line)
            line = line.replace('[alloc]', '<b>[alloc]</b>')
        out.append(line)
    return '\n'.join(out + ['@endverbatim'] * formula)


def inner(comment):
    return comment[2:-2].strip()


def capital(text):
    return text[0].upper() + text[1:]


def read_lists(source):
    """X-lists: name -> rows (arguments, comment)."""
    lists = {}
    for name, row, body in re.findall(r'#define (\w+_LIST)\((\w+)\)((?:[^\n]*\\\n)*[^\n]*\n)', source):
        rows = []
        call = r'\b%s\(((?:%s|[^()"]|\([^()]*\))*)\)[ \t]*(?:\\\n\s*)?(%s)?' % (row, QUOTED, COMMENT)
        for arguments, comment in re.findall(call, body.replace('\\\n', ' \n')):
            rows.append((split_arguments(arguments), inner(comment) if comment else ''))
        lists[name] = rows
    return lists


def row_text(arguments, comment):
    texts = [''.join(re.findall(QUOTED, argument)).replace('""', '').strip('"')
             for argument in arguments if argument.startswith('"')]
    if len(arguments) >= 8:
        return '%s.  Default: %s; the name in texts is "%s".' % (texts[-1], arguments[3], texts[0])
    return ': '.join(filter(None, texts + [comment]))


def write_rows(rows, parameters, body):
    """An X-list expanded through #define MACRO(parameters) body."""
    out = []
    for arguments, comment in rows:
        values = dict(zip(parameters, arguments))
        line = re.sub(r'(?:\s*##\s*)?\b(%s)\b(?:\s*##\s*)?' % '|'.join(parameters[:len(arguments)]),
                      lambda match: values[match.group(1)], body)
        out.append('%s /* %s */\n' % (line.strip(), row_text(arguments, comment)))
    return ''.join(out)


def expand_lists(source):
    lists = read_lists(source)
    use = re.compile(r'#define (\w+)\(([^)]*)\) (.*)\n((?:.*\n)*?)#undef \1\n')

    def expand(match):
        macro, parameters, body, inside = match.groups()
        parameters = [name for name in split_arguments(parameters) if name != '...']

        def rows(call):
            return write_rows(lists.get(call.group(1), []), parameters, body)
        return re.sub(r'[ \t]*(\w+_LIST)\(%s\)\s*' % macro, rows, inside)
    source = use.sub(expand, source)
    source = re.sub(r'(#define \w+_LIST\(\w+\))(?:.*\\\n)*.*\n', r'\1\n', source)
    return re.sub(r'^\s*(DAL_\w+)\n(?=} \w+;|};)', r'\1 /* the number of these */\n', source, flags=re.M)


def declarators(code):
    """double a, b[N]; as two declarations."""
    match = re.match(r'(\s+(?:(?:const|struct|unsigned|long|enum)\s+)*\w+ )([^(){}=]*, [^(){}]*);$', code)
    if not match:
        return [code]
    return [match.group(1) + name + ';' for name in split_arguments(match.group(2))]


def constants(code):
    """A constant in an enumeration of its own, as a macro."""
    match = re.match(r'enum \{ (.*) \};$', code)
    return ['#define ' + item.replace(' = ', ' ') for item in match.group(1).split(', ')] if match else None


KERNEL = 'include/dalembert_kernel.h'


def kernel_names():
    """What the head of dalembert_kernel.h lists: file of lib/kernel -> names."""
    with open(KERNEL, encoding='utf-8') as file:
        head = file.read().split('*/')[0]
    names, path = {'num.h': ['DAL_EACH'],
                   'step.h': ['DAL_N', 'DAL_NW', 'DAL_M', 'DAL_DIM', 'DAL_VECTOR']}, None
    for line in re.findall(r'^ \*     +(.*)', head, re.M):
        words = line.split()
        if words[0].endswith('.h'):
            path = words.pop(0)
        if path:
            names.setdefault(path, []).extend(words)
    return names


def kernel_part(source, names):
    """The declarations of some names in a header of lib/kernel, without bodies.  A comment belongs
    to the declarations below it up to a blank line; of several declarations, the last with one
    counts, which is not the one in generated files.
    """
    out = []
    for name in names:
        forms = (r'^#define %s\b(?:.*\\\n)*.*', r'^typedef [^;{}()]*\b%s(?=[ ;(])[^;{}]*;',
                 r'^typedef struct %s \{(?:.*\n)*?\}[^;]*;',
                 r'^DAL_(?:INLINE|SHARED|COLD|SEPARATE)(?:_EARLY)? [^;{}=]*\b%s\([^)]*\)')
        found = []
        for form in forms:
            for match in re.finditer(form % name, source, re.M):
                text, is_macro = match.group(), match.group().startswith('#')
                if 'DAL_WIDE' in text:
                    continue
                block = source[:match.start()].rsplit('\n\n', 1)[-1]
                above = re.findall(r'^' + COMMENT, block, re.M)[-1:]
                if is_macro and '/*' in text:
                    above = ['']
                found.append((len(above), ''.join(above), text if is_macro else text.rstrip(';') + ';'))
        if not found:
            sys.exit('%s lists %s, which lib/kernel does not declare' % (KERNEL, name))
        comment, text = max(reversed(found), key=lambda item: item[0])[1:]
        out.append('%s\n%s\n' % (comment, re.sub(r'^DAL_(INLINE|SHARED|COLD|SEPARATE)(_EARLY)? ', '', text)))
    return '\n'.join(out)


class Writer:
    def __init__(self, stem):
        self.stem, self.out, self.above, self.titled, self.group = stem, [], '', False, ''
        self.heading = 0

    def write(self, line):
        self.out.append(line)

    def end_group(self):
        if self.group:
            self.write('/** @} */')
        self.group = ''

    def comment(self, text):
        """A comment that begins its line."""
        section = re.match(r'---- (.*?) -+$', text)
        if section:
            self.end_group()
            title = section.group(1)
            self.group = self.stem + '_' + re.sub(r'\W+', '_', title)
            self.heading = len(self.out)
            self.write('/** @defgroup %s %s\n' % (self.group, title if '.h' in title else capital(title)))
            self.write('@ingroup %s */\n/** @{ */' % self.stem)
        elif not self.titled:
            self.titled = True
            name, text = text.split(' - ', 1)
            text = capital(text)
            self.write('/** @file\n%s */' % documentation(re.sub(r'(?<=\.)\s.*', '', text, flags=re.S)))
            self.write('/** @defgroup %s %s\n%s */' % (self.stem, name, documentation(text)))
        else:
            self.above = text

    def floating(self):
        """A comment above nothing belongs to the head of its group."""
        if self.above:
            self.out[self.heading] += '\n' + documentation(self.above)
        self.above = ''

    def declare(self, code, after):
        for line in constants(code) or declarators(code):
            if self.above:
                self.write('/** %s */' % documentation(self.above))
            if after and line.startswith('#define'):
                self.write('/** %s */\n%s' % (documentation(after), line))
            else:
                self.write(line + (' /**< %s */' % documentation(after) if after else ''))
        self.above = ''

    def header(self, source):
        for code, comment in re.findall(r'([^\n]*?)[ \t]*(%s[ \t]*\n?|\n)' % COMMENT, source):
            comment = inner(comment.strip()) if comment != '\n' else ''
            if not code.strip():
                self.comment(comment) if comment else self.floating()
                continue
            if code.startswith('#define DAL__'):
                continue
            if re.match(r'#(if|endif|undef)|}', code):
                self.floating()
            if code == '#ifdef __cplusplus':
                self.end_group()
            self.declare(code, comment)
        self.end_group()
        return '\n'.join(self.out) + '\n'


def main(path):
    stem = re.sub(r'.*/|\.h$', '', path)
    with open(path, encoding='utf-8') as file:
        source = file.read()
    writer = Writer(stem)
    if path.startswith('include') or '/include/' in path:
        text = writer.header(expand_lists(source))
    else:
        writer.titled = True
        names = kernel_names().get(stem + '.h', [])
        head = capital(inner(re.match(COMMENT, source).group()).split(' - ', 1)[1])
        section = '/* ---- %s.h ---- */\n/* %s */\n\n' % (stem, head)
        writer.stem = 'dalembert_kernel'
        part = source[source.index('*/') + 2:] if stem == 'parts' else kernel_part(source, names)
        text = writer.header(section + part) if part else ''
    sys.stdout.write(text)


main(sys.argv[1])
