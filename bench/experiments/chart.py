"""Line charts as SVG: plain, readable on a light and on a dark page."""
import math
from xml.sax.saxutils import escape

COLOURS = ["#1f5fd0", "#b84a0e", "#2f7d4f", "#8a3fb0", "#b08900", "#5b6670", "#c02060", "#0a8a9a", "#444444"]
WIDE, TALL = 760, 380
LEFT, RIGHT, TOP, BOTTOM = 58, 172, 52, 44


def ticks(low, high, count=5):
    span = (high - low) or 1
    step = 10 ** math.floor(math.log10(span / count))
    step *= next(m for m in (1, 2, 5, 10) if span / (step * m) <= count)
    first = math.ceil(low / step - 1e-9)
    return [i * step for i in range(first, math.floor(high / step + 1e-9) + 1)]


def log_ticks(low, high):
    decades = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    return [t for d in decades for t in (10 ** d, 3 * 10 ** d) if low * 0.999 <= t <= high * 1.001]


class Frame:
    def __init__(self, lines, log_x, y_range):
        xs = [x for line in lines for x, *_ in line["points"]]
        ys = [y for line in lines for _, y, *_ in line["points"]]
        self.log_x = log_x
        self.x0, self.x1 = min(xs), max(xs)
        low, high = y_range if y_range else (min(ys), max(ys))
        pad = 0.03 * ((high - low) or 1)
        self.y0, self.y1 = low - pad, high + pad

    def x(self, value):
        if self.log_x:
            share = math.log(value / self.x0) / (math.log(self.x1 / self.x0) or 1)
        else:
            share = (value - self.x0) / ((self.x1 - self.x0) or 1)
        return LEFT + share * (WIDE - LEFT - RIGHT)

    def y(self, value):
        share = (min(max(value, self.y0), self.y1) - self.y0) / (self.y1 - self.y0)
        return TALL - BOTTOM - share * (TALL - TOP - BOTTOM)


def axes(frame, x_label, y_label, percent):
    out = []
    for t in ticks(frame.y0, frame.y1):
        text = f"{100 * t:.0f} %" if percent else f"{t:g}"
        out.append(f'<line x1="{LEFT}" x2="{WIDE - RIGHT}" y1="{frame.y(t):.1f}" y2="{frame.y(t):.1f}" stroke="#ddd"/>')
        out.append(f'<text x="{LEFT - 6}" y="{frame.y(t) + 4:.1f}" text-anchor="end">{text}</text>')
    for t in log_ticks(frame.x0, frame.x1) if frame.log_x else ticks(frame.x0, frame.x1, 7):
        out.append(f'<line x1="{frame.x(t):.1f}" x2="{frame.x(t):.1f}" y1="{TOP}" y2="{TALL - BOTTOM}" stroke="#eee"/>')
        out.append(f'<text x="{frame.x(t):.1f}" y="{TALL - BOTTOM + 16}" text-anchor="middle">{t:g}</text>')
    out.append(f'<text x="{(LEFT + WIDE - RIGHT) / 2}" y="{TALL - 8}" text-anchor="middle">{escape(x_label)}</text>')
    out.append(f'<text x="{LEFT - 46}" y="{TOP - 12}">{escape(y_label)}</text>')
    return out


def spread_labels(frame, lines):
    """Names at the ends of their lines, pushed apart so that none covers another."""
    ends = sorted((frame.y(line["points"][-1][1]), i) for i, line in enumerate(lines))
    placed, last = {}, -1e9
    for y, i in ends:
        last = placed[i] = max(y, last + 14)
    over = last - (TALL - BOTTOM + 4)
    if over > 0:
        placed = {i: y - over for i, y in placed.items()}
    return placed


def chart(title, lines, x_label, y_label, log_x=False, percent=False, y_range=None):
    """`lines`: dicts of name, points: (x, y) or (x, y, deviation), ascending in x."""
    frame = Frame(lines, log_x, y_range)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {TALL}" width="{WIDE}" height="{TALL}" '
           f'font-family="Helvetica, Arial, sans-serif" font-size="12" fill="#444">',
           f"<title>{escape(title)}</title>", f'<rect width="{WIDE}" height="{TALL}" rx="6" fill="#fff"/>',
           f'<text x="{LEFT}" y="16" font-size="14" font-weight="bold" fill="#222">{escape(title)}</text>']
    out += axes(frame, x_label, y_label, percent)
    for i, line in enumerate(lines):
        colour = COLOURS[i % len(COLOURS)]
        points = line["points"]
        if len(points[0]) == 3:
            upper = [f"{frame.x(x):.1f},{frame.y(y + d):.1f}" for x, y, d in points]
            lower = [f"{frame.x(x):.1f},{frame.y(y - d):.1f}" for x, y, d in reversed(points)]
            out.append(f'<polygon points="{" ".join(upper + lower)}" fill="{colour}" opacity="0.12"/>')
        path = " ".join(f"{frame.x(p[0]):.1f},{frame.y(p[1]):.1f}" for p in points)
        out.append(f'<polyline points="{path}" fill="none" stroke="{colour}" stroke-width="2"/>')
    for i, y in spread_labels(frame, lines).items():
        out.append(f'<text x="{WIDE - RIGHT + 6}" y="{y + 4:.1f}" fill="{COLOURS[i % len(COLOURS)]}" '
                   f'font-weight="bold">{escape(lines[i]["name"])}</text>')
    return "\n".join(out + ["</svg>", ""])
