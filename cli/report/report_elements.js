// report_elements.js - elements of the page and the data in it, for the scripts of the page after it.

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

// A box with its label and, of a curve, its colour.
function tick(label, isTicked, change, colour, isDashed) {
    const box = html('input', {type: 'checkbox', change: () => change(box.checked)});
    box.checked = isTicked;
    const sample = colour ? [html('span', {class: 'sample', style: `border-top: 3px ${isDashed ? 'dashed' : 'solid'} ${colour}`})] : [];
    return html('label', {class: 'control'}, box, ...sample, ' ' + label);
}

// Acts when an element comes near the window, or when the page is printed.
const waiting = new Map();
const watch = new IntersectionObserver(entries => entries.filter(e => e.isIntersecting).forEach(e => arrive(e.target)),
    {rootMargin: '300px'});
function arrive(element) {
    const act = waiting.get(element);
    watch.unobserve(element);
    waiting.delete(element);
    if (act) act();
}
function whenNear(element, act) {
    waiting.set(element, act);
    watch.observe(element);
}
addEventListener('beforeprint', () => [...waiting.keys()].forEach(arrive));

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
            this.found.set(`${part.integrator} ${part.step}`, {...part, ...this.find(part.integrator, part.step)});
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

