# SPDX-License-Identifier: Apache-2.0
"""Pictures as inline SVG. Colours are CSS classes, which page.css defines for light and dark screens."""

import math
from html import escape

WIDTH, HEIGHT = 460, 280
LEFT, RIGHT, TOP, BOTTOM = 62, 12, 28, 44


def number(value):
    """A number for an axis or a label: three digits, no zeros behind the point."""
    if value == 0:
        return '0'
    digits = max(0, 2 - math.floor(math.log10(abs(value))))
    text = f'{value:,.{digits}f}'
    return (text.rstrip('0').rstrip('.') if '.' in text else text).replace('-', '−')


def linear_ticks(low, high, wanted=5):
    """Round numbers that cover the range."""
    span = (high - low) or abs(high) or 1.0
    raw = span / wanted
    power = 10 ** math.floor(math.log10(raw))
    step = next(factor * power for factor in (1, 2, 5, 10) if factor * power >= raw * 0.999)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return [index * step for index in range(first, last + 1)]


def log_ticks(low, high):
    """Powers of ten that cover the range."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    return [10.0 ** power for power in range(first, max(last, first + 1) + 1)]


class Chart:
    """A picture with named positions on the x axis and numbers on the y axis."""

    def __init__(self, title, y_label, x_label, places, low, high, logarithmic=False):
        self._logarithmic = logarithmic
        self._ticks = log_ticks(low, high) if logarithmic else linear_ticks(low, high)
        self._places = places
        self._parts = []
        self._title, self._y_label, self._x_label = title, y_label, x_label

    def x(self, place, offset=0.0):
        """The position of a place; `offset` moves it by this part of the distance to the next one."""
        step = (WIDTH - LEFT - RIGHT) / len(self._places)
        return LEFT + step * (place + 0.5 + offset)

    def y(self, value):
        first, last = self._ticks[0], self._ticks[-1]
        if self._logarithmic:
            first, last, value = math.log10(first), math.log10(last), math.log10(max(value, first))
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (value - first) / (last - first)

    def box(self, place, offset, summary, series, about):
        """Least and most, the quartiles, the median, and the mean as a dashed line; as in the paper."""
        middle, half = self.x(place, offset), 0.07 * (WIDTH - LEFT - RIGHT) / len(self._places)
        left, right = middle - half, middle + half
        y = {key: self.y(summary[key]) for key in ('least', 'p25', 'p50', 'mean', 'p75', 'most')}
        self._parts.append(
            f'<g class="series{series}"><title>{escape(about)}</title>'
            f'<path class="stroke" d="M{middle:.1f} {y["least"]:.1f}V{y["p25"]:.1f}M{middle:.1f} {y["p75"]:.1f}'
            f'V{y["most"]:.1f}M{left:.1f} {y["least"]:.1f}H{right:.1f}M{left:.1f} {y["most"]:.1f}H{right:.1f}'
            f'M{left:.1f} {y["p50"]:.1f}H{right:.1f}"/>'
            f'<rect class="stroke fill" x="{left:.1f}" y="{y["p75"]:.1f}" width="{right - left:.1f}" '
            f'height="{max(y["p25"] - y["p75"], 0.5):.1f}"/>'
            f'<path class="stroke dashed" d="M{left:.1f} {y["mean"]:.1f}H{right:.1f}"/></g>')

    def line(self, estimates, series, abouts, offset=0.0):
        """A line through estimates, one for each place, with their intervals as bars."""
        points = [(self.x(place, offset), estimate) for place, estimate in enumerate(estimates) if estimate is not None]
        path = 'L'.join(f'{x:.1f} {self.y(one["value"]):.1f}' for x, one in points)
        self._parts.append(f'<g class="series{series}"><path class="stroke thick" d="M{path}"/>')
        for (x, one), about in zip(points, abouts):
            low, high = self.y(one['low']), self.y(one['high'])
            self._parts.append(
                f'<g><title>{escape(about)}</title><path class="stroke" d="M{x:.1f} {low:.1f}V{high:.1f}M{x - 4:.1f} {low:.1f}'
                f'H{x + 4:.1f}M{x - 4:.1f} {high:.1f}H{x + 4:.1f}"/>'
                f'<circle class="dot" cx="{x:.1f}" cy="{self.y(one["value"]):.1f}" r="3.5"/></g>')
        self._parts.append('</g>')

    def level(self, value, text):
        """A horizontal line that a text explains."""
        y = self.y(value)
        self._parts.append(f'<path class="level" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>'
                           f'<text class="level-text" x="{WIDTH - RIGHT - 2}" y="{y - 4:.1f}" text-anchor="end">'
                           f'{escape(text)}</text>')

    def svg(self):
        grid = []
        for tick in self._ticks:
            y = self.y(tick)
            grid.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}"/>'
                        f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end">{number(tick)}</text>')
        for place, name in enumerate(self._places):
            grid.append(f'<text x="{self.x(place):.1f}" y="{HEIGHT - BOTTOM + 16}" text-anchor="middle">{escape(name)}</text>')
        middle = (TOP + HEIGHT - BOTTOM) / 2
        return (f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(self._title)}">'
                f'<text class="title" x="{LEFT}" y="16">{escape(self._title)}</text>{"".join(grid)}'
                f'<text x="14" y="{middle:.0f}" text-anchor="middle" transform="rotate(-90 14 {middle:.0f})">'
                f'{escape(self._y_label)}</text>'
                f'<text x="{(LEFT + WIDTH - RIGHT) / 2:.0f}" y="{HEIGHT - 8}" text-anchor="middle">{escape(self._x_label)}</text>'
                f'{"".join(self._parts)}</svg>')


def legend(names):
    """The names of the series, in their colours."""
    return '<p class="legend">' + ''.join(
        f'<span class="series{series}"><i></i>{escape(name)}</span>' for series, name in enumerate(names)) + '</p>'
