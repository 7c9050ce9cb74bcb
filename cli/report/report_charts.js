// report_charts.js - charts by uPlot, which is on the page before this script where it is installed: zoom, values
// under the pointer and by keys, axes that are linked, and one legend for the charts of a group.

const COLOURS = ['#d9600f', '#2f80d0', '#3d9a3d', '#d1479f', '#12908e', '#9a5fd0', '#94851a', '#d33b4b'];
const DASHES = [[], [7, 4], [2, 3]];
const FONT = '12px system-ui, sans-serif';
const HAS_CHARTS = typeof uPlot === 'function';

const ink = name => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
const short = x => x !== 0 && (Math.abs(x) < 0.01 || Math.abs(x) >= 1e6)
    ? x.toExponential(2).replace(/\.?0*e\+?/, 'e') : String(Number(x.toPrecision(5)));
// Ticks of an axis, at most this many: 1, 2 or 5 times a power of ten apart, as small as roundings are.
function linearTicks(low, high, most) {
    const least = (high - low) / most, power = Math.floor(Math.log10(least));
    const by = Number(`${[1, 2, 5, 10].find(m => m * 10 ** power >= least * (1 - 1e-9)) || 10}e${power}`);
    const first = Math.ceil(low / by - 1e-9), count = Math.max(0, Math.floor(high / by + 1e-9) - first + 1);
    return Array.from({length: Math.min(count, 99)}, (_, i) => Number(((first + i) * by).toPrecision(12)));
}
// The same of logarithms: some decades apart, or within few decades others, too.
function logTicks(low, high, most) {
    const first = Math.floor(Math.log10(low)), last = Math.ceil(Math.log10(high));
    const decades = Array.from({length: last - first + 1}, (_, i) => first + i);
    const by = Math.ceil((last - first) / most), inside = v => v >= low * 0.999 && v <= high * 1.001;
    const multiples = [[1], [1, 3], [1, 2, 5], [1, 2, 3, 4, 5, 6, 7, 8, 9]].map(times =>
        decades.filter(e => by === 1 || e % by === 0).flatMap(e => times.map(m => Number(`${m}e${e}`))).filter(inside));
    return multiples.filter((ticks, i) => i === 0 || ticks.length <= most).at(by > 1 ? 0 : -1);
}

// Digits that separate values which are that far from each other, at least 5.
const digitsFor = (high, apart) => Math.min(Math.max(5, Math.ceil(Math.log10(Math.abs(high) / apart)) + 1), 15) || 5;
const withDigits = (v, digits) => digits > 5 ? String(Number(v.toPrecision(digits))) : short(v);

const colourOf = number => COLOURS[number % COLOURS.length];
const dashOf = number => DASHES[Math.floor(number / COLOURS.length) % DASHES.length];

// Where a curve of a plane leads, through ends of lines.
function planePath(chart, curve) {
    return u => {
        const path = new Path2D(), dot = uPlot.pxRatio * 1.2, ring = uPlot.pxRatio * 4;
        let isDown = false;
        curve.x.forEach((x, i) => {
            const y = curve.y[i];
            if (x === null || y === null) {
                isDown = false;
                return;
            }
            const px = u.valToPos(x, 'x', true), py = u.valToPos(y, 'y', true);
            if (curve.kind === 'dots') path.rect(px - dot, py - dot, 2 * dot, 2 * dot);
            else if (curve.kind === 'rings') {
                path.moveTo(px + ring, py);
                path.arc(px, py, ring, 0, 2 * Math.PI);
            } else if (isDown) path.lineTo(px, py);
            else path.moveTo(px, py);
            isDown = true;
        });
        const clip = new Path2D();
        clip.rect(u.bbox.left, u.bbox.top, u.bbox.width, u.bbox.height);
        return {stroke: path, fill: curve.kind === 'dots' ? path : null, clip, flags: 1};
    };
}

