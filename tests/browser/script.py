"""script.py BROWSER DIRECTORY GALLERY - the pages of reports as they are used, in headless Chromium.

DIRECTORY has the reports study, run, orders, disk, single, box, few, sleigh, cut and members, GALLERY moving pictures.  Keys, clicks and the pointer are the browser's own
input.  Every fault is a line "fault: ..."; nothing depends on how fast the machine is.
"""
import glob
import os
import re
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


def bring(browser, element, part):
    """Scrolls to an element and waits for a part of it, which is made when it comes into view."""
    browser.run(f"({element}).scrollIntoView({{block: 'center'}})")
    wait_until(browser, f"({element}).querySelector('{part}')")


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
    bring(browser, MATRIX, "td button")
    browser.click(button)
    expect(browser.run(f"{button}.getAttribute('aria-expanded')") == "true", "unfold: nothing is expanded")
    curves = browser.run("document.querySelectorAll('.unfolded .legend input').length")
    beside = browser.run("document.querySelector('.unfolded').getBoundingClientRect().left >="
                         f"{MATRIX}.closest('.wide').getBoundingClientRect().right")
    expect(beside == (browser.run("innerWidth") > 1000), f"unfold: beside the table: {beside}")
    expect(curves >= 3, f"unfold: {curves} curves")
    expect(browser.run("document.querySelector('.unfolded').textContent.includes('dalembert report DIR/runs/')"),
           "unfold: no word of the run's page")
    browser.point("document.querySelector('.unfolded .u-over')")
    read = "document.querySelector('.unfolded .readout').textContent"
    wait_until(browser, f"{read}.startsWith('t = ')")
    check_readout(browser, "unfold", read)
    before = browser.run(read).count(", ")
    browser.click("document.querySelector('.unfolded .legend input')")
    browser.point("document.querySelector('.unfolded .u-over')", 0.6)
    wait_until(browser, f"{read}.startsWith('t = ')")
    expect(browser.run(read).count(", ") == before - 1, "unfold: not one curve is hidden")
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


def check_result_first(browser, where, result):
    """What came out is on the first screen, before the equations, on pages of other commands too."""
    end, begin = browser.run(f"[{result}.getBoundingClientRect().bottom, "
                             "document.querySelector('.equations').getBoundingClientRect().top]")
    expect(end <= begin, f"{where}: the result ends at {end:.0f} pixels, after the equations at {begin:.0f}")
    expect(end <= 800 or browser.run("innerWidth") < 800, f"{where}: the result ends {end:.0f} pixels below the top")


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


def check_readout(browser, where, text):
    """A readout shows a number of the axis and a number of each curve."""
    text = browser.run(text)
    values = re.findall(r"(?:^|[ =])-?[0-9.]+(?:e-?[0-9]+)?(?=$|[,:])", text)
    expect(len(values) >= 2, f"{where}: the readout is '{text}'")


def check_compare(browser):
    """Any methods are compared, those with modifiers, too."""
    details = "document.querySelector('details.compare')"
    focus(browser, f"{details}.querySelector('summary')")
    browser.press("Enter")
    wait_until(browser, f"{details}.querySelector('.legend')")
    before = browser.run(f"{details}.querySelectorAll('.legend input').length")
    box = f"[...{details}.querySelectorAll('fieldset label')].find(l => l.textContent.trim() === 'METHOD').control"
    checked = browser.run(box.replace("METHOD", "rk4+project") + ".checked")
    focus(browser, box.replace("METHOD", "rk4+project"))
    browser.press(" ")
    after = browser.run(f"{details}.querySelectorAll('.legend input').length")
    expect(after - before == (-1 if checked else 1), f"compare: {before} curves, then {after}")
    focus(browser, f"{details}.querySelector('.chart')")
    browser.press("ArrowRight")
    check_readout(browser, "compare", f"{details}.querySelector('.readout').textContent")
    check_layout(browser, "compare")


def find_figure(title):
    """The figure with a title, as an expression."""
    return ("[...document.querySelectorAll('.figures figure')].find(f => "
            f"f.querySelector('strong').textContent.startsWith('{title}'))")


