// page.js - runs inside a page of the report and reports to its parent what is wrong with it.
addEventListener('load', async () => {
    const [page, width] = location.hash.slice(1).split(',');
    const scheme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
    const say = text => parent.postMessage(text, '*');
    const fault = text => say(`fault: ${scheme}, ${page}, ${width}: ${text}`);
    const count = {texts: 0, figures: 0, letters: 0};

    // WCAG 2: contrast of two colours, of a text at least 4.5, of a line at least 3.
    const luminance = rgb => {
        const [r, g, b] = rgb.map(c => (c /= 255) <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const parts = colour => (colour.match(/[\d.]+/g) || []).map(Number);
    const contrast = (a, b) => {
        const [x, y] = [luminance(parts(a).slice(0, 3)), luminance(parts(b).slice(0, 3))];
        return (Math.max(x, y) + 0.05) / (Math.min(x, y) + 0.05);
    };
    const ground = element => {
        for (let e = element; e; e = e.parentElement) {
            const colour = getComputedStyle(e).backgroundColor, alpha = parts(colour)[3];
            if (alpha === undefined || alpha > 0.99) return colour;
        }
        return 'rgb(255, 255, 255)';
    };
    const paper = ground(document.body);

    // What scrolls by itself may be wider than the page; nothing else may.
    document.querySelectorAll('details').forEach(d => d.open = true);
    if (document.documentElement.scrollWidth > innerWidth)
        fault(`the page is ${document.documentElement.scrollWidth} wide`);
    for (const e of document.querySelectorAll('h1, h2, h3, p, li, dt, dd, small, figcaption, summary, th, td, pre')) {
        const box = e.getBoundingClientRect(), style = getComputedStyle(e);
        const name = `<${e.tagName.toLowerCase()}> "${e.textContent.trim().slice(0, 40)}"`;
        count.texts++;
        if (!e.closest('.wide, .contents') && (box.left < 0 || box.right > innerWidth + 0.5)) fault(`${name} is cut off`);
        if (e.tagName !== 'PRE' && !e.closest('.wide') && e.scrollWidth > e.clientWidth + 1 &&
            style.display !== 'inline') fault(`${name} flows over`);
        if (e.textContent.trim() && contrast(style.color, ground(e)) < 4.5)
            fault(`${name} is faint: ${style.color} on ${ground(e)}`);
        if (parseFloat(style.fontSize) < 11) fault(`${name} has letters of ${style.fontSize}`);
    }

    // A chart is drawn, has a name, and nothing of it is cut off at its edges; what is in its legend can be seen.
    const look = figure => {
        const name = figure.querySelector('figcaption strong').textContent.slice(0, 60), canvas = figure.querySelector('canvas');
        const words = figure.querySelector('.chart').getAttribute('aria-label') || '';
        count.figures++;
        if (!words.startsWith(name.slice(0, 40))) fault(`${name}: a chart without words`);
        if (!canvas) return fault(`${name}: is not drawn`);
        const {width, height} = canvas, box = canvas.getBoundingClientRect();
        if (box.left < 0 || box.right > innerWidth + 0.5) fault(`${name}: is cut off`);
        const {data} = canvas.getContext('2d').getImageData(0, 0, width, height);
        let inked = 0, cut = 0;
        for (let y = 0; y < height; y++)
            for (let x = 0; x < width; x++) {
                if (data[4 * (y * width + x) + 3] < 40) continue;
                inked++;
                cut += x === 0 || x === width - 1 || y === 0 || y === height - 1;
            }
        if (inked < 500) fault(`${name}: has ${inked} points of ink`);
        if (cut) fault(`${name}: ${cut} points of ink at the edge`);
    };
    dispatchEvent(new Event('beforeprint')); // those far below are drawn when they come into view
    await new Promise(done => setTimeout(done, 50));
    document.querySelectorAll('.figures figure').forEach(look);
    for (const sample of document.querySelectorAll('.legend .sample')) {
        const colour = getComputedStyle(sample).borderTopColor;
        count.letters++;
        if (contrast(colour, paper) < 3) fault(`a curve of ${colour} is faint`);
    }
    say(`examined: ${scheme}, ${page}, ${width} pixels: ` +
        `${count.texts} texts, ${count.figures} charts, ${count.letters} names of curves`);
});