class Chart {
    // The data are as in docs/formats.md; the element is a figure, or another one to which the chart is added.
    constructor(element, data, group) {
        Object.assign(this, {element, data, group, plot: null, at: {curve: 0, point: -1}});
        this.curves = data.curves.map(curve => ({...curve, hidden: false,
            x: typeof curve.x === 'number' ? data.curves[curve.x].x : curve.x}));
        // A run may go backwards in t, and steps are listed from the largest.
        for (const curve of this.curves.filter(c => c.x.every((x, i) => x !== null && (i === 0 || x <= c.x[i - 1]))))
            for (const name of ['x', 'y', 'upper']) curve[name] = curve[name] && [...curve[name]].reverse();
        // Over an axis all curves have a value; in a plane a point is the nearest.
        this.isPlane = this.curves.some(c => c.kind === 'rings' || c.x.some((x, i) => x === null || x < c.x[i - 1]));
        this.link = this.isPlane ? null : `${data.x}, ${data.logX ? 'log' : 'linear'}, ${data.part || 'all'}`;
        this.home = {x: this.findRange('x'), y: this.findRange('y')};
        this.readout = html('output', {class: 'readout'}, this.notes());
        this.over = html('div', {class: 'chart', tabindex: 0, role: 'img', 'aria-label': this.words(),
            keydown: event => this.press(event)});
        const button = (words, name, act) =>
            html('button', {type: 'button', 'aria-label': `${name}: ${data.title}`, title: name, click: act}, words);
        element.append(this.over, this.readout, html('div', {class: 'chart-tools'},
            button('+', 'Zoom in', () => this.magnify(0.5)), button('−', 'Zoom out', () => this.magnify(2)),
            button('All', 'Show all', () => this.zoom(this.home)),
            button('Large', 'Large or small', () => this.enlarge()),
            button('CSV', 'Data as CSV', () => this.save())));
    }

    words() {
        const {title, x, y, curves} = this.data, names = [...new Set(curves.map(c => c.title).filter(Boolean))];
        return `${title}: ${y || 'rows'} over ${x}${names.length ? ' for ' + names.join(', ') : ''}. ` +
            'Arrow keys read values, plus and minus zoom, 0 shows all.';
    }
    notes() {
        const notes = this.curves.filter(c => c.note && !c.hidden).map(c => c.title + c.note);
        return notes.join(', ');
    }
    shown() {
        return this.curves.filter(curve => !curve.hidden);
    }

    // ---- ranges