def check_chart(browser, where, title):
    """A chart is drawn in view, reads values by keys and pointer, zooms, grows, and gives its data."""
    figure = find_figure(title)
    chart, read = f"{figure}.querySelector('.chart')", f"{figure}.querySelector('.readout').textContent"
    browser.run(f"{figure}.scrollIntoView()")
    wait_until(browser, f"{figure}.querySelector('canvas')")
    focus(browser, chart)
    for _ in range(3):
        browser.press("ArrowRight")
    check_readout(browser, f"{where}, {title}", read)
    third = browser.run(read)
    browser.press("ArrowLeft")
    expect(browser.run(read) != third, f"{where}: keys do not move the point of {title}")
    expect(browser.run(f"{figure}.querySelectorAll('.mark').length") > 0, f"{where}: no marks in {title}")

    def middle(part):
        browser.point(f"{figure}.querySelector('.u-over')", 0.5)
        browser.point(f"{figure}.querySelector('.u-over')", part)
        wait_until(browser, f"{read}.includes(' = ')")
        return float(browser.run(read).split(" = ")[1].split(":")[0])
    whole = middle(0.9)
    button = "[...FIGURE.querySelectorAll('button')].find(b => b.textContent === 'WORDS')".replace("FIGURE", figure)
    for _ in range(3):
        browser.press("+")
    close = middle(0.9)
    expect(close < whole, f"{where}: at nine tenths of {title} are {whole} and closer {close}")
    browser.click(button.replace("WORDS", "All"))
    expect(middle(0.9) == whole, f"{where}: 'All' does not show all of {title}")
    browser.drag(f"{figure}.querySelector('.u-over')", 0.2, 0.5)
    expect(middle(0.9) < whole, f"{where}: dragging does not zoom {title}")
    focus(browser, chart)
    browser.press("0")
    width = browser.run(f"{chart}.clientWidth")
    browser.click(button.replace("WORDS", "Large"))
    larger = browser.run(f"{chart}.clientWidth")
    expect(larger > width or browser.run("innerWidth") < 800, f"{where}: {title} stays {width} wide")
    check_layout(browser, f"{where}, {title} large")
    browser.click(button.replace("WORDS", "Large"))
    browser.run("URL.createObjectURL = blob => { window.saved = blob; return '#top'; }")
    browser.click(button.replace("WORDS", "CSV"))
    lines = browser.run("saved.text()").splitlines()
    expect(lines[0].startswith('"curve","') and len(lines) > 3, f"{where}: the data of {title} begin {lines[:2]}")


def check_linked(browser):
    """Charts over t show values at one time, are zoomed together, and have one legend."""
    one, other = find_figure("Coordinates"), find_figure("Angles")
    for figure in one, other:
        browser.run(f"{figure}.scrollIntoView()")
        wait_until(browser, f"{figure}.querySelector('canvas')")
    readout = "FIGURE.querySelector('.readout').textContent"
    times = [f"parseFloat({readout.replace('FIGURE', figure)}.split(' = ')[1])" for figure in (one, other)]
    focus(browser, f"{one}.querySelector('.chart')")
    for _ in range(5):
        browser.press("ArrowRight")
    expect(browser.run(times[0]) == browser.run(times[1]), "linked: two charts show two times")
    for _ in range(2):
        browser.press("+")
    browser.point(f"{other}.querySelector('.u-over')", 0.5)
    browser.point(f"{other}.querySelector('.u-over')", 0.99)
    wait_until(browser, f"{times[1]} > 1")
    end = browser.run(times[1])
    expect(end < 4, f"linked: the other chart ends at t = {end}, not zoomed")
    focus(browser, f"{one}.querySelector('.chart')")
    browser.press("0")
    legends = browser.run("document.querySelectorAll('.figures > .legend').length === document.querySelectorAll('.figures').length")
    expect(legends, "linked: not one legend for the charts of a part")
    box = "[...document.querySelectorAll('.figures > .legend label')].find(l => l.textContent.trim() === 'x').control"
    focus(browser, box)
    browser.press(" ")
    focus(browser, f"{one}.querySelector('.chart')")
    browser.press("ArrowRight")
    shown = browser.run(readout.replace("FIGURE", one))
    expect(" x " not in shown and " y " in shown, f"linked: without x the chart shows '{shown}'")
    focus(browser, box)
    browser.press(" ")


