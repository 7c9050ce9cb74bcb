"""script.py BROWSER DIRECTORY GALLERY - the pages of reports as they are used, in headless Chromium.

DIRECTORY has the reports study, run and orders, GALLERY moving pictures.  Keys, clicks and the pointer are the browser's own
input.  Every fault is a line "fault: ..."; nothing depends on how fast the machine is.
"""
import glob
import os
import sys

from chromium import Chromium

FAULTS = []


def expect(condition, text):
    """Notes a fault where the condition does not hold."""
    if not condition:
        FAULTS.append(text)
        print(f"fault: {text}")


def wait_until(browser, condition):
    """Waits for a state of the page, tried in each frame."""
    browser.run("new Promise(done => { const look = () => "
                f"({condition}) ? done(true) : requestAnimationFrame(look); look(); }})")


def focus(browser, element):
    """Gives an element the focus."""
    browser.run(f"({element}).focus()")


CONTROLS = {"button", "checkbox", "combobox", "slider", "link", "DisclosureTriangle", "image", "img", "dialog"}


def check_names(browser, where):
    """Every control and every picture has an accessible name."""
    count = 0
    for node in browser.call("Accessibility.getFullAXTree")["nodes"]:
        role = node.get("role", {}).get("value")
        if node.get("ignored") or role not in CONTROLS:
            continue
        count += 1
        expect(node.get("name", {}).get("value", "").strip(), f"{where}: a {role} without a name")
    return count


def check_layout(browser, where):
    """Nothing is wider than the page, and no letters are small."""
    wide, small = browser.run("""(() => {
        const small = new Set();
        const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
        for (let text; (text = walker.nextNode());) {
            const e = text.parentElement, svg = e.ownerSVGElement;
            if (!text.data.trim() || e.closest('script') || !e.getClientRects().length) continue;
            const scale = svg ? svg.getBoundingClientRect().width / svg.viewBox.baseVal.width : 1;
            if (scale * parseFloat(getComputedStyle(e).fontSize) < 10.99)
                small.add(`${e.tagName} "${text.data.trim().slice(0, 30)}"`);
        }
        return [document.documentElement.scrollWidth - innerWidth, [...small]];
    })()""")
    expect(wide <= 0, f"{where}: {wide} pixels wider than the window")
    expect(not small, f"{where}: letters below 11 pixels: {', '.join(small[:3])}")


MATRIX = "document.querySelector('table.matrix')"
ROWS = f"[...{MATRIX}.tBodies[0].rows].filter(row => !row.hidden)"


def numbers_of(browser, column):
    """The numbers of a column of the first table, from above; none is left out."""
    return browser.run(f"{ROWS}.map(row => row.cells[{column}].dataset.value)"
                       ".filter(Boolean).map(Number)")


def check_sort(browser):
    """A head sorts by its column, by keyboard, then the other way round."""
    head = f"{MATRIX}.tHead.rows[0].cells[1]"
    listed = numbers_of(browser, 1)
    focus(browser, f"{head}.querySelector('button')")
    browser.press("Enter")
    expect(browser.run(f"{head}.getAttribute('aria-sort')") == "ascending", "sort: not ascending")
    expect(numbers_of(browser, 1) == sorted(listed), "sort: the numbers do not ascend")
    browser.press(" ")
    expect(numbers_of(browser, 1) == sorted(listed, reverse=True), "sort: the numbers do not descend")
    select = "[...document.querySelectorAll('label')].find(l => l.textContent.startsWith('Sort by')).control"
    focus(browser, select)
    for name, key in [("name", "row.cells[0].textContent"), ("family", "row.dataset.family"),
                      ("order", "Number(row.dataset.order)")]:
        browser.press("ArrowDown")
        expect(browser.run(f"{select}.value") == name, f"sort: the next choice is not {name}")
        shown = browser.run(f"{ROWS}.map(row => {key})")
        wanted = sorted(shown, key=lambda value: value.lower() if name != "order" else value)
        expect(shown == wanted, f"sort: not by {name}: {shown}")
    browser.press("ArrowDown")
    worst = browser.run(f"{ROWS}.map(row => Math.max(...[...row.cells].slice(1)"
                        ".map(td => Number(td.dataset.value || 0))))")
    expect(worst == sorted(worst), "sort: not by size")