    // A value as it is read: a thousandth of the axis is seen.
    text(axis, v) {
        const [low, high] = this.home[axis];
        return withDigits(v, this.isLog(axis) ? 5 : digitsFor(Math.max(Math.abs(low), Math.abs(high)), (high - low) / 1000));
    }
    isLog(axis) {
        return Boolean(axis === 'x' ? this.data.logX : this.data.logY);
    }
    findRange(axis) {
        const {rows, fromZero} = this.data;
        if (axis === 'y' && rows) return [0.5, rows.length + 0.5];
        const all = this.curves.flatMap(c => axis === 'x' ? c.x : c.upper ? [...c.y, ...c.upper] : c.y)
            .filter(v => v !== null);
        let low = all.reduce((a, b) => Math.min(a, b), Infinity), high = all.reduce((a, b) => Math.max(a, b), -Infinity);
        if (this.isLog(axis)) {
            if (axis === 'y') return [10 ** Math.floor(Math.log10(low) + 1e-9), 10 ** Math.ceil(Math.log10(high * 1.01))];
            return high > low ? [low / (high / low) ** 0.02, high * (high / low) ** 0.02] : [low / 2, high * 2];
        }
        if (axis === 'y' && fromZero) low = 0;
        if (!(high - low > 1e-12 * Math.max(Math.abs(low), Math.abs(high))))
            return low === 0 ? [-1, 1] : [low - 0.1 * Math.abs(low), high + 0.1 * Math.abs(high)];
        const edge = axis === 'x' && !this.isPlane ? 0 : 0.05 * (high - low);
        return [axis === 'y' && fromZero ? 0 : low - edge, high + edge];
    }
    // The same scale on both axes: the range that is too small for its axis grows.
    fit({x, y}) {
        if (!this.data.toScale || !this.plot) return {x, y};
        const unit = Math.min(this.plot.over.clientWidth / (x[1] - x[0]), this.plot.over.clientHeight / (y[1] - y[0]));
        const grown = ([low, high], pixels) => {
            const edge = (pixels / unit - (high - low)) / 2;
            return [low - edge, high + edge];
        };
        return {x: grown(x, this.plot.over.clientWidth), y: grown(y, this.plot.over.clientHeight)};
    }
    zoom(view, isFollowing) {
        this.view = this.fit(view);
        this.marks.replaceChildren();
        this.plot.batch(() => {
            this.plot.setScale('x', {min: this.view.x[0], max: this.view.x[1]});
            this.plot.setScale('y', {min: this.view.y[0], max: this.view.y[1]});
        });
        if (isFollowing || !this.link) return;
        for (const chart of this.group.linked(this)) chart.zoom({x: view.x, y: chart.view.y}, true);
    }
    magnify(factor) {
        const grown = (axis, [low, high]) => {
            if (axis === 'y' && this.data.rows) return [low, high];
            if (this.isLog(axis)) return grownBy(Math.log10(low), Math.log10(high)).map(v => 10 ** v);
            return grownBy(low, high);
        };
        const grownBy = (low, high) => [(low + high - factor * (high - low)) / 2, (low + high + factor * (high - low)) / 2];
        this.zoom({x: grown('x', this.view.x), y: this.isPlane ? grown('y', this.view.y) : this.view.y});
    }

    // ---- drawing