def check_play(browser, where, motions):
    """A motion plays, pauses, and follows the slider."""
    motion = "document.querySelector('.motion')"
    bodies = f"[...{motion}.querySelectorAll('.body path')].map(b => b.getAttribute('d')).join()"
    time = f"parseFloat({motion}.querySelector('.readout').textContent.split('=')[1])"
    pictures = f"{motion}.querySelectorAll('svg').length"
    bring(browser, motion, "svg")
    expect(browser.run(f"{motion}.querySelectorAll('svg .body').length") == motions, f"{where}: not {motions} motions")
    expect(browser.run(pictures) == 1, f"{where}: the motions are not on one another")
    colours = browser.run(f"[...{motion}.querySelectorAll('.trail')].map(t => getComputedStyle(t).stroke)")
    expect(len(set(colours)) == motions, f"{where}: trails of one colour: {colours}")
    if motions > 1:
        box = f"[...{motion}.querySelectorAll('label')].find(l => l.textContent.includes('Side by side')).control"
        for wanted in motions, 1:
            focus(browser, box)
            browser.press(" ")
            expect(browser.run(pictures) == wanted, f"{where}: {wanted} pictures are not side by side")
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


def check_turn(browser):
    """A disk is shown in perspective, which keys and the pointer turn; the plane does not turn."""
    stage = "document.querySelector('.motion svg')"
    body = f"[...{stage}.querySelectorAll('.body path')].map(b => b.getAttribute('d')).join()"
    box = "[...document.querySelectorAll('.motion label')].find(l => l.textContent.includes('3D')).control"
    bring(browser, "document.querySelector('.motion')", "svg")
    expect(browser.run(f"{box}.checked"), "turn: a disk is not in 3D")
    seen = browser.run(body)
    focus(browser, stage)
    for there, back in [("ArrowRight", "ArrowLeft"), ("ArrowUp", "ArrowDown")]:
        browser.press(there)
        expect(browser.run(body) != seen, f"turn: {there} does not turn it")
        browser.press(back)
        expect(browser.run(body) == seen, f"turn: {back} does not turn it back")
    browser.drag(stage, 0.3, 0.6)
    expect(browser.run(body) != seen, "turn: the pointer does not turn it")
    focus(browser, box)
    browser.press(" ")
    flat = browser.run(body)
    focus(browser, stage)
    browser.press("ArrowRight")
    expect(browser.run(body) == flat, "turn: the plane turns")


def check_box(browser):
    """A box that turns by wz = 1 up to t = pi/2 has made a quarter turn, as seen from above."""
    bring(browser, "document.querySelector('.motion')", "svg")
    box = "[...document.querySelectorAll('.motion label')].find(l => l.textContent.includes('3D')).control"
    if browser.run(f"{box}.checked"):
        focus(browser, box)
        browser.press(" ")
    slider = "document.querySelector('.motion input[type=range]')"
    focus(browser, slider)
    for key, wanted in [("Home", 1 / 0.6), ("End", 0.6)]:
        browser.press(key)
        width, height = browser.run("(b => [b.width, b.height])(document.querySelector('.motion .marks').getBBox())")
        expect(abs(width / height - wanted) < 2e-3, f"box: at {key} it is {width} times {height}")
    caption = browser.run("document.querySelector('.motion figcaption').textContent")
    expect(caption.endswith("It turns in its place."), f"box: the caption is '{caption}'")


def check_last(browser):
    """Of a run with few rows the last steps are figures of their own, which zoom together and not with the others."""
    one, other, whole = find_figure("Coordinates, the last"), find_figure("Energy, the last"), find_figure("Coordinates")
    for figure in one, other, whole:
        browser.run(f"{figure}.scrollIntoView()")
        wait_until(browser, f"{figure}.querySelector('canvas')")
    read = "FIGURE.querySelector('.readout').textContent"
    focus(browser, f"{one}.querySelector('.chart')")
    browser.press("ArrowRight")
    times = [browser.run(read.replace("FIGURE", figure)).split(":")[0] for figure in (one, other, whole)]
    expect(times[0] == times[1] == "t = 1948.9", f"last: the first of the last steps are at {times[:2]}")
    expect(times[2] != times[0], f"last: the chart of the whole run shows {times[2]}")
    motion = "document.querySelector('.motion')"
    bring(browser, motion, "svg")
    caption = browser.run(f"{motion}.querySelector('figcaption').textContent")
    expect("these are the last 512 steps, t = 1948.9 to 2000." in caption, f"last: the caption is '{caption}'")
    focus(browser, f"{motion}.querySelector('input[type=range]')")
    for key, wanted in [("Home", "t = 1948.90"), ("End", "t = 2000.00")]:
        browser.press(key)
        shown = browser.run(f"{motion}.querySelector('.readout').textContent")
        expect(shown == wanted, f"last: at {key} the motion is at {shown}")


