"""links.py SITE - the links of a site within it: what they lead to is there, and has the anchor.

Reads href and src of the pages, and url() of style sheets.  Nothing is fetched from elsewhere.  The page 404.html
has links from the root of a server, and none leads to it.
"""
import html.parser
import os
import re
import sys
from urllib.parse import unquote, urlsplit


class Page(html.parser.HTMLParser):
    """The links of a page, and the names that links to it may have."""

    def __init__(self, path):
        super().__init__()
        self.links, self.names = [], {'', 'top'}
        with open(path, encoding='utf-8') as file:
            self.feed(file.read())

    def handle_starttag(self, tag, attrs):
        for key, value in attrs:
            if key == 'id' or (key == 'name' and tag == 'a'):
                self.names.add(value)
            if key in ('href', 'src') and value is not None:
                self.links.append(value)


def links_of_style(path):
    """What a style sheet loads."""
    with open(path, encoding='utf-8') as file:
        return re.findall(r'url\(\s*["\']?([^"\')]*)', file.read())


def fault(link, path, pages):
    """Why a link of the file leads nowhere, or None."""
    parts = urlsplit(link)
    if parts.scheme or parts.netloc:
        return None
    target = os.path.normpath(os.path.join(os.path.dirname(path), unquote(parts.path))) if parts.path else path
    if os.path.isdir(target):
        target = os.path.join(target, 'index.html')
    if not os.path.isfile(target):
        return 'no such file'
    if target in pages and unquote(parts.fragment) not in pages[target].names:
        return 'no such anchor'
    return None


def main(site):
    """Prints a line for each link that leads nowhere."""
    files = [os.path.join(folder, name) for folder, _, names in os.walk(site) for name in names if name != '404.html']
    pages = {path: Page(path) for path in files if path.endswith('.html')}
    links = [(path, link) for path, page in pages.items() for link in page.links]
    links += [(path, link) for path in files if path.endswith('.css') for link in links_of_style(path)]
    faults = [f'{path}: {link}: {reason}' for path, link in links if (reason := fault(link, path, pages))]
    print('\n'.join(sorted(set(faults))) or f'{len(links)} links')
    return bool(faults) or not links


if __name__ == '__main__':
    sys.exit(main(os.path.normpath(sys.argv[1])))