    height(width) {
        const {x, y} = this.home, large = this.element.classList.contains('large');
        if (this.data.rows) return 90 + 22 * this.data.rows.length;
        if (!this.data.toScale) return large ? 460 : 270;
        return Math.min(Math.max((width - 70) * (y[1] - y[0]) / (x[1] - x[0]) + 60, 180), large ? 700 : 380);
    }
    axis(scale, label) {
        const line = {stroke: ink('--line'), width: 1}, {rows} = this.data, isLog = this.isLog(scale);
        const axis = {scale, label, stroke: ink('--ink'), font: FONT, labelFont: FONT, labelSize: 20, grid: line,
            ticks: {...line, size: 4}, values: (u, splits) => {
                const digits = digitsFor(Math.max(...splits.map(Math.abs)), splits[1] - splits[0]);
                return splits.map(v => v === null ? '' : isLog ? decade(v) : withDigits(v, digits));
            }};
        const decade = v => Math.abs(Math.log10(v)) < 4 ? short(v) : v.toExponential(0).replace('e+', 'e');
        if (scale === 'y' && rows) {
            const width = 7.2 * rows.reduce((most, name) => Math.max(most, name.length), 0) + 16;
            return {...axis, size: Math.min(width, 170), splits: () => rows.map((_, i) => i + 1), values: () => rows, label: undefined};
        }
        const most = u => Math.max(2, Math.floor(scale === 'x' ? (u.width - 70) / 64 : (u.height - 50) / 30));
        return {...axis, size: scale === 'y' ? 62 : 34, filter: (u, splits) => splits,
            splits: (u, i, low, high) => (isLog ? logTicks : linearTicks)(low, high, most(u))};
    }
    // The tables of uPlot: in a plane one for each curve, otherwise all curves over all abscissas.
    table() {
        const curves = this.curves;
        if (this.isPlane || !curves.length) return [null, ...curves.map(c => [c.x, c.y])];
        return uPlot.join(curves.map(c => c.upper ? [c.x, c.y, c.upper] : [c.x, c.y]));
    }
    series(curve) {
        const stroke = curve.black ? ink('--ink') : colourOf(curve.colour), dash = curve.black ? [] : dashOf(curve.colour);
        const same = {label: curve.title, stroke, dash, width: curve.black ? 1.2 : 1.8, show: !curve.hidden};
        if (this.isPlane)
            return [{...same, fill: curve.kind === 'dots' ? stroke : undefined, paths: planePath(this, curve),
                points: {show: false}, facets: [{scale: 'x', auto: false}, {scale: 'y', auto: false}]}];
        const isDots = curve.kind === 'dots', stepped = uPlot.paths.stepped({align: 1});
        const one = {...same, spanGaps: true, paths: isDots ? () => null : this.data.fromZero ? stepped : uPlot.paths.linear(),
            points: {show: isDots || Boolean(this.data.marks), size: isDots ? 3 : 6, fill: isDots ? stroke : ink('--paper')}};
        return curve.upper ? [{...one, width: 1}, {...one, width: 1}] : [one];
    }
    draw() {
        if (this.plot) this.plot.destroy();
        const width = Math.max(240, Math.floor(this.over.clientWidth)), {x, y} = this.data;
        const series = [], bands = [];
        for (const curve of this.curves) {
            curve.first = series.length + 1;
            series.push(...this.series(curve));
            if (curve.upper)
                bands.push({series: [curve.first + 1, curve.first], fill: colourOf(curve.colour) + '59'});
        }
        const scale = axis => ({time: false, auto: false, distr: this.isLog(axis) ? 3 : 1,
            dir: axis === 'y' && this.data.rows ? -1 : 1, range: () => this.view[axis]});
        this.view = this.view || this.home;
        this.plot = new uPlot({width, height: Math.round(this.height(width)), mode: this.isPlane ? 2 : 1, bands,
            legend: {show: false}, padding: [10, 24, 0, 0], series: [this.isPlane ? null : {}, ...series],
            scales: {x: scale('x'), y: scale('y')}, axes: [this.axis('x', x), this.axis('y', y)],
            cursor: {drag: {x: true, y: true, uni: 20, setScale: false}, points: {show: false}, dataIdx: (u, i) => null,
                bind: {dblclick: () => () => this.zoom(this.home)}},
            hooks: {setCursor: [u => this.point(u)], setSelect: [u => this.select(u)], drawAxes: [u => this.drawEvents(u)],
                ready: [u => u === this.plot && this.zoom(this.view, true)]},
        }, this.table(), this.over);
        this.marks = html('div', {class: 'marks'});
        this.plot.over.append(this.marks);
    }
    // Vertical lines at the events; where they are many they are short.
    drawEvents(u) {
        const events = this.data.events || [], {left, top, width, height} = u.bbox;
        u.ctx.save();
        u.ctx.strokeStyle = ink('--faint');
        u.ctx.lineWidth = uPlot.pxRatio * 0.7;
        u.ctx.beginPath();
        for (const t of events) {
            const x = u.valToPos(t, 'x', true);
            if (!(x >= left && x <= left + width)) continue;
            u.ctx.moveTo(x, top);
            u.ctx.lineTo(x, top + (events.length > 30 ? 0.05 : 1) * height);
        }
        u.ctx.stroke();
        u.ctx.restore();
    }
    select(u) {
        const {left, top, width, height} = u.select;
        if (width < 3 && height < 3) return;
        const view = {x: this.view.x, y: this.view.y};
        if (width > 3) view.x = [u.posToVal(left, 'x'), u.posToVal(left + width, 'x')];
        if (height > 3 && height < u.over.clientHeight && !this.data.rows)
            view.y = [u.posToVal(top + height, 'y'), u.posToVal(top, 'y')];
        u.setSelect({left: 0, top: 0, width: 0, height: 0}, false);
        this.zoom(view);
    }
    enlarge() {
        this.element.classList.toggle('large');
        this.draw();
    }
    hide(title, isHidden) {
        let found = false;
        for (const curve of this.curves.filter(c => c.title === title)) {
            curve.hidden = isHidden;
            found = true;
        }
        if (found && this.plot) this.draw();
        this.readout.textContent = this.notes();
    }

    // ---- values

