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

    // A figure is unpacked and laid out as it is on the page, so that its letters have boxes.
    const look = (image, name) => {
        const box = image.getBoundingClientRect(), holder = document.createElement('div');
        holder.style = `position: absolute; left: 0; top: 0; width: ${box.width}px`;
        holder.innerHTML = decodeURIComponent(image.src.slice(image.src.indexOf(',') + 1));
        document.body.append(holder);
        const frame = holder.querySelector('svg').getBoundingClientRect();
        const texts = [...holder.querySelectorAll('text')].filter(t => t.textContent.trim());
        const scale = frame.width / holder.querySelector('svg').viewBox.baseVal.width;
        const boxes = texts.map(t => t.getBoundingClientRect());
        texts.forEach((t, i) => {
            const b = boxes[i], what = `${name}: "${t.textContent.trim()}"`;
            count.letters++;
            if (b.left < frame.left - 0.5 || b.right > frame.right + 0.5 || b.top < frame.top - 0.5 ||
                b.bottom > frame.bottom + 0.5) fault(`${what} is cut off`);
            if (contrast(getComputedStyle(t).fill, paper) < 4.5) fault(`${what} is faint`);
            const size = scale * parseFloat(getComputedStyle(t).fontSize);
            if (!(size >= 11)) fault(`${what} has letters of ${size.toFixed(1)}px`);
            for (let j = 0; j < i; j++) {
                const o = boxes[j];
                if (Math.min(b.right, o.right) - Math.max(b.left, o.left) > 1 &&
                    Math.min(b.bottom, o.bottom) - Math.max(b.top, o.top) > 2.5)
                    fault(`${what} covers "${texts[j].textContent.trim()}"`);
            }
        });
        // The key is beside the curves: no name of a curve lies between the axes.
        const [x0, x1, , , , y0, y1] = holder.querySelector('metadata').textContent.split(' ').filter(Boolean)
            .map(x => scale * x);
        for (const t of holder.querySelectorAll('g[id^=gnuplot_plot] text')) {
            const b = t.getBoundingClientRect();
            if (Math.min(b.right, x1) - Math.max(b.left, x0) > 1 && Math.min(b.bottom, y0) - Math.max(b.top, y1) > 1)
                fault(`${name}: "${t.textContent}" in the key covers a curve`);
        }
        for (const line of holder.querySelectorAll('g[id^=gnuplot_plot] path[stroke]')) {
            const colour = getComputedStyle(line).stroke;
            if (contrast(colour, paper) < 3) fault(`${name}: a line of ${colour} is faint`);
        }
        holder.remove();
    };
    // Those far below are drawn when they come into view.
    for (const image of document.images) image.loading = 'eager';
    await Promise.all([...document.images].map(image => image.decode().catch(() => fault('an image is broken'))));
    for (const image of document.images) {
        const name = image.alt.slice(0, 60);
        count.figures++;
        if (!image.alt) fault('a figure without words');
        if (!image.complete || !image.naturalWidth) fault(`${name}: is not drawn`);
        else look(image, name);
    }
    say(`examined: ${scheme}, ${page}, ${width} pixels: ` +
        `${count.texts} texts, ${count.figures} figures with ${count.letters} labels`);
});
