"""mathematics.py FORMULAS SITE - equations of documents as MathML, typeset by KaTeX when the site is made.

A document has an equation in a block ```math; a descriptor has formulas between $ and $$.  pages.py
puts marks in their places and saves them; when mkdocs is done one process typesets all of them, and
they replace the marks in SITE.  Without node or katex they stay LaTeX.
"""
import glob
import json
import os
import re
import subprocess
import sys

KATEX = os.environ.get('KATEX', '/usr/share/nodejs/katex')
BLOCK = re.compile(r'^```math\n(.*?)\n```$', re.M | re.S)
DISPLAY = re.compile(r'\n?\$\$(.+?)\$\$\n?', re.S)
INLINE = re.compile(r'\$([^$]+)\$')


def can_typeset():
    """Whether there are node and KaTeX."""
    try:
        return os.path.isdir(KATEX) and subprocess.run(['node', '--version'], capture_output=True, check=False).returncode == 0
    except OSError:
        return False


class Typesetter:
    """Collects formulas under marks, which become MathML at the end."""

    def __init__(self):
        self.formulas, self.is_able = [], can_typeset()

    def mark(self, formula, is_display):
        """A text for a formula until all are typeset."""
        self.formulas.append((formula, is_display))
        mark = f'<span data-formula="{len(self.formulas) - 1}"></span>'
        return f'\n\n<div class="equation" tabindex="0">{mark}</div>\n\n' if is_display else mark

    def document(self, text):
        """A document with its blocks of mathematics marked."""
        if not self.is_able:
            return text
        return BLOCK.sub(lambda block: self.mark(block.group(1), True), text)

    def paragraph(self, text):
        """A documentation of a descriptor with its formulas marked."""
        if not self.is_able:
            return DISPLAY.sub(r'\n\n    \1\n\n', INLINE.sub(r'`\1`', text) if '$$' not in text else text)
        text = DISPLAY.sub(lambda formula: self.mark(formula.group(1), True), text)
        return INLINE.sub(lambda formula: self.mark(formula.group(1), False), text)

    def save(self, path):
        """Writes the formulas for the end."""
        with open(path, 'w', encoding='utf-8') as file:
            json.dump(self.formulas, file)


def main(path, site):
    """Replaces the marks in the pages of the site."""
    with open(path, encoding='utf-8') as file:
        formulas = file.read()
    if formulas == '[]':
        return
    script = os.path.join(os.path.dirname(__file__), 'mathml.js')
    done = subprocess.run(['node', script], input=formulas, capture_output=True, encoding='utf-8',
                          env={**os.environ, 'KATEX': KATEX}, check=False)
    if done.returncode:
        raise SystemExit(done.stderr)
    results = [re.sub(r'<annotation.*?</annotation>', '', result, flags=re.S) for result in json.loads(done.stdout)]
    mark = re.compile(r'<span data-formula="(\d+)"></span>')
    for page in glob.glob(os.path.join(site, '**/*.html'), recursive=True):
        with open(page, encoding='utf-8') as file:
            text = file.read()
        if 'data-formula' in text:
            with open(page, 'w', encoding='utf-8') as file:
                file.write(mark.sub(lambda found: results[int(found.group(1))], text))


if __name__ == '__main__':
    main(*sys.argv[1:])
