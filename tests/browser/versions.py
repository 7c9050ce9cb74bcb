"""versions.py BROWSER DIRECTORY - the choice of versions of the site, in headless Chromium.

Sites of several versions are in directories named after them, with versions-list.js beside these, as CONTRIBUTING.md
says; a server of this process has them.  Every fault is a line "fault: ...".
"""
import functools
import http.server
import json
import os
import re
import sys
import threading

from chromium import Chromium

TOP = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")
PAGE = """<!doctype html><html lang="en"><title>{title}</title><script src="{up}versions.js"></script>
<header><div class="md-header__title">dalembert</div></header><h1>{title}</h1>"""
FAULTS = []


def expect(condition, text):
    """Notes a fault where the condition does not hold."""
    if not condition:
        FAULTS.append(text)
        print(f"fault: {text}")


class Files(http.server.SimpleHTTPRequestHandler):
    """Serves files and prints nothing."""

    def log_message(self, *_):
        """A request is no news."""


def write(path, text):
    """Writes a file, with its directories."""
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


def make_site(directory, version, pages):
    """A site of a version with the project's script and pages of that name, as tools/site/pages.py writes them."""
    with open(f"{TOP}/tools/site/versions.js", encoding="utf-8") as file:
        write(f"{directory}/{version}/versions.js", f"window.DALEMBERT_VERSION = {json.dumps(version)};\n" + file.read())
    for page in pages:
        write(f"{directory}/{version}/{page}", PAGE.format(title=f"{version} {page}", up="../" * page.count("/")))


def visit(browser, address):
    """Opens a page and waits for the list of versions, there or not."""
    browser.open(address, 800)
    browser.run("""new Promise(done => {
        const list = document.querySelector('script[src$="versions-list.js"]');
        if (performance.getEntriesByName(list.src).length) done(true);
        list.addEventListener('load', () => done(true));
        list.addEventListener('error', () => done(true));
    })""")


SELECT = "document.querySelector('header select')"


def choose(browser, key):
    """Chooses by a key, and waits for the page that this opens; its title."""
    browser.run(f"{SELECT}.focus()")
    browser.events.clear()
    browser.press(key)
    browser.wait("Page.loadEventFired")
    return browser.run("document.title")


def check_choice(browser, root):
    """The selector names all versions, says which one this is, and opens the same page of another one."""
    visit(browser, f"{root}/many/0.5.0/guide/page.html#part")
    expect(browser.run(f"[...{SELECT}.options].map(o => o.value)") == ["0.6.0", "0.5.0"], "versions: other names")
    expect(browser.run(f"{SELECT}.value") == "0.5.0", "versions: not this one is chosen")
    expect(browser.run(f"{SELECT}.getAttribute('aria-label')") == "Version", "versions: the choice has no name")
    title = choose(browser, "ArrowUp")
    expect(title == "0.6.0 guide/page.html", f"versions: the other version of the page is '{title}'")
    visit(browser, f"{root}/many/0.6.0/new.html")
    title = choose(browser, "ArrowDown")
    expect(title == "0.5.0 index.html", f"versions: for a page that is new the older version has '{title}'")


def check_none(browser, root):
    """There is nothing to choose with one version, or without a list."""
    for site in "one", "alone":
        visit(browser, f"{root}/{site}/0.5.0/index.html")
        expect(browser.run(f"!{SELECT}"), f"versions: something to choose, {site}")


def check_list():
    """The list has the version of the header, each version once, from the newest to the oldest."""
    with open(f"{TOP}/tools/site/versions.json", encoding="utf-8") as file:
        versions = json.load(file)
    with open(f"{TOP}/include/dalembert.h", encoding="utf-8") as file:
        number = ".".join(re.findall(r"^#define DAL_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", file.read(), re.M))
    parts = [tuple(map(int, version.split("."))) for version in versions]
    expect(number in versions, f"versions.json: version {number} is missing")
    expect(parts == sorted(set(parts), reverse=True), f"versions.json: {versions} are not in order")
    return versions


def main(program, directory):
    """All checks."""
    for site in "many", "one", "alone":
        make_site(f"{directory}/{site}", "0.5.0", ["index.html", "guide/page.html"])
    make_site(f"{directory}/many", "0.6.0", ["index.html", "guide/page.html", "new.html"])
    write(f"{directory}/many/versions-list.js", 'showVersions(["0.6.0", "0.5.0"]);\n')
    write(f"{directory}/one/versions-list.js", f"showVersions({json.dumps(check_list()[:1])});\n")
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Files, directory=directory))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    browser = Chromium(program, f"{directory}/profile")
    root = f"http://127.0.0.1:{server.server_port}"
    check_choice(browser, root)
    check_none(browser, root)
    expect(not browser.exceptions, f"versions: the script fails: {browser.exceptions[:1]}")
    browser.close()
    server.shutdown()
    print("browser: the versions of the site: used")
    return 1 if FAULTS else 0


sys.exit(main(*sys.argv[1:]))
