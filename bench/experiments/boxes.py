"""Box plots as SVG, in the manner of chart.py."""
from xml.sax.saxutils import escape

from chart import BOTTOM, COLOURS, LEFT, TALL, TOP, WIDE, ticks
from results import at_shares

MARGIN, LINE = 16, 14  # right of the plot; between lines of a name


def lines_of(name, room):
    """A name broken at blanks into lines of about `room` characters."""
    lines = [""]
    for word in name.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > room:
            lines.append("")
        lines[-1] = (lines[-1] + " " + word).strip()
    return lines


def box(values, x, half, colour, y_of):
    """Quartiles as a box with the median across, 5 % and 95 % as whiskers, the mean as a dot."""
    low, lower, middle, upper, high = (y_of(v) for v in at_shares(values, (0.05, 0.25, 0.5, 0.75, 0.95)))
    out = [f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{a:.1f}" y2="{b:.1f}" stroke="{colour}"/>'
           for a, b in ((low, lower), (upper, high))]
    out += [f'<line x1="{x - half / 2:.1f}" x2="{x + half / 2:.1f}" y1="{y:.1f}" y2="{y:.1f}" stroke="{colour}"/>'
            for y in (low, high)]
    out.append(f'<rect x="{x - half:.1f}" y="{upper:.1f}" width="{2 * half:.1f}" height="{lower - upper:.1f}" '
               f'fill="{colour}" fill-opacity="0.18" stroke="{colour}" stroke-width="1.5"/>')
    out.append(f'<line x1="{x - half:.1f}" x2="{x + half:.1f}" y1="{middle:.1f}" y2="{middle:.1f}" stroke="{colour}" '
               f'stroke-width="3"/>')
    out.append(f'<circle cx="{x:.1f}" cy="{y_of(sum(values) / len(values)):.1f}" r="3" fill="{colour}"/>')
    return out


def box_chart(title, groups, y_label, x_label=""):
    """`groups`: dicts of name, values, and optionally colour (an index) and mark (a published number, a diamond)."""
    whiskers = [v for group in groups for v in at_shares(group["values"], (0.05, 0.95))]
    whiskers += [group["mark"] for group in groups if group.get("mark") is not None]
    pad = 0.04 * ((max(whiskers) - min(whiskers)) or 1)
    y0, y1 = min(whiskers) - pad, max(whiskers) + pad
    step = (WIDE - LEFT - MARGIN) / len(groups)
    names = [lines_of(str(group["name"]), step / 6.5) for group in groups]
    foot = BOTTOM + LINE * (max(map(len, names)) - (0 if x_label else 1))
    floor = TALL - foot

    def y_of(value):
        return floor - (value - y0) / (y1 - y0) * (floor - TOP)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDE} {TALL}" width="{WIDE}" height="{TALL}" '
           f'font-family="Helvetica, Arial, sans-serif" font-size="12" fill="#444">',
           f"<title>{escape(title)}</title>", f'<rect width="{WIDE}" height="{TALL}" rx="6" fill="#fff"/>',
           f'<text x="12" y="18" font-size="14" font-weight="bold" fill="#222">{escape(title)}</text>',
           f'<text x="12" y="{TOP - 12}">{escape(y_label)}</text>']
    for t in ticks(y0, y1, 6):
        out.append(f'<line x1="{LEFT}" x2="{WIDE - MARGIN}" y1="{y_of(t):.1f}" y2="{y_of(t):.1f}" stroke="#ddd"/>')
        out.append(f'<text x="{LEFT - 6}" y="{y_of(t) + 4:.1f}" text-anchor="end">{t:g}</text>')
    for i, (group, name) in enumerate(zip(groups, names)):
        x = LEFT + (i + 0.5) * step
        out += box(group["values"], x, min(0.3 * step, 34), COLOURS[group.get("colour", i) % len(COLOURS)], y_of)
        if group.get("mark") is not None:
            y = y_of(group["mark"])
            out.append(f'<path d="M{x:.1f} {y - 6:.1f} l6 6 l-6 6 l-6 -6 Z" fill="#fff" stroke="#222" stroke-width="1.5"/>')
        out += [f'<text x="{x:.1f}" y="{floor + 18 + LINE * k}" text-anchor="middle">{escape(line)}</text>'
                for k, line in enumerate(name)]
    if x_label:
        out.append(f'<text x="{(LEFT + WIDE - MARGIN) / 2}" y="{TALL - 8}" text-anchor="middle">{escape(x_label)}</text>')
    return "\n".join(out + ["</svg>", ""])