    pixels(curve, i) {
        return [this.plot.valToPos(curve.x[i], 'x'), this.plot.valToPos(curve.y[i], 'y')];
    }
    // The point of a curve that is next to a pixel, or to an abscissa.
    nearest(curve, left, top) {
        let least = Infinity, found = -1;
        curve.x.forEach((x, i) => {
            if (x === null || curve.y[i] === null) return;
            const [px, py] = this.pixels(curve, i), distance = Math.abs(px - left) + (top === null ? 0 : Math.abs(py - top));
            if (distance < least) [least, found] = [distance, i];
        });
        return [found, least];
    }
    point(u) {
        const {left, top} = u.cursor;
        if (left < 0 || this.isReading || !this.shown().length) return;
        if (this.isPlane) {
            const all = this.shown().map(c => [c, ...this.nearest(c, left, top)]).filter(([, i]) => i >= 0);
            const [curve, i] = all.reduce((a, b) => b[2] < a[2] ? b : a);
            this.show(curve, i);
            return;
        }
        const near = this.shown().map(c => [c, ...this.nearest(c, left, null)]).filter(([, i]) => i >= 0);
        const [curve, i] = near.reduce((a, b) => b[2] < a[2] ? b : a);
        this.show(curve, i);
    }
    // Marks a point; over an axis all curves show their values there, in the linked charts, too.
    show(curve, i) {
        this.at = {curve: this.curves.indexOf(curve), point: i};
        if (this.isPlane) {
            this.mark([[curve, i]]);
            this.readout.textContent = `${curve.title ? curve.title + ': ' : ''}${this.data.x} = ${this.text('x', curve.x[i])}, ` +
                `${this.data.y} = ${this.data.rows ? this.data.rows[curve.y[i] - 1] : this.text('y', curve.y[i])}`;
            return;
        }
        this.read(curve.x[i]);
        for (const chart of this.group.linked(this)) chart.read(curve.x[i]);
    }
    read(x) {
        const left = this.plot.valToPos(x, 'x');
        const near = this.shown().map(c => [c, this.nearest(c, left, null)[0]]).filter(([, i]) => i >= 0);
        const value = (c, i) => c.upper ? `${this.text('y', c.y[i])} to ${this.text('y', c.upper[i])}` : this.text('y', c.y[i]);
        this.mark(near);
        this.readout.textContent = `${this.data.x} = ${this.text('x', x)}: ` +
            near.map(([c, i]) => `${c.title ? c.title + ' ' : ''}${value(c, i)}`).join(', ');
        this.isReading = true;
        this.plot.setCursor({left, top: this.plot.cursor.top >= 0 ? this.plot.cursor.top : 0}, false);
        this.isReading = false;
    }
    mark(points) {
        this.marks.replaceChildren(...points.map(([curve, i]) => {
            const [left, top] = this.pixels(curve, i);
            return html('span', {class: 'mark', style: `left: ${left.toFixed(1)}px; top: ${top.toFixed(1)}px; ` +
                `border-color: ${curve.black ? ink('--ink') : colourOf(curve.colour)}`});
        }));
    }
    press(event) {
        const along = {ArrowLeft: -1, ArrowRight: 1}[event.key] || 0, across = {ArrowUp: -1, ArrowDown: 1}[event.key] || 0;
        const factor = {'+': 0.5, '-': 2}[event.key], shown = this.shown();
        if (!this.plot || event.ctrlKey || event.metaKey || !(along || across || factor || event.key === '0')) return;
        event.preventDefault();
        if (factor) this.magnify(factor);
        else if (event.key === '0') this.zoom(this.home);
        else if (shown.length) {
            const now = Math.max(0, shown.indexOf(this.curves[this.at.curve]));
            const curve = shown[(now + across + shown.length) % shown.length];
            let next = Math.min(Math.max(this.at.point + along, 0), curve.x.length - 1);
            if (curve.x[next] === null) next = Math.min(Math.max(next + (along || 1), 0), curve.x.length - 1);
            if (curve.x[next] !== null) this.show(curve, next);
        }
    }