def check_exact(browser):
    """The exact solution is beside the run, x = sin t, y = 1 - cos t, each with its name, and readable where both meet."""
    caption = browser.run("document.querySelector('.motion figcaption').textContent")
    expect(caption.startswith(" rk4, h = 0.2,  exact solution."), f"exact: the caption is '{caption}'")
    name = browser.run("document.querySelector('.motion svg').getAttribute('aria-label')")
    expect(name.startswith("Motion of a sleigh by rk4 and exact solution"), f"exact: the picture is '{name}'")
    dashes = browser.run("[...document.querySelectorAll('.motion .body path')].map(p => getComputedStyle(p).strokeDasharray)")
    expect(dashes.count("none") * 2 == len(dashes), f"exact: both bodies have the lines {dashes}")
    place = "document.querySelectorAll('.motion .path')[1]"
    width, height = browser.run(f"(b => [b.width, b.height])({place}.getBBox())")
    expect(abs(width - 100) < 0.05 and abs(height - 100) < 0.6, f"exact: its path is {width} times {height}, no circle")


def check_single(browser):
    """A system with one coordinate moves over t."""
    bring(browser, "document.querySelector('.motion')", "svg")
    caption = browser.run("document.querySelector('.motion figcaption').textContent")
    expect(caption.endswith("x over t, not to scale."), f"single: the motion is '{caption}'")
    places = []
    slider = "document.querySelector('.motion input[type=range]')"
    focus(browser, slider)
    for key in "Home", "End":
        browser.press(key)
        places.append(browser.run("document.querySelector('.motion .body').getBBox().x"))
    expect(places[1] - places[0] > 90, f"single: the point moves from {places[0]} to {places[1]} of 100")


def check_without(browser, address, width):
    """Without its script a page has the same tables and figures, and nothing to press."""
    count = "['figcaption strong', '.wide table', '.wide tbody tr', 'h2'].map(what => document.querySelectorAll(what).length)"
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
    page = {name: f"file://{directory}/{name}/report/index.html" for name in ("study", "run", "orders", "disk", "single", "box", "few", "sleigh", "cut",
                                                                        "members")}
    for width, dark in [(1280, False), (1280, True), (400, False), (400, True)]:
        browser.open(page["study"], width, dark)
        controls = check_names(browser, "study")
        check_layout(browser, "study")
        check_first_screen(browser, "study")
        check_heads(browser)
        check_sort(browser)
        check_filter(browser)
        check_unfold(browser)
        check_compare(browser)
        check_chart(browser, "study", "Energy")
        check_play(browser, "study", 2)
        check_link(browser)
        browser.open(page["run"], width, dark)
        controls += check_names(browser, "run")
        check_layout(browser, "run")
        check_first_screen(browser, "run")
        check_play(browser, "run", 1)
        check_chart(browser, "run", "Energy")
        check_linked(browser)
        browser.open(page["disk"], width, dark)
        controls += check_names(browser, "disk")
        check_turn(browser)
        check_layout(browser, "disk")
        browser.open(page["sleigh"], width, dark)
        controls += check_names(browser, "sleigh")
        check_play(browser, "sleigh", 2)
        check_exact(browser)
        check_layout(browser, "sleigh")
        browser.open(page["single"], width, dark)
        check_single(browser)
        browser.open(page["box"], width, dark)
        check_box(browser)
        browser.open(page["few"], width, dark)
        check_last(browser)
        check_layout(browser, "few")
        browser.open(page["orders"], width, dark)
        controls += check_names(browser, "orders")
        check_result_first(browser, "orders", "document.querySelector('.wide table tbody tr')")
        check_chart(browser, "orders", "Order")
        for name, result in [("cut", "document.querySelector('.lead')"), ("members", "document.querySelector('.numbers')")]:
            browser.open(page[name], width, dark)
            check_result_first(browser, name, result)
            check_layout(browser, name)
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
