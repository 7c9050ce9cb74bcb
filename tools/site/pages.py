"""pages.py OUT PROGRAM - collects the pages of the site in OUT and writes OUT.yml for mkdocs.

The documents keep the links that they have in the repository.  Here a link to another document
leads to its page, one to a public header to the reference, one to any other file to a page that
shows it, a notebook with its outputs.  The pages have the order of docs/index.md, which must name
every document.  The program, where there is one, makes the families of methods, the gallery and the
output on the landing page.
"""
import base64
import glob
import json
import os
import re
import shutil
import sys

import generated
import mathematics
import python_reference

# Documents outside of docs/, and their pages.
OUTSIDE = {'README.md': 'overview.md', 'CONTRIBUTING.md': 'contributing.md', 'CHANGELOG.md': 'changes.md'}
LANGUAGE = {'.c': 'c', '.h': 'c', '.yaml': 'yaml'}
LINK = re.compile(r'\]\(((?!https?:|mailto:|#)[^)#\s]+)(#[^)]*)?\)')


class Site:
    def __init__(self, out):
        self.out, self.sources, self.typesetter = out, {}, mathematics.Typesetter()

    def write(self, name, text):
        path = os.path.join(self.out, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'w', encoding='utf-8') as file:
            file.write(text)

    def target(self, path):
        """The page or file of the site that shows a path of the repository."""
        if path in OUTSIDE:
            return OUTSIDE[path]
        if path.startswith('docs/'):
            return path[len('docs/'):]
        if path == 'include':
            return 'reference/modules.html'
        if path.startswith('include/'):
            return 'reference/group__%s.html' % os.path.basename(path)[:-2].replace('_', '__')
        self.sources[path] = 'files/%s.md' % path.replace('.', '_')
        return self.sources[path]

    def page(self, document, name):
        """Writes a document as a page, with its links changed."""
        def link(match):
            path = os.path.normpath(os.path.join(os.path.dirname(document), match.group(1)))
            target = os.path.relpath(self.target(path), os.path.dirname(name) or '.')
            return '](%s%s)' % (target, match.group(2) or '')
        with open(document, encoding='utf-8') as file:
            self.write(name, self.typesetter.document(LINK.sub(link, file.read())))

    def output(self, data, name):
        """An output of a notebook as Markdown; its picture goes beside the page."""
        text = {kind: ''.join(value) for kind, value in data.items()}
        if 'image/png' in text:
            path = '%s_%d.png' % (name[:-len('.md')], len(glob.glob(os.path.join(self.out, name[:-3] + '_*.png'))))
            with open(os.path.join(self.out, path), 'wb') as file:
                file.write(base64.b64decode(text['image/png']))
            return '![](%s)' % os.path.basename(path)
        if 'text/html' in text:
            return text['text/html']
        return '```text\n%s\n```' % text.get('text/latex', text.get('text/plain', '')).rstrip('\n')

    def show_notebook(self, path, name):
        """Writes a page of the cells of a notebook and their outputs."""
        with open(path, encoding='utf-8') as file:
            cells = json.load(file)['cells']
        os.makedirs(os.path.dirname(os.path.join(self.out, name)), exist_ok=True)
        parts = []
        for cell in cells:
            source = ''.join(cell['source'])
            parts.append(source if cell['cell_type'] == 'markdown' else '```python\n%s\n```' % source)
            for output in cell.get('outputs', ()):
                parts.append(self.output(output.get('data') or {'text/plain': output.get('text', '')}, name))
        parts.append('*The notebook: `%s`.*' % path)
        self.write(name, '\n\n'.join(parts) + '\n')

    def show(self, path, name):
        """Writes a page that shows a file, or the names in a directory."""
        if path.endswith('.ipynb'):
            self.show_notebook(path, name)
            return
        if os.path.isdir(path):
            text = '\n'.join(sorted(os.listdir(path)))
        else:
            with open(path, encoding='utf-8') as file:
                text = file.read()
        language = LANGUAGE.get(os.path.splitext(path)[1], 'text')
        self.write(name, '# %s\n\n```%s\n%s\n```\n' % (path, language, text.rstrip('\n')))


def navigation(index):
    """The headings and links of docs/index.md, in their order."""
    groups = []
    for line in index.split('\n'):
        if re.match(r'[A-Z].*:$', line):
            groups.append((line.rstrip(':'), []))
        item = re.match(r'- \[(.*?)\]\((.*?)\)', line)
        if item:
            groups[-1][1].append({item.group(1): item.group(2)})
    return groups


def version():
    """The version of the header."""
    with open('include/dalembert.h', encoding='utf-8') as file:
        return '.'.join(re.findall(r'^#define DAL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)', file.read(), re.M))


def write_versions(site, number):
    """The list of versions, which must have this one, and the script that shows it."""
    with open('tools/site/versions.json', encoding='utf-8') as file:
        versions = json.load(file)
    if number not in versions:
        sys.exit(f'tools/site/versions.json: version {number} is missing')
    with open('tools/site/versions.js', encoding='utf-8') as file:
        site.write('versions.js', f'window.DALEMBERT_VERSION = {json.dumps(number)};\n' + file.read())
    site.write('versions-list.js', f'showVersions({json.dumps(versions)});\n')


def write_settings(out, groups, number):
    """The settings of mkdocs, with the navigation."""
    with open('tools/site/mkdocs.json', encoding='utf-8') as file:
        settings = json.load(file)
    settings['docs_dir'] = os.path.abspath(out)
    settings['site_name'] += ' ' + number
    settings['nav'] = [{'Home': 'index.md'}] + [{title: items} for title, items in groups]
    with open(out + '.yml', 'w', encoding='utf-8') as file:
        json.dump(settings, file, indent=1)


def main(out, path):
    site = Site(out)
    program = generated.Program(path) if os.access(path, os.X_OK) else None
    for name in sorted(glob.glob('docs/*.md')):
        site.page(name, os.path.basename(name))
    for name, page in OUTSIDE.items():
        site.page(name, page)
    shutil.copytree('docs/gallery', os.path.join(out, 'gallery'), dirs_exist_ok=True)
    shutil.copy('tools/site/site.css', out)
    for path in sorted(site.sources):
        site.show(path, site.sources[path])

    with open(os.path.join(out, 'index.md'), encoding='utf-8') as file:
        groups = navigation(file.read())
    listed = {target.split('#')[0] for _, items in groups for item in items for target in item.values()}
    for name in sorted(glob.glob('docs/*.md')):
        if os.path.basename(name) not in listed | {'index.md'}:
            sys.exit('%s: docs/index.md does not name it' % name)
    site.write('python_reference.md', python_reference.page())
    groups.append(('Python', [{'Python reference': 'python_reference.md'}]))
    groups[-1][1].append({'Overview': 'overview.md'})
    if program:
        generated.gallery_page(program, site.write)
        groups.insert(1, ('Families of methods', generated.family_pages(program, site.typesetter, site.write)))
        groups[0][1].append({'Gallery': 'gallery.md'})
    number = version()
    write_versions(site, number)
    site.write('index.md', site.typesetter.document(generated.landing(program, number)))
    site.typesetter.save(out + '.formulas')
    write_settings(out, groups, number)


main(*sys.argv[1:])