def check_filter(browser):
    """Choices hide the rows that do not match, and say how many are left."""
    total = len(browser.run(f"{ROWS}.map(row => 1)"))
    for label, read in [("Family", "row.dataset.family"), ("Order", "row.dataset.order")]:
        select = f"[...document.querySelectorAll('label')].find(l => l.textContent.startsWith('{label}')).control"
        focus(browser, select)
        browser.press("ArrowDown")
        wanted = browser.run(f"{select}.value")
        shown = browser.run(f"{ROWS}.map(row => {read})")
        expect(shown and set(shown) == {wanted} and len(shown) < total, f"filter: {label} {wanted}: {shown}")
        browser.press("ArrowUp")
    select = "[...document.querySelectorAll('label')].find(l => l.textContent.startsWith('Size')).control"
    focus(browser, select)
    browser.press("ArrowDown")
    browser.press("ArrowDown")
    shown = browser.run(f"{ROWS}.map(row => row.textContent.includes('rounding'))")
    expect(shown and all(shown) and len(shown) < total, "filter: rows without the size are shown")
    dim = browser.run(f"{ROWS}.flatMap(row => [...row.cells].slice(1)).filter(td => "
                      "td.matches('.dim') === td.textContent.includes('rounding')).length")
    expect(dim == 0, "filter: other cells than those without the size are dim")
    browser.press("Home")
    expect(len(browser.run(f"{ROWS}.map(row => 1)")) == total, "filter: some rows stay hidden")


def check_unfold(browser):
    """A cell opens its curves beside the table, or below where there is no place, and closes them."""
    button = f"{ROWS}[0].querySelector('td button')"
    browser.click(button)
    expect(browser.run(f"{button}.getAttribute('aria-expanded')") == "true", "unfold: nothing is expanded")
    curves = browser.run("document.querySelectorAll('.unfolded .curve').length")
    beside = browser.run("document.querySelector('.unfolded').getBoundingClientRect().left >="
                         f"{MATRIX}.closest('.wide').getBoundingClientRect().right")
    expect(beside == (browser.run("innerWidth") > 1000), f"unfold: beside the table: {beside}")
    expect(curves >= 3, f"unfold: {curves} curves")
    expect(browser.run("document.querySelector('.unfolded').textContent.includes('dalembert report DIR/runs/')"),
           "unfold: no word of the run's page")
    browser.point("document.querySelector('.unfolded svg.plot')")
    check_readout(browser, "unfold", "document.querySelector('.unfolded .readout')")
    browser.click("document.querySelector('.unfolded input')")
    hidden = browser.run("[...document.querySelectorAll('.unfolded .curve')].map(c => c.style.display)")
    expect(hidden[0] == "none" and "none" not in hidden[1:], "unfold: not the first curve is hidden")
    check_layout(browser, "unfolded")
    browser.click("document.querySelector('.unfolded button')")
    expect(browser.run("!document.querySelector('.unfolded')"), "unfold: it does not fold")


def check_first_screen(browser, where):
    """The result is on the first screen of 800 pixels; the contents stay beside it."""
    shown = browser.run("[...document.querySelectorAll('.lead, .families, .verdicts')]"
                        ".map(e => e.getBoundingClientRect().bottom)")
    expect(len(shown) > 1, f"{where}: no result")
    if browser.run("innerWidth") < 1000:
        return
    expect(max(shown) <= 800, f"{where}: the result ends {max(shown):.0f} pixels below the top")
    browser.run("scrollTo(0, document.body.scrollHeight)")
    top, right, left = browser.run("""[document.querySelector('.contents').getBoundingClientRect().top,
        document.querySelector('.contents').getBoundingClientRect().right,
        document.querySelector('main').getBoundingClientRect().left]""")
    expect(0 <= top < 100 and right <= left, f"{where}: the contents are at {top}, {right}, not left of {left}")
    browser.run("scrollTo(0, 0)")


def check_heads(browser):
    """Heads and first column of a long table stay in view; every link of the contents leads to a part."""
    wide = f"{MATRIX}.closest('.wide')"
    browser.run(f"{wide}.scrollTo(300, 400)")
    inside = f"(e => [e.top - {wide}.getBoundingClientRect().top, e.left - {wide}.getBoundingClientRect().left])"
    head = browser.run(f"{inside}({MATRIX}.tHead.rows[0].cells[1].getBoundingClientRect())")
    name = browser.run(f"{inside}({ROWS}.at(-1).cells[0].getBoundingClientRect())")
    expect(abs(head[0]) < 3, f"heads: a head is {head[0]} pixels below the top of its table")
    expect(abs(name[1]) < 3, f"heads: a name is {name[1]} pixels from the left of its table")
    browser.run(f"{wide}.scrollTo(0, 0)")
    lost = browser.run("[...document.querySelectorAll('.contents a')].map(a => a.hash)"
                       ".filter(hash => !document.getElementById(hash.slice(1)))")
    expect(not lost, f"contents: {lost} lead nowhere")
    grey = browser.run("[...document.querySelectorAll('td.off')].filter(td => td.dataset.size || "
                       "['x', 'n/a', '-'].includes(td.textContent)).map(td => td.textContent)")
    expect(not grey, f"heads: grey cells state something: {grey[:3]}")
    smaller = browser.run("[...document.querySelectorAll('td.trend')].filter(td => td.querySelector('b') && "
                          "td.querySelector('small') && parseFloat(getComputedStyle(td.querySelector('b')).fontSize)"
                          " <= parseFloat(getComputedStyle(td.querySelector('small')).fontSize)).length")
    expect(smaller == 0, f"heads: {smaller} numbers are not larger than their words")


