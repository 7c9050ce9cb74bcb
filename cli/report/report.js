// report.js - what can be pressed on the pages of `dalembert report`: tables are sorted and filtered, and their cells
// unfold; methods are compared.  Charts and motions are in the scripts before it; tables and texts are complete without.
// The data are on the page as JSON, see docs/formats.md.

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
        // Thousands of buttons take longer than the rest of the page.
        whenNear(table, () => {
            for (const row of this.rows) row.cells.forEach((cell, i) => this.addUnfold(row, cell, this.heads[i]));
        });
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
        const found = HAS_CHARTS && system && system.find(row.method, step);
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
        place.append(html('section', {class: 'unfolded', 'aria-label': `${cell.integrator}, ${system.label}`},
            html('strong', {}, `${cell.integrator}, ${system.label}, h = ${h}`), ' ',
            html('button', {type: 'button', click: () => {
                this.unfold(row, button, system, cell);
                button.focus();
            }}, 'Close'),
            holder, html('p', {}, cell.page ? 'The ' : 'Its page is made by ', link)));
        button.setAttribute('aria-expanded', 'true');
        const names = Object.keys(QUANTITIES).filter(q => cell[q]);
        plot(holder, names.map(q => system.curve(cell, q, QUANTITIES[q])), 'Maxima up to t', `${cell.integrator}, ${system.label}`);
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
    const methods = [...new Set(cells.map(cell => cell.integrator))];
    const usual = ['rk4', 'gauss4', 'spark4', 'rk4+project'].filter(method => methods.includes(method));
    const chosen = new Set(usual.length ? usual : methods.slice(0, 2));
    const holder = html('div', {class: 'plot-holder'});
    const wanted = {quantity: quantities[0], step: 0};
    const draw = () => {
        const {quantity, step} = wanted;
        const found = [...chosen].map(method => system.find(method, step)).filter(c => c && c[quantity]);
        plot(holder, found.map(cell => system.curve(cell, quantity, cell.integrator)), QUANTITIES[quantity], system.label);
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

addTools();
systems.forEach(addMotions);
if (HAS_CHARTS) {
    addFigures();
    systems.forEach(addChooser);
}
