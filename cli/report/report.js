// report.js - what can be pressed on the pages of `dalembert report`, which are complete without it:
// tables are sorted and filtered, and their cells unfold; methods are compared; figures enlarge and
// show their values; motions play.  The data are on the page as JSON, see docs/formats.md.

// ---- elements ------------------------------------------------------------------------------------

// An element with attributes, listeners (functions) and children (elements or texts).
function fill(made, attributes, children = []) {
    for (const [name, value] of Object.entries(attributes))
        if (typeof value === 'function') made.addEventListener(name, value);
        else made.setAttribute(name, value);
    made.append(...children);
    return made;
}
const html = (name, attributes = {}, ...children) =>
    fill(document.createElement(name), attributes, children);
const svg = (name, attributes = {}, ...children) =>
    fill(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

// A choice with its label; options are texts, or pairs of a value and a text.
function choice(label, options, change) {
    const select = html('select', {change: () => change(select.value)},
        ...options.map(o => html('option', {value: [o].flat()[0]}, [o].flat().at(-1))));
    return html('label', {class: 'control'}, label + ' ', select);
}

function tick(label, isTicked, change, colour) {
    const box = html('input', {type: 'checkbox', change: () => change(box.checked)});
    box.checked = isTicked;
    const sample = colour ? [html('span', {class: 'sample', style: `background: ${colour}`})] : [];
    return html('label', {class: 'control'}, box, ...sample, ' ' + label);
}

// ---- data ----------------------------------------------------------------------------------------

// Integers of 16 bits, little-endian, in base64.
function levels(text) {
    const bytes = atob(text), byte = i => bytes.charCodeAt(i);
    return Array.from({length: bytes.length / 2}, (_, i) => byte(2 * i) + 256 * byte(2 * i + 1));
}

const QUANTITIES = {D: 'max |D|', E: 'max |E − E(0)|', I: 'max |I − I(0)|',
    H: 'max |H − H(0)|, from p, π ≠ 0', error: 'max |q − exact|'};

// A system of the page: its cells by method and step, of which each start has given a part.
class System {
    constructor(place) {
        Object.assign(this, {label: '', steps: [], motions: []}, JSON.parse(place.textContent));
        this.place = place;
        this.found = new Map();
        for (const part of this.cells || [])
            this.found.set(`${part.method} ${part.step}`, {...part, ...this.find(part.method, part.step)});
    }
    find(method, step) {
        return this.found.get(`${method} ${step}`);
    }
    // The envelope of a quantity, as points of a curve.
    curve(cell, quantity, name) {
        const value = level => level === 0 ? 0 : level === 65535 ? Infinity : 2 ** ((level - 32768) / 256);
        const times = this.steps[cell.step].t;
        return {name, points: levels(cell[quantity]).map((level, i) => [times[i], value(level)])};
    }
}
const systems = [...document.querySelectorAll('script.data')].map(place => new System(place));

// ---- values under the pointer --------------------------------------------------------------------

const short = x => x !== 0 && Math.abs(x) < 0.01 ? x.toExponential(2) : String(Number(x.toPrecision(4)));

// Shows the point of the visible curves that is next to the pointer, or that the arrow keys lead to.
// A curve has a name, pixels [x, y], their values and whether it is hidden.
function inspect(picture, curves, readout) {
    const mark = svg('circle', {r: 4, class: 'mark', visibility: 'hidden'});
    let at = {curve: 0, point: -1};
    picture.append(mark);
    const show = (curve, point) => {
        const {name, pixels, values} = curves[curve], [x, y] = pixels[point];
        at = {curve, point};
        fill(mark, {visibility: 'visible', cx: x, cy: y});
        readout.textContent = `${name}: ${short(values[point][0])}, ${short(values[point][1])}`;
    };
    picture.addEventListener('pointermove', event => {
        const toPicture = picture.getScreenCTM().inverse();
        const p = new DOMPoint(event.clientX, event.clientY).matrixTransform(toPicture);
        let least = Infinity, found;
        curves.forEach((curve, c) => curve.hidden || curve.pixels.forEach(([x, y], i) => {
            const distance = (x - p.x) ** 2 + (y - p.y) ** 2;
            if (distance < least) [least, found] = [distance, [c, i]];
        }));
        if (found) show(...found);
    });
    picture.addEventListener('keydown', event => {
        const along = {ArrowLeft: -1, ArrowRight: 1}[event.key] || 0;
        const across = {ArrowUp: -1, ArrowDown: 1}[event.key] || 0;
        const shown = curves.flatMap((curve, c) => curve.hidden || !curve.pixels.length ? [] : [c]);
        if ((!along && !across) || !shown.length) return;
        event.preventDefault();
        const next = shown[(Math.max(0, shown.indexOf(at.curve)) + across + shown.length) % shown.length];
        show(next, Math.min(Math.max(at.point + along, 0), curves[next].pixels.length - 1));
    });
}

// ---- plots ---------------------------------------------------------------------------------------

const COLOURS = ['#d9600f', '#2f80d0', '#3d9a3d', '#d1479f', '#12908e', '#9a5fd0', '#94851a', '#d33b4b'];
const DASHES = ['', '7 4', '2 3'];
const LEFT = 58, RIGHT = 12, TOP = 10, BOTTOM = 34, HEIGHT = 300;

// Curves over logarithms of both axes, with a key whose boxes hide them, inside the holder.
function plot(holder, curves, ylabel) {
    const width = Math.max(260, Math.min(holder.clientWidth || 480, 680));
    const logs = curves.map(curve => curve.points.filter(([x, y]) => x > 0 && y > 0 && isFinite(y))
        .map(p => p.map(Math.log10)));
    const all = logs.flat(), readout = html('output', {class: 'readout'}, 'Point at a curve for values.');
    const zero = curves.filter(curve => curve.points.every(p => p[1] === 0)).map(curve => curve.name);
    holder.replaceChildren();
    if (zero.length) holder.append(html('p', {}, `0 at all rows: ${zero.join(', ')}.`));
    if (!all.length) return;
    const range = k => {
        const values = all.map(p => p[k]), low = Math.floor(Math.min(...values));
        return [low, Math.max(Math.ceil(Math.max(...values)), low + 1)];
    };
    const [x, y] = [range(0), range(1)];
    const place = ([u, v]) => [
        LEFT + (u - x[0]) / (x[1] - x[0]) * (width - LEFT - RIGHT),
        HEIGHT - BOTTOM - (v - y[0]) / (y[1] - y[0]) * (HEIGHT - TOP - BOTTOM)];
    const picture = svg('svg', {viewBox: `0 0 ${width} ${HEIGHT}`, role: 'img', tabindex: 0, class: 'plot',
        'aria-label': `${ylabel} over t for ${curves.map(curve => curve.name).join(', ')}`});
    const line = ([x1, y1], [x2, y2]) => picture.append(svg('line', {x1, y1, x2, y2, class: 'grid'}));
    const text = (attributes, words) => picture.append(svg('text', attributes, words));
    const decade = e => Math.abs(e) < 4 ? String(Number(`1e${e}`)) : `1e${e}`;
    for (let e = x[0], by = Math.ceil((x[1] - x[0]) / 6); e <= x[1]; e += by) {
        line(place([e, y[0]]), place([e, y[1]]));
        text({x: place([e, 0])[0], y: HEIGHT - BOTTOM + 15, 'text-anchor': 'middle'}, decade(e));
    }
    for (let e = y[0], by = Math.ceil((y[1] - y[0]) / 7); e <= y[1]; e += by) {
        line(place([x[0], e]), place([x[1], e]));
        text({x: LEFT - 5, y: place([0, e])[1] + 4, 'text-anchor': 'end'}, decade(e));
    }
    text({x: (LEFT + width - RIGHT) / 2, y: HEIGHT - 4, 'text-anchor': 'middle'}, 't');
    const key = html('div', {class: 'key-of-plot', role: 'group', 'aria-label': 'Curves'}), shown = [];
    curves.forEach((curve, i) => {
        if (!logs[i].length) return;
        const pixels = logs[i].map(place), colour = COLOURS[i % COLOURS.length];
        const dashes = DASHES[Math.floor(i / COLOURS.length) % DASHES.length];
        const path = svg('path', {class: 'curve', stroke: colour, 'stroke-dasharray': dashes,
            d: 'M' + pixels.map(p => p.map(c => c.toFixed(1))).join('L')});
        const item = {name: curve.name, pixels, values: logs[i].map(p => p.map(c => 10 ** c)), hidden: false};
        picture.append(path);
        shown.push(item);
        key.append(tick(curve.name, true, isOn => {
            item.hidden = !isOn;
            path.style.display = isOn ? '' : 'none';
        }, colour));
    });
    holder.append(html('p', {class: 'faint'}, ylabel), picture, readout, key);
    inspect(picture, shown, readout);
}

// ---- tables --------------------------------------------------------------------------------------

const SIZES = ['exact', 'rounding', 'larger'];
const TRENDS = ['none', 'settles', 'random walk', 'linear', 'power law', 'growing oscillation',
    'exponential', 'undecided', 'aborted', 'failed'];

// A cell of a table: its words and its number.
function readCell(td) {
    const {size = '', trend = '', value} = td.dataset;
    return {td, size, trend: size === 'exact' ? 'none' : trend, value: value ? Number(value) : NaN};
}

class Matrix {
    constructor(table) {
        this.table = table;
        this.heads = [...table.tHead.rows[0].querySelectorAll('th')];
        this.rows = [...table.tBodies[0].rows].map(tr => ({tr, method: tr.cells[0].textContent,
            family: tr.dataset.family, order: Number(tr.dataset.order),
            cells: [...tr.cells].slice(1).map(readCell)}));
        this.heads.forEach((head, i) => this.addSort(head, i));
        for (const row of this.rows) row.cells.forEach((cell, i) => this.addUnfold(row, cell, this.heads[i]));
    }

    // A head sorts the rows by the numbers below it, then the other way round.
    addSort(head, column) {
        head.replaceChildren(html('button', {type: 'button', class: 'plain', click: () => {
            const sign = head.getAttribute('aria-sort') === 'ascending' ? -1 : 1;
            this.sort((a, b) => sign * compare(a.cells[column].value, b.cells[column].value));
            head.setAttribute('aria-sort', sign > 0 ? 'ascending' : 'descending');
        }}, ...head.childNodes));
    }

    addUnfold(row, cell, head) {
        const system = systems.find(s => s.label === head.dataset.label);
        const step = system ? system.steps.findIndex(s => s.h === head.dataset.step || s.h === Number(head.dataset.step)) : -1;
        const found = system && system.find(row.method, step);
        if (!found) return;
        const words = [...cell.td.childNodes].map(n => n.textContent).join(' ');
        const button = html('button', {type: 'button', class: 'plain', 'aria-expanded': 'false',
            'aria-label': `${row.method}, ${system.label}: ${words}`,
            click: () => this.unfold(row, button, system, found)}, ...cell.td.childNodes);
        cell.td.append(button);
    }

    // Opens the curves of a cell beside the table in place of another one, or closes them.
    unfold(row, button, system, cell) {
        const wasOpen = button.getAttribute('aria-expanded') === 'true', place = this.table.closest('.beside');
        for (const b of this.table.querySelectorAll('[aria-expanded=true]')) b.setAttribute('aria-expanded', 'false');
        place.querySelector('.unfolded')?.remove();
        place.classList.toggle('open', !wasOpen);
        if (wasOpen) return;
        const holder = html('div', {class: 'plot-holder'}), h = system.steps[cell.step].h;
        const link = cell.page
            ? html('a', {href: `../${encodeURI(cell.run)}/report/index.html`}, 'page of this run')
            : html('code', {}, `dalembert report DIR/${cell.run}`);
        place.append(html('section', {class: 'unfolded', 'aria-label': `${cell.method}, ${system.label}`},
            html('strong', {}, `${cell.method}, ${system.label}, h = ${h}`), ' ',
            html('button', {type: 'button', click: () => {
                this.unfold(row, button, system, cell);
                button.focus();
            }}, 'Close'),
            holder, html('p', {}, cell.page ? 'The ' : 'Its page is made by ', link)));
        button.setAttribute('aria-expanded', 'true');
        const names = Object.keys(QUANTITIES).filter(q => cell[q]);
        plot(holder, names.map(q => system.curve(cell, q, QUANTITIES[q])), 'Maxima up to t');
    }

    sort(order) {
        this.heads.forEach(head => head.removeAttribute('aria-sort'));
        const sorted = order ? [...this.rows].sort(order) : this.rows;
        this.table.tBodies[0].append(...sorted.map(row => row.tr));
    }

    // Hides the rows without a match and dims the cells that are none; the number of rows shown.
    filter({family, order, size, trend}) {
        const isMatch = cell => (!size || cell.size === size) && (!trend || cell.trend === trend);
        let count = 0;
        for (const row of this.rows) {
            const isShown = (!family || row.family === family) && (!order || row.order === Number(order)) &&
                (!(size || trend) || row.cells.some(isMatch));
            row.tr.hidden = !isShown;
            for (const cell of row.cells) cell.td.classList.toggle('dim', !isMatch(cell));
            count += isShown;
        }
        return count;
    }
}

// Numbers in increasing order, then what is none.
const compare = (a, b) => isNaN(a) - isNaN(b) || (a < b ? -1 : a > b ? 1 : 0);
const largest = (row, of) => Math.max(-1, ...row.cells.map(of).filter(x => !isNaN(x)));

const ORDERS = {
    'as listed': null,
    name: (a, b) => a.method.localeCompare(b.method),
    family: (a, b) => a.family.localeCompare(b.family),
    order: (a, b) => a.order - b.order,
    size: (a, b) => largest(a, c => c.value) - largest(b, c => c.value),
    trend: (a, b) => largest(a, c => TRENDS.indexOf(c.trend)) - largest(b, c => TRENDS.indexOf(c.trend)),
};

function addTools() {
    const matrices = [...document.querySelectorAll('table.matrix')].map(table => new Matrix(table));
    if (!matrices.length) return;
    const wanted = {}, count = html('output', {class: 'control'});
    const distinct = values => [...new Set(values)];
    const rows = matrices.flatMap(m => m.rows), all = Math.max(...matrices.map(m => m.rows.length));
    const choose = name => value => {
        wanted[name] = value;
        const shown = matrices.map(m => m.filter(wanted));
        count.textContent = `${Math.max(...shown)} of ${all} methods`;
    };
    const filter = (label, name, options) => choice(label, [['', 'any'], ...options], choose(name));
    const first = matrices[0].table.closest('.beside').previousElementSibling;
    first.before(html('div', {class: 'tools', role: 'group', 'aria-label': 'Tables'},
        filter('Family', 'family', distinct(rows.map(r => r.family))),
        filter('Order', 'order', distinct(rows.map(r => r.order)).sort((a, b) => a - b)),
        filter('Size', 'size', SIZES), filter('Trend', 'trend', TRENDS),
        choice('Sort by', Object.keys(ORDERS), name => matrices.forEach(m => m.sort(ORDERS[name]))), count));
    choose('family')('');
}

// ---- methods side by side ------------------------------------------------------------------------

// Curves of a quantity under the methods that are chosen, of all that were run.
function addChooser(system) {
    const cells = [...system.found.values()];
    const quantities = Object.keys(QUANTITIES).filter(q => cells.some(cell => cell[q]));
    if (!quantities.length) return;
    const methods = [...new Set(cells.map(cell => cell.method))];
    const usual = ['rk4', 'gauss4', 'spark4', 'rk4+project'].filter(method => methods.includes(method));
    const chosen = new Set(usual.length ? usual : methods.slice(0, 2));
    const holder = html('div', {class: 'plot-holder'});
    const wanted = {quantity: quantities[0], step: 0};
    const draw = () => {
        const {quantity, step} = wanted;
        const found = [...chosen].map(method => system.find(method, step)).filter(c => c && c[quantity]);
        plot(holder, found.map(cell => system.curve(cell, quantity, cell.method)), QUANTITIES[quantity]);
    };
    const choose = name => value => {
        wanted[name] = value;
        draw();
    };
    const boxes = methods.map(method => tick(method, chosen.has(method), isOn => {
        chosen[isOn ? 'add' : 'delete'](method);
        draw();
    }));
    system.place.before(html('details', {class: 'compare', toggle: event => event.target.open && draw()},
        html('summary', {}, 'compare any methods'),
        html('div', {class: 'tools'},
            choice('Quantity', quantities.map(q => [q, QUANTITIES[q]]), choose('quantity')),
            choice('Step', system.steps.map((s, i) => [i, s.h]), choose('step'))),
        html('fieldset', {class: 'methods'}, html('legend', {}, 'Methods'), ...boxes), holder));
}

// ---- motions -------------------------------------------------------------------------------------

const BODY_SIZE = 5.5; // half the length of a body; a path is 100 wide

// The numbers of the poses as functions of time.
class Motion {
    constructor(data) {
        Object.assign(this, data);
        for (const name of ['x', 'y', 'angle', 'steer', 'width']) {
            const [low, high, text] = data[name];
            this[name] = text ? levels(text).map(level => low + (high - low) * level / 65535)
                : new Array(data.frames).fill(low);
        }
    }
    frame(t) {
        const f = (t - this.start) / (this.end - this.start) * (this.frames - 1);
        return Math.min(Math.max(f, 0), this.frames - 1);
    }
    // Rows that are far apart follow each other without anything between them.
    at(name, f) {
        const values = this[name], i = Math.min(Math.floor(f), this.frames - 2);
        return this.smooth ? values[i] + (values[i + 1] - values[i]) * (f - i) : values[Math.round(f)];
    }
}

// One motion in a frame that all motions of a system share: map leads from the plane to it.
class Stage {
    constructor(motion, map, box, bar) {
        this.motion = motion;
        this.map = map;
        this.path = svg('path', {class: motion.smooth ? 'path' : 'path dots'});
        this.trail = svg('path', {class: 'trail'});
        this.parts = motion.parts.map(part => ({...part, shape: part.radius
            ? svg('circle', {r: part.radius}) : svg('path', {d: 'M' + part.line.join('L')})}));
        this.body = svg('g', {class: 'body'}, ...this.parts.map(part => part.shape));
        this.path.setAttribute('d', this.line(0, motion.frames - 1));
        this.picture = svg('svg', {viewBox: box.join(' '), role: 'img', class: 'stage',
            'aria-label': `Motion of a ${motion.body} by ${motion.method} over ${motion.axes.join(' and ')}`},
            this.path, this.trail, this.body, svg('path', {class: 'scale', d: `M${box[0] + 3} ` +
                `${box[1] + box[3] - 3}h${map(bar, 0)[0] - map(0, 0)[0]}`}));
        this.figure = html('figure', {}, this.picture,
            html('figcaption', {}, `${motion.method}, h = ${motion.step}; the bar is ${bar} long`));
    }
    place(f) {
        return this.map(this.motion.at('x', f), this.motion.at('y', f));
    }
    // The path from one frame to another; dots where it is not known between them.
    line(from, to) {
        const points = [];
        for (let f = from; f < to; f++) points.push(this.place(f));
        points.push(this.place(to));
        const texts = points.map(p => p.map(c => c.toFixed(2)).join(' '));
        return this.motion.smooth ? 'M' + texts.join('L') : texts.map(p => `M${p}h0`).join('');
    }
    show(t, trail) {
        const m = this.motion, f = m.frame(t), [x, y] = this.place(f), degrees = 180 / Math.PI;
        this.body.setAttribute('transform', `translate(${x} ${y}) scale(${BODY_SIZE} ${-BODY_SIZE}) ` +
            `rotate(${m.at('angle', f) * degrees})`);
        for (const {shape, pivot, turn, narrowed} of this.parts)
            shape.setAttribute('transform', `translate(${pivot.join(' ')}) ` +
                `rotate(${turn * m.at('steer', f) * degrees}) scale(1 ${narrowed ? m.at('width', f) : 1})`);
        const from = Math.max(0, Math.ceil(f - trail * m.frames));
        this.trail.setAttribute('d', trail > 0 ? this.line(from, f) : '');
    }
}

// Plays the motions of a system side by side, in SECONDS at speed 1.
function addMotions(system) {
    const SECONDS = 20, motions = system.motions.map(data => new Motion(data));
    if (!motions.length) return;
    const ranges = ['x', 'y'].map(name => {
        const all = motions.flatMap(m => m[name]);
        return [Math.min(...all), Math.max(...all)];
    });
    const size = ranges.map(([low, high]) => high - low), extent = Math.max(...size) || 1;
    const edge = 2 * BODY_SIZE;
    const map = (x, y) => [100 * (x - ranges[0][0]) / extent, 100 * (ranges[1][1] - y) / extent];
    const box = [-edge, -edge, 100 * size[0] / extent + 2 * edge, 100 * size[1] / extent + 2 * edge];
    // 1, 2 or 5 times a power of ten, a tenth to a quarter of the path.
    const power = 10 ** Math.floor(Math.log10(extent / 4)), times = extent / 4 / power;
    const bar = Number(((times < 2 ? 1 : times < 5 ? 2 : 5) * power).toPrecision(1));
    const stages = motions.map(motion => new Stage(motion, map, box, bar));
    const start = Math.min(...motions.map(m => m.start)), end = Math.max(...motions.map(m => m.end));
    const slider = html('input', {type: 'range', min: 0, max: 1000, value: 0, 'aria-label': 'Time',
        input: () => show(start + (end - start) * slider.value / 1000)});
    const readout = html('output', {class: 'readout'});
    const button = html('button', {type: 'button', click: () => play(!isPlaying)}, 'Play');
    let now = start, isPlaying = false, speed = 1, trail = 0.15, before = 0;
    const apart = t => {
        const [a, b] = motions.map(m => [m.at('x', m.frame(t)), m.at('y', m.frame(t))]);
        if (!b) return '';
        const distance = Math.hypot(a[0] - b[0], a[1] - b[1]), least = extent * 1e-4;
        return distance < least ? `, less than ${short(least)} apart` : `, ${short(distance)} apart`;
    };
    const show = t => {
        now = t;
        slider.value = 1000 * (t - start) / (end - start);
        stages.forEach(stage => stage.show(t, trail));
        readout.textContent = `t = ${t.toFixed(2)}${apart(t)}`;
    };
    const play = wanted => {
        isPlaying = wanted;
        button.textContent = wanted ? 'Pause' : 'Play';
        if (wanted && now >= end) now = start;
        before = performance.now();
        if (wanted) requestAnimationFrame(advance);
    };
    const advance = time => {
        if (!isPlaying) return;
        show(Math.min(end, now + Math.max(0, time - before) / 1000 * speed * (end - start) / SECONDS));
        before = time;
        if (now < end) requestAnimationFrame(advance); else play(false);
    };
    const speeds = choice('Speed', [0.1, 0.25, 0.5, 1, 2, 4].map(x => [x, `× ${x}`]), value => {
        speed = Number(value);
    });
    const trails = choice('Trail', [[0.15, 'short'], [1, 'all'], [0, 'none']], value => {
        trail = Number(value);
        show(now);
    });
    speeds.querySelector('select').value = 1;
    system.place.before(html('section', {class: 'motion', 'aria-label': `Motion ${system.label}`},
        html('div', {class: 'stages'}, ...stages.map(stage => stage.figure)),
        html('div', {class: 'tools'}, button, slider, speeds, trails, readout)));
    show(start);
}

// ---- figures -------------------------------------------------------------------------------------

// The axes of a figure of gnuplot, [pixel, pixel, value, value, whether logarithmic] each.
function readAxes(picture) {
    const words = picture.querySelector('metadata');
    const numbers = words ? words.textContent.trim().split(/\s+/).map(Number) : [];
    return numbers.length === 10 ? [numbers.slice(0, 5), numbers.slice(5)] : null;
}

// The points of a curve between the axes: what lies elsewhere is its sample in the key.
function readCurve(group, axes) {
    const isInside = (pixel, [from, to]) => (pixel - from) * (pixel - to) < Math.abs(to - from);
    const value = (pixel, [from, to, low, high, isLog]) => {
        const part = (pixel - from) / (to - from);
        return isLog ? low * (high / low) ** part : low + (high - low) * part;
    };
    const pixels = [...group.querySelectorAll('path')]
        .flatMap(path => [...path.getAttribute('d').matchAll(/(-?[\d.]+)[ ,](-?[\d.]+)/g)])
        .map(match => [Number(match[1]), Number(match[2])])
        .filter(pixel => axes.every((axis, k) => isInside(pixel[k], axis)));
    const text = group.querySelector('text');
    return {name: text ? text.textContent.trim() : '', group, pixels, hidden: false,
        values: pixels.map(pixel => axes.map((axis, k) => value(pixel[k], axis)))};
}

// A figure as large as the window, in the page so that its curves can be hidden and read.
function enlarge(image) {
    const holder = html('div', {class: 'large'}), readout = html('output', {class: 'readout'});
    const key = html('div', {class: 'key-of-plot', role: 'group', 'aria-label': 'Curves'});
    const dialog = html('dialog', {'aria-label': image.alt, close: () => dialog.remove()},
        html('button', {type: 'button', click: () => dialog.close()}, 'Close'), holder, readout, key);
    document.body.append(dialog);
    if (image.src.startsWith('data:image/svg+xml')) {
        holder.innerHTML = decodeURIComponent(image.src.slice(image.src.indexOf(',') + 1));
        const picture = holder.querySelector('svg'), axes = readAxes(picture);
        const groups = axes ? [...picture.querySelectorAll('g[id^=gnuplot_plot]')] : [];
        const curves = groups.map(group => readCurve(group, axes));
        for (const curve of curves.filter(c => c.name))
            key.append(tick(curve.name, true, isOn => {
                curve.hidden = !isOn;
                curve.group.style.display = isOn ? '' : 'none';
            }));
        fill(picture, {role: 'img', tabindex: 0, 'aria-label': image.alt});
        if (curves.length) inspect(picture, curves, readout);
    } else {
        holder.append(image.cloneNode());
    }
    dialog.showModal();
}

function addEnlarge(image) {
    const button = html('button', {type: 'button', class: 'plain enlarge',
        'aria-label': `Enlarge: ${image.alt}`, click: () => enlarge(image)});
    image.replaceWith(button);
    button.append(image);
}

addTools();
systems.forEach(addMotions);
systems.forEach(addChooser);
document.querySelectorAll('figure img').forEach(addEnlarge);