def check_link(browser):
    """A cell leads to the page of its run where there is one."""
    browser.click(f"{ROWS}.find(row => row.cells[0].textContent.trim() === 'rk4+project').querySelector('td button')")
    browser.events.clear()
    browser.click("document.querySelector('.unfolded a')")
    browser.wait("Page.loadEventFired")
    facts = browser.run("document.querySelector('.facts').textContent")
    expect("rk4+project" in facts, f"link: not the page of the run by rk4+project: {facts}")


def check_readout(browser, where, readout):
    """A readout shows a name and two numbers."""
    text = browser.run(f"{readout}.textContent")
    values = text.rpartition(": ")[2].split(", ")
    try:
        expect(len([float(value) for value in values]) == 2, f"{where}: the readout is '{text}'")
    except ValueError:
        expect(False, f"{where}: the readout is '{text}'")


def check_compare(browser):
    """Any methods are compared, those with modifiers, too."""
    details = "document.querySelector('details.compare')"
    focus(browser, f"{details}.querySelector('summary')")
    browser.press("Enter")
    wait_until(browser, f"{details}.querySelector('.curve')")
    before = browser.run(f"{details}.querySelectorAll('.curve').length")
    box = f"[...{details}.querySelectorAll('fieldset label')].find(l => l.textContent.trim() === 'METHOD').control"
    checked = browser.run(box.replace("METHOD", "rk4+project") + ".checked")
    focus(browser, box.replace("METHOD", "rk4+project"))
    browser.press(" ")
    after = browser.run(f"{details}.querySelectorAll('.curve').length")
    expect(after - before == (-1 if checked else 1), f"compare: {before} curves, then {after}")
    focus(browser, f"{details}.querySelector('svg.plot')")
    browser.press("ArrowRight")
    check_readout(browser, "compare", f"{details}.querySelector('.readout')")
    check_layout(browser, "compare")


def check_enlarge(browser, where, figure):
    """A figure enlarges, hides a curve and shows values; Escape closes it."""
    image = ("[...document.querySelectorAll('.enlarge')].find(b => "
             f"b.getAttribute('aria-label').startsWith('Enlarge: {figure}'))")
    focus(browser, image)
    browser.press("Enter")
    expect(browser.run("document.querySelector('dialog')?.open"), f"{where}: no figure is enlarged")
    larger = browser.run(f"document.querySelector('dialog svg').getBoundingClientRect().width /"
                         f"{image}.getBoundingClientRect().width")
    expect(larger > 1 or browser.run("innerWidth") < 600, f"{where}: the figure is {larger:.2f} times as large")
    browser.click("document.querySelector('dialog input')")
    expect(browser.run("document.querySelector('dialog g[id^=gnuplot_plot]').style.display") == "none",
           f"{where}: no curve of the figure is hidden")
    browser.click("document.querySelector('dialog input')")
    browser.point("document.querySelector('dialog svg')")
    check_readout(browser, where, "document.querySelector('dialog .readout')")
    check_names(browser, f"{where}, enlarged")
    browser.press("Escape")
    wait_until(browser, "!document.querySelector('dialog')")
    expect(browser.run(f"document.activeElement === {image}"), f"{where}: the focus is lost after a figure")


