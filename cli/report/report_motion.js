// report_motion.js - motions of bodies that play.

// ---- motions -------------------------------------------------------------------------------------

const BODY_SIZE = 5.5; // half the length of a body; a path is 100 wide

// The numbers of the poses as functions of time.
class Motion {
    constructor(data) {
        Object.assign(this, {part: ''}, data);
        this.name = this.step ? `${this.integrator}, h = ${this.step}` : 'exact solution';
        for (const name of ['x', 'y', 'angle', 'steer', 'width', 'spin', 'wx', 'wy', 'wz']) {
            const [low, high, text] = data[name];
            this[name] = text ? levels(text).map(level => low + (high - low) * level / 65535)
                : new Array(data.frames).fill(low);
        }
        const rates = ['wx', 'wy', 'wz'].map(name => this[name]);
        if (this.smooth && rates.some(w => w.some(rate => rate !== 0))) this.turns = this.orient(rates);
    }
    // The orientations, quaternions, of the angular velocities: from frame to frame by the turn about their mean.
    orient(rates) {
        const half = (this.end - this.start) / (this.frames - 1) / 2, turns = [[1, 0, 0, 0]];
        for (let i = 1; i < this.frames; i++) {
            const w = rates.map(rate => (rate[i - 1] + rate[i]) / 2 * half), size = Math.hypot(...w);
            const c = Math.cos(size), [x, y, z] = w.map(part => part * (size ? Math.sin(size) / size : 1));
            const [q, a, b, d] = turns[i - 1];
            turns.push([c * q - x * a - y * b - z * d, c * a + x * q + y * d - z * b,
                c * b - x * d + y * q + z * a, c * d + x * b - y * a + z * q]);
        }
        return turns;
    }
    // A point of the body in space, turned as it is at a frame.
    turned([x, y, z], f) {
        const [q, a, b, c] = this.turns[Math.round(f)];
        const u = 2 * (b * z - c * y), v = 2 * (c * x - a * z), w = 2 * (a * y - b * x);
        return [x + q * u + b * w - c * v, y + q * v + c * u - a * w, z + q * w + a * v - b * u];
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

// The plane of motions, 100 units wide, seen from above or in perspective from where the reader turned it.
class View {
    constructor(motions) {
        const ranges = ['x', 'y'].map(name => {
            const all = motions.flatMap(m => m[name]);
            return [all.reduce((a, b) => Math.min(a, b)), all.reduce((a, b) => Math.max(a, b))];
        });
        const size = ranges.map(([low, high]) => high - low);
        this.isPlane = motions.every(m => m.plane);
        this.extent = Math.max(...size) || 1;
        this.scale = this.isPlane ? [100 / this.extent, 100 / this.extent] : [100 / (size[0] || 1), 60 / (size[1] || 1)];
        this.middle = ranges.map(([low, high]) => (low + high) / 2);
        this.half = size.map((width, k) => Math.max(width * this.scale[k] / 2, this.isPlane ? 0 : 20) + 2 * BODY_SIZE);
        Object.assign(this, {is3D: motions.some(m => ['disk', 'ball', 'box'].includes(m.body)), isPath: Math.max(...size) > 0, azimuth: -25, elevation: 35});
        // 1, 2 or 5 times a power of ten, a tenth to a quarter of the path.
        const power = 10 ** Math.floor(Math.log10(this.extent / 4)), times = this.extent / 4 / power;
        this.bar = Number(((times < 2 ? 1 : times < 5 ? 2 : 5) * power).toPrecision(1));
    }
    place(x, y) {
        return [(x - this.middle[0]) * this.scale[0], (y - this.middle[1]) * this.scale[1], 0];
    }
    // A point of the plane, or above it, in the picture.
    project([x, y, z]) {
        if (!this.is3D) return [x, -y];
        const turn = this.azimuth * Math.PI / 180, rise = this.elevation * Math.PI / 180, distance = 3.2 * Math.hypot(...this.half);
        const u = x * Math.cos(turn) - y * Math.sin(turn), v = x * Math.sin(turn) + y * Math.cos(turn);
        const near = distance / (distance + v * Math.cos(rise) - z * Math.sin(rise));
        return [u * near, -(v * Math.sin(rise) + z * Math.cos(rise)) * near];
    }
    box() {
        const [a, b] = this.half, r = Math.hypot(a, b);
        return this.is3D ? [-r, -0.8 * r, 2 * r, 1.6 * r] : [-a, -b, 2 * a, 2 * b];
    }
    // Which side of a body is seen, as its direction in space.
    towards() {
        if (!this.is3D) return [0, 0, 1];
        const turn = this.azimuth * Math.PI / 180, rise = this.elevation * Math.PI / 180;
        return [-Math.cos(rise) * Math.sin(turn), -Math.cos(rise) * Math.cos(turn), Math.sin(rise)];
    }
    turn(azimuth, elevation) {
        this.azimuth = (this.azimuth + azimuth) % 360;
        this.elevation = Math.min(Math.max(this.elevation + elevation, 5), 90);
    }
}

const ROUND = Array.from({length: 33}, (_, i) => [Math.cos(i * Math.PI / 16), Math.sin(i * Math.PI / 16)]);

// Lines on a ball, three circles, and the edges of a box, of half length 1.
const CIRCLES = [([a, b]) => [a, b, 0], ([a, b]) => [0, a, b], ([a, b]) => [b, 0, a]].map(place => ROUND.map(place));
const BOX = [1, 0.6, 0.3], CORNERS = [0, 1, 2, 3, 4, 5, 6, 7].map(i => BOX.map((size, k) => i >> k & 1 ? size : -size));
const EDGES = CORNERS.flatMap((one, i) => [1, 2, 4].filter(bit => !(i & bit)).map(bit => [one, CORNERS[i + bit]]));

// One motion on a stage: its path, its trail and its body.
class Actor {
    constructor(motion, view, colour, isAlone) {
        Object.assign(this, {motion, view, colour});
        this.path = svg('path', {class: motion.smooth ? 'path' : 'path dots'});
        this.trail = svg('path', {class: 'trail', style: `stroke: ${colour}`});
        this.shapes = motion.parts.map(() => svg('path', isAlone ? {} : {style: `stroke: ${colour}`}));
        this.marks = svg('path', isAlone ? {class: 'marks'} : {class: 'marks', style: `stroke: ${colour}`});
        this.body = svg('g', {class: 'body'}, ...this.shapes, this.marks);
        // What is beside the run itself lets it be seen where both are the same.
        if (!motion.step) [this.path, this.trail, this.body].forEach(part => part.classList.add('dashed'));
    }
    place(f) {
        return this.view.place(this.motion.at('x', f), this.motion.at('y', f));
    }
    write(points) {
        return points.map(p => this.view.project(p).map(c => c.toFixed(2)).join(' '));
    }
    // The path from one frame to another; dots where it is not known between them.
    line(from, to) {
        const points = [];
        for (let f = from; f < to; f++) points.push(this.place(f));
        points.push(this.place(to));
        const texts = this.write(points);
        return this.motion.smooth ? 'M' + texts.join('L') : texts.map(p => `M${p}h0`).join('');
    }
    // The points of a part of the body.  A disk is upright or leans: seen from above it is as broad as its
    // width says; its axle is across it.  All else lies in the plane.
    outline({pivot, turn, narrowed, radius, line}, f) {
        const m = this.motion, [x, y, z] = this.place(f), angle = m.at('angle', f), steer = turn * m.at('steer', f);
        const lean = Math.min(Math.max(m.at('width', f), -1), 1), isDisk = m.body === 'disk' && this.view.is3D;
        const height = isDisk ? Math.sqrt(1 - lean * lean) : m.body === 'ball' && this.view.is3D ? radius : 0;
        return (radius ? ROUND.map(([a, b]) => [radius * a, radius * b]) : line).map(([a, b]) => {
            const across = narrowed ? lean * b : isDisk ? b * height : b, up = !isDisk ? 0 : narrowed ? height * b : -lean * b;
            const u = pivot[0] + Math.cos(steer) * a - Math.sin(steer) * across;
            const v = pivot[1] + Math.sin(steer) * a + Math.cos(steer) * across;
            return [x + BODY_SIZE * (Math.cos(angle) * u - Math.sin(angle) * v),
                y + BODY_SIZE * (Math.sin(angle) * u + Math.cos(angle) * v), z + BODY_SIZE * (height + up)];
        });
    }
    // A ball has one outline from everywhere.
    ball(f, radius) {
        const [x, y] = this.place(f), middle = this.view.project([x, y, BODY_SIZE * radius]);
        return ROUND.map(([a, b]) => [middle[0] + BODY_SIZE * radius * a, middle[1] + BODY_SIZE * radius * b]
            .map(c => c.toFixed(2)).join(' '));
    }
    // What shows how the body is turned: the spoke of a disk that rolls, lines on the side of a ball that is seen, and
    // the edges of a box.
    orientation(f) {
        const m = this.motion, [x, y, z] = this.place(f), isBall = m.body === 'ball', towards = this.view.towards();
        if (m.body === 'disk' && m.spin.some(s => s !== m.spin[0])) {
            const s = m.at('spin', f), rim = [[0, 0], [Math.cos(s), -Math.sin(s)]];
            return 'M' + this.write(this.outline({pivot: [0, 0], turn: 0, narrowed: true, radius: 0, line: rim}, f)).join('L');
        }
        if (!m.turns || !(isBall || m.body === 'box')) return '';
        const size = BODY_SIZE * (isBall ? 0.7 : 1), rise = isBall && this.view.is3D ? size : 0;
        return (isBall ? CIRCLES : EDGES).map(line => {
            let isDown = false;
            return line.map(point => m.turned(point, f)).map(p => {
                if (isBall && p[0] * towards[0] + p[1] * towards[1] + p[2] * towards[2] < 0) {
                    isDown = false;
                    return '';
                }
                const text = (isDown ? 'L' : 'M') + this.write([[x + size * p[0], y + size * p[1], z + rise + size * p[2]]])[0];
                isDown = true;
                return text;
            }).join('');
        }).join('');
    }
    drawPath() {
        this.path.setAttribute('d', this.line(0, this.motion.frames - 1));
    }
    show(t, trail) {
        const m = this.motion, f = m.frame(t), from = Math.max(0, Math.ceil(f - trail * m.frames));
        this.marks.setAttribute('d', this.orientation(f));
        m.parts.forEach((part, i) => this.shapes[i].setAttribute('d', m.body === 'box' && m.turns ? '' : 'M' + (m.body === 'ball' && this.view.is3D
            ? this.ball(f, part.radius) : this.write(this.outline(part, f))).join('L')));
        this.trail.setAttribute('d', trail > 0 ? this.line(from, f) : '');
    }
}

// Motions on one another in a picture, which the pointer and keys turn in 3D.
class Stage {
    constructor(motions, view, colours, redraw) {
        this.view = view;
        this.actors = motions.map((motion, i) => new Actor(motion, view, colours[i], motions.length === 1));
        this.scale = svg('path', {class: 'scale'});
        const names = motions.map(m => m.step ? m.integrator : m.name).join(' and '), {body, axes} = motions[0];
        this.picture = svg('svg', {role: 'img', class: 'stage', tabindex: 0,
            'aria-label': `Motion of a ${body} by ${names} over ${axes.join(' and ')}`,
            keydown: event => this.press(event, redraw), pointerdown: event => view.is3D && this.picture.setPointerCapture(event.pointerId),
            pointermove: event => {
                if (!view.is3D || !event.buttons) return;
                view.turn(event.movementX / 2, event.movementY / 2);
                redraw();
            }},
            ...this.actors.map(a => a.path), ...this.actors.map(a => a.trail), ...this.actors.map(a => a.body), this.scale);
        const samples = motions.flatMap((m, i) => [html('span', {class: 'control'},
            html('span', {class: 'sample', style: `border-top: 3px ${m.step ? 'solid' : 'dashed'} ${colours[i]}`}), ` ${m.name}${i < motions.length - 1 ? ',' : '.'}`), ' ']);
        const {part, smooth, start, end} = motions[0], times = `t = ${short(start)} to ${short(end)}`;
        const rows = part ? ` The rows are too far apart to show the motion: these are ${part}, ${times}.`
            : smooth ? '' : ' Dots are rows, too far apart for a path between them.';
        this.figure = html('figure', {}, this.picture, html('figcaption', {}, ...samples,
            !view.isPath ? 'It turns in its place.' : view.isPlane ? `The bar is ${view.bar} long.` : `${axes[1]} over ${axes[0]}, not to scale.`, rows));
    }
    press(event, redraw) {
        const azimuth = {ArrowLeft: -10, ArrowRight: 10}[event.key], elevation = {ArrowUp: 10, ArrowDown: -10}[event.key];
        if (!this.view.is3D || !(azimuth || elevation)) return;
        event.preventDefault();
        this.view.turn(azimuth || 0, elevation || 0);
        redraw();
    }
    draw() {
        const {view} = this, [a, b] = view.half, length = view.bar * view.scale[0], begin = [3 - a, 3 - b, 0];
        fill(this.picture, {viewBox: view.box().map(c => c.toFixed(2)).join(' ')});
        this.actors.forEach(actor => actor.drawPath());
        this.scale.setAttribute('d', view.isPlane && view.isPath ? 'M' + [begin, [begin[0] + length, begin[1], 0]]
            .map(p => view.project(p).join(' ')).join('L') : '');
    }
}

// Plays the motions of a system on one another or side by side, in SECONDS at speed 1.
function addMotions(system) {
    const SECONDS = 20, motions = system.motions.map(data => new Motion(data));
    if (!motions.length) return;
    const view = new View(motions), colours = motions.map((_, i) => COLOURS[1 - i % 2]);
    const holder = html('div', {class: 'stages'}), redraw = () => {
        stages.forEach(stage => stage.draw());
        show(now);
    };
    let stages = [], isApart = false;
    const build = () => {
        stages = isApart ? motions.map((m, i) => new Stage([m], view, [colours[i]], redraw))
            : [new Stage(motions, view, colours, redraw)];
        holder.replaceChildren(...stages.map(stage => stage.figure));
        redraw();
    };
    const start = Math.min(...motions.map(m => m.start)), end = Math.max(...motions.map(m => m.end));
    const slider = html('input', {type: 'range', min: 0, max: 1000, value: 0, 'aria-label': 'Time',
        input: () => show(start + (end - start) * slider.value / 1000)});
    const readout = html('output', {class: 'readout'});
    const button = html('button', {type: 'button', click: () => play(!isPlaying)}, 'Play');
    let now = start, isPlaying = false, speed = 1, trail = 0.15, before = 0;
    const apart = t => {
        const [a, b] = motions.map(m => [m.at('x', m.frame(t)), m.at('y', m.frame(t))]);
        if (!b) return '';
        const distance = Math.hypot(a[0] - b[0], a[1] - b[1]), least = view.extent * 1e-4;
        return distance < least ? `, less than ${short(least)} apart` : `, ${short(distance)} apart`;
    };
    const show = t => {
        now = t;
        slider.value = 1000 * (t - start) / (end - start);
        stages.forEach(stage => stage.actors.forEach(actor => actor.show(t, trail)));
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
    const choices = [];
    if (motions.length > 1)
        choices.push(tick('Side by side', false, isOn => {
            isApart = isOn;
            build();
        }));
    if (view.isPlane)
        choices.push(tick('3D', view.is3D, isOn => {
            view.is3D = isOn;
            redraw();
        }));
    system.place.before(html('section', {class: 'motion', 'aria-label': `Motion ${system.label}`}, holder,
        html('div', {class: 'tools'}, button, slider, speeds, trails, ...choices, readout)));
    build();
}

