// report_motion.js - motions of bodies that play.

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