def check_play(browser, where, motions):
    """A motion plays, pauses, and follows the slider."""
    motion = "document.querySelector('.motion')"
    bodies = f"[...{motion}.querySelectorAll('.body')].map(b => b.getAttribute('transform')).join()"
    time = f"parseFloat({motion}.querySelector('.readout').textContent.split('=')[1])"
    expect(browser.run(f"{motion}.querySelectorAll('svg').length") == motions, f"{where}: not {motions} motions")
    # The bar of a picture whose longer side is 100 units has the stated length, at most a quarter of it.
    bar, stated, extent = browser.run(f"""(() => {{
        const parts = [...document.querySelectorAll('script.data')].map(place => JSON.parse(place.textContent));
        const {{motions}} = parts.find(part => part.motions.length);
        const range = name =>
            Math.max(...motions.map(m => m[name][1] ?? m[name][0])) - Math.min(...motions.map(m => m[name][0]));
        return [{motion}.querySelector('.scale').getBBox().width,
            Number({motion}.querySelector('figcaption').textContent.match(/bar is ([-e.\\d]+)/)[1]),
            Math.max(range('x'), range('y'))];
    }})()""")
    expect(abs(bar / 100 * extent - stated) < 1e-4 * stated, f"{where}: the bar is {bar} % of {extent}, not {stated}")
    expect(0.09 * extent < stated < 0.26 * extent, f"{where}: a bar of {stated} beside {extent}")
    still = browser.run(bodies)
    # The slowest speed: the end is minutes away, however slow the machine is.
    focus(browser, f"[...{motion}.querySelectorAll('label')].find(l => l.textContent.startsWith('Speed')).control")
    browser.press("Home")
    expect(browser.run("document.activeElement.value") == "0.1", f"{where}: the slowest speed is not chosen")
    focus(browser, f"{motion}.querySelector('button')")
    browser.press("Enter")
    wait_until(browser, f"{time} > 0")
    wait_until(browser, f"{time} > {browser.run(time)}")
    expect(browser.run(bodies) != still, f"{where}: the body does not move")
    browser.press("Enter")
    expect(browser.run(f"{motion}.querySelector('button').textContent") == "Play", f"{where}: it does not pause")
    focus(browser, f"{motion}.querySelector('input[type=range]')")
    browser.press("End")
    end = browser.run(time)
    expect(end in (4, 5), f"{where}: the end of the slider is at t = {end}")
    expect(browser.run(f"{motion}.querySelector('.trail').getAttribute('d').length") > 100, f"{where}: no trail")
    browser.press("Home")
    expect(browser.run(bodies) == still, f"{where}: the body does not come back")


def check_without(browser, address, width):
    """Without its script a page has the same tables and figures, and nothing to press."""
    count = "['img', 'table', 'tbody tr', 'h2'].map(what => document.querySelectorAll(what).length)"
    browser.open(address, width)
    wanted = browser.run(count)
    browser.open(address, width, script=False)
    expect(browser.run(count) == wanted, f"{address}: the page has not everything without its script")
    expect(browser.run("!document.querySelector('button, select, input')"), f"{address}: something to press")
    check_layout(browser, f"{address} without script")


def check_gallery(browser, gallery):
    """The moving pictures of the documents move, but not for who prefers reduced motion."""
    for picture in sorted(glob.glob(f"{gallery}/*_motion.svg")):
        expect(os.path.getsize(picture) <= 200000, f"{picture} has more than 200 kB")
        for still in False, True:
            browser.open(f"file://{picture}", 800, still=still)
            moving = browser.run("document.getAnimations().filter(a => a.playState === 'running').length")
            expect((moving == 0) == still, f"{picture}: {moving} parts move, reduced motion: {still}")


def main(program, directory, gallery):
    """All checks, in a wide and a narrow window, light and dark."""
    browser = Chromium(program, f"{directory}/profile-script")
    page = {name: f"file://{directory}/{name}/report/index.html" for name in ("study", "run", "orders")}
    for width, dark in [(1280, False), (400, True)]:
        browser.open(page["study"], width, dark)
        controls = check_names(browser, "study")
        check_layout(browser, "study")
        check_first_screen(browser, "study")
        check_heads(browser)
        check_sort(browser)
        check_filter(browser)
        check_unfold(browser)
        check_compare(browser)
        check_enlarge(browser, "study", "Energy")
        check_play(browser, "study", 2)
        check_link(browser)
        browser.open(page["run"], width, dark)
        controls += check_names(browser, "run")
        check_layout(browser, "run")
        check_first_screen(browser, "run")
        check_play(browser, "run", 1)
        check_enlarge(browser, "run", "Energy")
        browser.open(page["orders"], width, dark)
        controls += check_names(browser, "orders")
        check_enlarge(browser, "orders", "Order")
        for address in page.values():
            check_without(browser, address, width)
        expect(not browser.exceptions, f"the script fails: {browser.exceptions[:1]}")
        print(f"browser: {'dark' if dark else 'light'}, {width} pixels: used, {controls} controls and pictures")
    check_gallery(browser, os.path.abspath(gallery))
    browser.open(page["study"], 1280)
    load = browser.run("performance.getEntriesByType('navigation')[0].loadEventEnd")
    print(f"browser: the page of the study is there after {load:.0f} ms")
    browser.close()
    return 1 if FAULTS else 0


sys.exit(main(*sys.argv[1:]))
