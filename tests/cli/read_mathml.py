"""read_mathml.py FILE... - parses MathML and prints each row of its equations as one line of text.

a/b is frac(a; b), a script a^b or a_b, a product a*b, a function f@(x), an accent dot(x) or ddot(x);
cases are [value, condition | ...].  An element that is not known, or that lacks an operand, is an error.
"""
import sys
import xml.etree.ElementTree

SPACE = '{http://www.w3.org/1998/Math/MathML}'
SIGNS = {'\u2062': '*', '\u2061': '@', '\u2212': '-', '\u22c5': '*', '\u2264': '<=', '\u02d9': 'dot',
         '\u00a8': 'ddot', '\u2032': "'", '\u2032\u2032': "''"}
OPERANDS = {'mfrac': 2, 'msub': 2, 'msup': 2, 'msubsup': 3, 'mover': 2}


def read(element):
    assert element.tag.startswith(SPACE), element.tag
    name, children = element.tag[len(SPACE):], list(element)
    if name in ('mi', 'mn', 'mo', 'mtext'):
        assert not children and element.text, name
        return SIGNS.get(element.text, element.text)
    assert not (element.text or '').strip(), element.text
    if name == 'mspace':
        return ''
    if name == 'mtable':
        return '[%s]' % ' | '.join(', '.join(read(cell) for cell in row) for row in children)
    parts = [read(child) for child in children]
    if name in ('mrow', 'mtd', 'msqrt'):
        return ('sqrt(%s)' if name == 'msqrt' else '%s') % ''.join(parts)
    assert len(parts) == OPERANDS[name], name
    parts = [part if len(part) == 1 or child.tag[len(SPACE):] != 'mrow' else '{%s}' % part
             for part, child in zip(parts, children)]
    if name == 'mfrac':
        return 'frac(%s; %s)' % tuple(parts)
    if name == 'mover':
        return '%s(%s)' % (parts[1], parts[0])
    if name == 'msubsup':
        return '%s_%s^%s' % tuple(parts)
    return parts[0] + {'msub': '_', 'msup': '^'}[name] + parts[1]


for path in sys.argv[1:]:
    math = xml.etree.ElementTree.parse(path).getroot()
    assert math.tag == SPACE + 'math', math.tag
    (table,) = math
    for row in table:
        assert row.tag == SPACE + 'mtr', row.tag
        left, right = row
        print(read(left) + ' ' + read(right))
