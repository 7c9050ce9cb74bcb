"""pictures.py - pictures of the site: a motion that moves, and errors against steps.

They move by CSS alone, and not where a reader prefers reduced motion; light and dark are theirs.
"""
import html
import math

STYLE = """
text { font: 13px system-ui, sans-serif; fill: #55555e } .path, .axis { fill: none; stroke: #c8c8ce; stroke-width: 2 }
.trail { fill: none; stroke: #2f80d0; stroke-width: 3; stroke-linecap: round } .dot { fill: #1d1d20 }
@media (prefers-color-scheme: dark) { .path, .axis { stroke: #4a4a52 } .dot { fill: #e6e6e8 } text { fill: #b4b4bd } }
"""
STILL = '@media (prefers-reduced-motion: reduce) { * { animation: none !important } }\n'
COLOURS = ['#2f80d0', '#d0602f', '#2fa065', '#9a55c0', '#b08a1a', '#c0407a', '#4a8f9a']


def svg(width, height, style, alt, body):
    """A picture."""
    return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" role="img">'
            f'<title>{html.escape(alt)}</title>\n<style>{STYLE}{style}</style>\n{body}</svg>\n')


def scaled(values, low, high):
    """Values from their range to another one."""
    least, most = min(values), max(values)
    size = (most - least) or 1
    return [low + (value - least) / size * (high - low) for value in values]


def motion(x, y, names, alt, seconds=12):
    """A point that moves along its path; equal times are between the points of x and y."""
    width, height, edge = 360, 260, 24
    spans = max(x) - min(x), max(y) - min(y)
    px, py = scaled(x, edge, width - edge), scaled(y, height - edge - 16, edge)
    if all(name in 'xyXYqz' for name in (n[0] for n in names)) and not any("'" in n for n in names) and min(spans) > 0:
        scale = min((width - 2 * edge) / spans[0], (height - 2 * edge - 16) / spans[1])  # a plane: equal scales
        px = [width / 2 + (value - (max(x) + min(x)) / 2) * scale for value in x]
        py = [(height - 16) / 2 - (value - (max(y) + min(y)) / 2) * scale for value in y]
    points = list(zip(px, py))
    lengths = [0.0]
    for (x0, y0), (x1, y1) in zip(points, points[1:]):
        lengths.append(lengths[-1] + math.hypot(x1 - x0, y1 - y0))
    parts = [length / (lengths[-1] or 1) for length in lengths]
    path = 'M' + 'L'.join(f'{a:.1f} {b:.1f}' for a, b in points)
    last = len(points) - 1
    frames = range(0, last + 1, max(1, last // 120))
    moves = ''.join(f'{100 * i / last:.4g}%{{transform:translate({points[i][0]:.1f}px,{points[i][1]:.1f}px)}}' for i in frames)
    trails = ''.join(f'{100 * i / last:.4g}%{{stroke-dashoffset:{1 - parts[i]:.4f}}}' for i in frames)
    style = (f'@keyframes move{{{moves}}}\n@keyframes trail{{{trails}}}\n'
             f'.dot{{animation:move {seconds}s linear infinite}} .trail{{animation:trail {seconds}s linear infinite}}\n{STILL}')
    end = f'{points[-1][0]:.1f}px,{points[-1][1]:.1f}px'
    return svg(width, height, style, alt,
               f'<path class="path" d="{path}"/><path class="trail" pathLength="1" stroke-dasharray="1 1" d="{path}"/>'
               f'<circle class="dot" r="6" style="transform:translate({end})"/>'
               f'<text x="{edge}" y="{height - 6}">{html.escape(names[1])} over {html.escape(names[0])}</text>')


def orders(curves, alt):
    """Errors against steps, log-log; curves are (name, steps, errors)."""
    width, height, left, bottom, top = 560, 330, 70, 50, 16
    steps = [math.log10(h) for _, hs, _ in curves for h in hs]
    errors = [math.log10(e) for _, _, es in curves for e in es]
    low, high = math.floor(min(errors)), math.ceil(max(errors))
    first, last = min(steps), max(steps)
    right = width - 150

    def across(h):
        return left + (math.log10(h) - first) / ((last - first) or 1) * (right - left)

    def up(e):
        return height - bottom - (math.log10(e) - low) / ((high - low) or 1) * (height - bottom - top)
    body = [f'<path class="axis" d="M{left} {top}V{height - bottom}H{right}"/>']
    for power in range(low, high + 1, max(1, (high - low + 7) // 8)):
        body.append(f'<text x="{left - 8}" y="{up(10.0 ** power) + 4:.0f}" text-anchor="end">1e{power}</text>')
    for h in sorted({h for _, hs, _ in curves for h in hs}):
        body.append(f'<text x="{across(h):.0f}" y="{height - bottom + 18}" text-anchor="middle">{h:.4g}</text>')
    body.append(f'<text x="{(left + right) / 2:.0f}" y="{height - 10}" text-anchor="middle">step h</text>')
    body.append(f'<text x="14" y="{height / 2:.0f}" transform="rotate(-90 14 {height / 2:.0f})" text-anchor="middle">error</text>')
    for i, (name, hs, es) in enumerate(curves):
        colour = COLOURS[i % len(COLOURS)]
        path = 'M' + 'L'.join(f'{across(h):.1f} {up(e):.1f}' for h, e in zip(hs, es))
        body.append(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
        body += [f'<circle cx="{across(h):.1f}" cy="{up(e):.1f}" r="3.5" fill="{colour}"/>' for h, e in zip(hs, es)]
        body.append(f'<path d="M{right + 12} {top + 12 + 20 * i}h18" stroke="{colour}" stroke-width="3"/>')
        body.append(f'<text x="{right + 36}" y="{top + 16 + 20 * i}">{html.escape(name)}</text>')
    return svg(width, height, '', alt, '\n'.join(body))