    // The points as a file: curve, x, y and of a band its upper value.
    save() {
        const quoted = text => `"${String(text).replaceAll('"', '""')}"`, {x, y, name} = this.data;
        const lines = [['curve', x, y, 'upper'].map(quoted).join(',')];
        for (const curve of this.curves)
            curve.x.forEach((value, i) => value === null ||
                lines.push([quoted(curve.title), value, curve.y[i], curve.upper ? curve.upper[i] : ''].join(',')));
        const place = URL.createObjectURL(new Blob([lines.join('\n') + '\n'], {type: 'text/csv'}));
        html('a', {href: place, download: `${name || 'chart'}.csv`}).click();
        setTimeout(() => URL.revokeObjectURL(place), 1000);
    }
}

// ---- charts with one legend ----------------------------------------------------------------------

class ChartGroup {
    constructor() {
        Object.assign(this, {charts: [], colours: new Map()});
    }
    // A title has one colour in all charts of a group.
    add(element, data) {
        for (const curve of data.curves) {
            if (!curve.title || curve.black) continue;
            const taken = new Set(this.colours.values());
            let colour = curve.colour;
            while (taken.has(colour)) colour++;
            if (!this.colours.has(curve.title)) this.colours.set(curve.title, colour);
            curve.colour = this.colours.get(curve.title);
        }
        const chart = new Chart(element, data, this);
        this.charts.push(chart);
        return chart;
    }
    linked(chart) {
        return this.charts.filter(c => c !== chart && c.plot && chart.link && c.link === chart.link);
    }
    legend() {
        const boxes = [...this.colours].map(([title, colour]) =>
            tick(title, true, isOn => this.charts.forEach(chart => chart.hide(title, !isOn)), colourOf(colour), dashOf(colour).length > 0));
        return html('div', {class: 'legend', role: 'group', 'aria-label': 'Curves'}, ...boxes,
            html('span', {class: 'faint control'}, 'Point at a chart for values, drag to zoom.'));
    }
}

const groups = [];
const everyChart = act => groups.forEach(group => group.charts.forEach(act));

// A chart that is not on the page from the beginning; it takes the place of what is in its holder.
function addChart(holder, data) {
    const group = new ChartGroup(), figure = html('figure');
    holder.replaceChildren(figure);
    const chart = group.add(figure, data);
    holder.append(group.legend());
    groups.push(group);
    chart.draw();
}

// Envelopes, which are points [t, x], over logarithms of both axes.
function plot(holder, curves, ylabel, title) {
    const zero = curves.filter(curve => curve.points.every(p => p[1] === 0)).map(curve => curve.name);
    const data = {name: 'envelopes', title, x: 't', y: ylabel, logX: true, logY: true, curves: curves.map((curve, colour) => {
        const points = curve.points.filter(([x, y]) => x > 0 && y > 0 && isFinite(y));
        return {title: curve.name, kind: 'line', colour, x: points.map(p => p[0]), y: points.map(p => p[1])};
    }).filter(curve => curve.x.length)};
    holder.replaceChildren();
    if (data.curves.length) addChart(holder, data);
    if (zero.length) holder.prepend(html('p', {}, `0 at all rows: ${zero.join(', ')}.`));
}

// The figures of the page; each is drawn when it comes into view, or when the page is printed.
function addFigures() {
    for (const holder of document.querySelectorAll('.figures')) {
        const group = new ChartGroup();
        for (const place of holder.querySelectorAll('script.figure')) {
            const figure = place.parentElement;
            const chart = group.add(figure, JSON.parse(place.textContent));
            whenNear(figure, () => chart.plot || chart.draw());
        }
        if (group.charts.length) holder.prepend(group.legend());
        groups.push(group);
    }
    const redraw = () => everyChart(chart => chart.plot && chart.element.isConnected && chart.draw());
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', redraw);
    addEventListener('resize', redraw);
}

