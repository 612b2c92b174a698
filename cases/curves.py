#!/usr/bin/env python3
"""Draws one column of tables against another as SVG.

    curves.py OUTPUT.svg X Y [--log] [--log-x] [--low] [--window X0 X1 Y0 Y1] [--labels TEXT TEXT] [--line SLOPE]
              TABLE,LABEL[,END]...

With END the curve is drawn against END - X, the time that is left. Rows of other drops than the first are left out.
--line draws the straight line of that slope through the origin, dashed. A table whose label begins with "reference" is
dotted. Lines of a table that begin with # are passed over. With --low the labels stand in the lower corner.
"""
import argparse
import csv
import math

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 640, 400, 70, 20, 20, 50
COLOURS = ["#1f5fa8", "#c2571a", "#2f7d4f", "#7a4fa3", "#1b2027"]


def curve(table, x, y, end):
    with open(table, encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    rows = [r for r in rows if r[y] and r.get("drop", "0") == "0"]
    return [((end - float(r[x])) if end is not None else float(r[x]), float(r[y])) for r in rows]


def ticks(low, high, is_log):
    if is_log:
        marks = [m * 10.0 ** e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
                 for m in (1, 2, 5)]
        return [m for m in marks if low * 0.999 <= m <= high * 1.001]
    step = 10.0 ** math.floor(math.log10(high - low))
    while (high - low) / step < 4:
        step /= 2
    return [k * step for k in range(math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9) + 1)]


class Axes:
    def __init__(self, window, is_log, is_log_in_x=False):
        self.x0, self.x1, self.y0, self.y1 = window
        self.is_log = is_log
        self.is_log_in_x = is_log_in_x

    @staticmethod
    def part(value, low, high, is_log):
        scale = math.log if is_log else float
        return (scale(value) - scale(low)) / (scale(high) - scale(low))

    def x(self, value):
        return LEFT + (WIDTH - LEFT - RIGHT) * self.part(value, self.x0, self.x1, self.is_log_in_x)

    def y(self, value):
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * self.part(value, self.y0, self.y1, self.is_log)

    def frame(self, labels):
        out = [f'<rect x="{LEFT}" y="{TOP}" width="{WIDTH - LEFT - RIGHT}" height="{HEIGHT - TOP - BOTTOM}" fill="none" '
               'stroke="#9aa3ad"/>']
        for value in ticks(self.x0, self.x1, self.is_log_in_x):
            out.append(f'<text x="{self.x(value):.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{value:g}</text>')
            out.append(f'<path d="M{self.x(value):.1f} {TOP}V{HEIGHT - BOTTOM}" stroke="#e4e7eb"/>')
        for value in ticks(self.y0, self.y1, self.is_log):
            out.append(f'<text x="{LEFT - 8}" y="{self.y(value) + 4:.1f}" text-anchor="end">{value:g}</text>')
            out.append(f'<path d="M{LEFT} {self.y(value):.1f}H{WIDTH - RIGHT}" stroke="#e4e7eb"/>')
        out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 10}" text-anchor="middle">{labels[0]}</text>')
        middle = (TOP + HEIGHT - BOTTOM) / 2
        out.append(f'<text x="16" y="{middle}" text-anchor="middle" transform="rotate(-90 16 {middle})">{labels[1]}</text>')
        return out

    def line(self, points, style):
        inside = [p for p in points if self.x0 <= p[0] <= self.x1 and self.y0 <= p[1] <= self.y1]
        path = " ".join(f"{self.x(a):.1f},{self.y(b):.1f}" for a, b in inside)
        return f'<polyline points="{path}" fill="none" {style}/>'


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("output")
    parser.add_argument("x")
    parser.add_argument("y")
    parser.add_argument("tables", nargs="+")
    parser.add_argument("--log", action="store_true")
    parser.add_argument("--log-x", action="store_true")
    parser.add_argument("--low", action="store_true")
    parser.add_argument("--window", type=float, nargs=4)
    parser.add_argument("--labels", nargs=2)
    parser.add_argument("--line", type=float)
    options = parser.parse_args()
    parts = [table.split(",") for table in options.tables]
    curves = [(label, curve(file, options.x, options.y, float(end[0]) if end else None))
              for file, label, *end in parts]
    window = options.window or [f(p[k] for _, c in curves for p in c) for k in (0, 1) for f in (min, max)]
    axes = Axes(window, options.log, options.log_x)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" width="{WIDTH}" height="{HEIGHT}">',
           '<style>text{font:12px system-ui,sans-serif;fill:#4a525c}</style>',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>']
    out += axes.frame(options.labels or [options.x, options.y])
    if options.line:
        points = [(window[0] + k / 200 * (window[1] - window[0]),) for k in range(201)]
        out.append(axes.line([(a, options.line * a) for a, in points if a > 0.0],
                             'stroke="#6b7480" stroke-dasharray="7 4"'))
    first = HEIGHT - BOTTOM - 16 * len(curves) if options.low else TOP + 20
    for k, (label, points) in enumerate(curves):
        dash = ' stroke-dasharray="2 3"' if label.startswith("reference") else ""
        colour = COLOURS[k % len(COLOURS)]
        out.append(axes.line(points, f'stroke="{colour}" stroke-width="2"{dash}'))
        out.append(f'<text x="{WIDTH - RIGHT - 12}" y="{first + 16 * k}" text-anchor="end" style="fill:{colour}">{label}</text>')
    with open(options.output, "w", encoding="utf-8") as file:
        file.write("\n".join(out + ["</svg>", ""]))


if __name__ == "__main__":
    main()
