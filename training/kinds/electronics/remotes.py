"""Remote controls."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point, Polygon
from shapely.geometry import box as square
from trimesh import Trimesh

from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, common, cut, prism, rod, rounded, vec


class _Keys:
    """The keys of one remote: they look alike, are numbered and go down by the same way."""

    def __init__(self, m: Model, top: float) -> None:
        self.m, self.top, self.count = m, top, 0
        self.style, self.high = m.pick("round", "square", "pill", "mixed"), m.number(0.0012, 0.003)
        self.n = m.pick(2, 3, 4)

    def press(self, outline: Polygon, name: str = "") -> None:
        part = name or f"key_{self.count}"
        self.count += not name
        self.m.add(part, prism(outline, "z", (self.top - 0.001, self.top + self.high)))
        self.m.slide(part, (0, 0, -1), 0.7 * self.high)

    def key(self, x: float, y: float, wide: float, tall: float, name: str = "") -> None:
        style = self.m.pick("round", "square", "pill") if self.style == "mixed" else self.style
        if style == "round":
            wide = tall = min(wide, tall)
        r = {"round": 0.499, "square": 0.1, "pill": 0.45}[style] * min(wide, tall)
        self.press(rounded((x - wide / 2, x + wide / 2), (y - tall / 2, y + tall / 2), r, self.n), name)

    def row(self, x: Span, y: float, count: int, tall: float) -> None:
        each = (x[1] - x[0]) / count
        for k in range(count):
            self.key(x[0] + (k + 0.5) * each, y, 0.78 * each, tall)

    def pad(self, y: float, r: float) -> None:
        """Four keys round a middle one; as a ring in quarters or apart."""
        if self.m.chance(0.6):
            ring = Point(0, y).buffer(r, quad_segs=8).difference(Point(0, y).buffer(0.48 * r, quad_segs=6))
            half = LINE * r
            cross = [(c * s, y + s * b) for c, b in ((1, 1), (1, -1)) for s in (-2 * r, 2 * r)]
            lines = [
                Polygon([(a[0], a[1] - half), (a[0], a[1] + half), (b[0], b[1] + half), (b[0], b[1] - half)])
                for a, b in zip(cross[::2], cross[1::2], strict=True)
            ]
            for line in lines:
                ring = ring.difference(line)
            for k, quarter in enumerate(sorted(ring.geoms, key=lambda g: (round(g.centroid.y, 4), g.centroid.x))):
                self.press(quarter, f"arrow_{k}")
        else:
            for k, (a, b) in enumerate(((0, -1), (-1, 0), (1, 0), (0, 1))):
                self.key(0.75 * r * a, y + 0.75 * r * b, 0.45 * r, 0.45 * r, f"arrow_{k}")
        self.press(Point(0, y).buffer(0.4 * r, quad_segs=4), "ok_key")

    def rocker(self, x: float, y: float, wide: float, tall: float, name: str) -> None:
        """A long key that tips to both ends."""
        outline = rounded((x - wide / 2, x + wide / 2), (y - tall / 2, y + tall / 2), 0.45 * wide, self.n)
        self.m.add(name, prism(outline, "z", (self.top - 0.001, self.top + self.high)))
        self.m.hinge(name, (x, y, self.top), (1, 0, 0), (-5, 5))


LINE = 0.06  # half the gap between the quarters of a ring of keys, of its radius


def _blocks(m: Model, keys: _Keys, x: Span, y: Span, only: tuple[str, ...] = ()) -> None:
    """Groups of keys from above downwards until the place is used up."""
    wide, at, most = x[1] - x[0], y[1], 40
    if m.chance(0.85):
        keys.key(m.pick(x[0] + 0.15 * wide, middle(x)), at - 0.006, 0.009, 0.009, "power_key")
        at -= 0.016
    order = only or tuple(m.rng.permutation(["pad", "digits", "rockers", "colours", "rows", "rows"]))
    for what in order:
        tall = {"pad": 0.76 * wide, "digits": 0.044, "rockers": 0.034, "colours": 0.011, "rows": 0.024}[what]
        if at - tall < y[0] or len(m.joints) > most:
            continue
        if what == "pad":
            keys.pad(at - tall / 2, 0.36 * wide)
        elif what == "rockers":
            for s, name in ((-1, "volume_rocker"), (1, "channel_rocker")):
                keys.rocker(middle(x) + s * 0.33 * wide, at - tall / 2, 0.2 * wide, 0.85 * tall, name)
            keys.key(middle(x), at - 0.3 * tall, 0.18 * wide, 0.007)
        else:
            lines, count = {"digits": (4, 3), "colours": (1, 4), "rows": (2, 3)}[what]
            step = tall / lines
            for k in range(lines):
                keys.row(x, at - (k + 0.5) * step, count, 0.68 * step)
        at -= tall + 0.005


def _body(m: Model, x: Span, y: Span, z: Span, style: str) -> Trimesh:
    """The case: a bar with round corners, a waist, or a foot thicker below."""
    if style == "waist":
        u = np.linspace(0, 1, 16)
        half = x[1] * (1 - 0.16 * np.sin(np.pi * u) ** 2)
        edge = np.r_[np.c_[half, y[0] + u * (y[1] - y[0])], np.c_[-half, y[0] + u * (y[1] - y[0])][::-1]]
        outline = Polygon(edge).buffer(-0.006).buffer(0.006, quad_segs=4)
        return prism(outline, "z", z)
    corner = {"square": 0.002, "bar": m.number(0.004, 0.012), "slim": 0.49 * (x[1] - x[0]), "broad": 0.01}[style]
    return prism(rounded(x, y, corner, m.pick(2, 4, 6)), "z", z)


def _battery(m: Model, body: Trimesh, x: Span, y: Span, thick: float) -> Trimesh:
    """A cover that slides down off the underside, let into its foot or flat on it; gives the case with its place cut out."""
    sunk, t, reach = m.chance(0.6), 0.0018, m.number(0.3, 0.45) * (y[1] - y[0])
    a = (y[0] - 0.001, y[0] + reach) if sunk else (y[0] + 0.012, y[0] + 0.012 + reach)
    b, gap = shrunk(x, m.number(0.1, 0.2) * (x[1] - x[0])), m.pick(0.0, 0.0003, 0.0006)
    z = (0.0, t) if sunk else (-t, 0.0)
    cover = prism(rounded(shrunk(b, gap), (a[0] + gap, a[1] - gap), 0.0015, 2), "z", z)
    m.add("battery_cover", common(cover, body) if sunk else cover)
    low, mid = z[0], middle(b)
    grooves = [(a[1] - 0.008 - c, a[1] - 0.0068 - c) for c in (0, 0.0025, 0.005)]
    m.add("battery_cover", *(box((mid - 0.006, mid + 0.006), c, (low - 0.0006, low + 0.001)) for c in grooves))
    m.slide("battery_cover", (0, -1, 0), m.number(0.6, 0.9) * (a[1] - a[0]))
    if not sunk:
        return body
    body = cut(body, box(b, a, (-1, t)))
    if m.chance(0.5) and thick > 0.015:
        room = shrunk(b, 0.003), (y[0] + 0.014, a[1] - 0.004)
        body = cut(body, box(*room, (0, 0.012)))
        r = min(0.005, (room[0][1] - room[0][0]) / 4)
        for s in (-0.5, 0.5):
            p = vec(mid + s * 2.04 * r, room[1][0] + 0.001, 0.012 - 0.95 * r)
            m.add(BASE, rod(p, p + vec(0, room[1][1] - room[1][0] - 0.002, 0), r, 12))
    return body


def _flap(m: Model, x: Span, y: Span, top: float) -> None:
    """A cover over the lower keys: slides down, or hinged at its foot or a side."""
    z, how = (top + 0.0036, top + 0.0052), m.pick("slide", "foot", "side")
    rim = (top, z[0])
    m.add("flap", prism(rounded(x, y, 0.003), "z", z))
    if how == "slide":
        m.add(BASE, *(box((s * x[1], s * (x[1] - 0.0015)), y, (top - 0.001, z[0])) for s in (-1, 1)))
        m.slide("flap", (0, -1, 0), m.number(0.5, 0.9) * (y[1] - y[0]))
    elif how == "foot":
        m.add("flap", box(x, (y[0], y[0] + 0.0015), (rim[0] + 0.0003, z[0])))
        m.hinge("flap", (middle(x), y[0], top + 0.0003), (1, 0, 0), m.pick(110, 170))
    else:
        m.add("flap", box((x[0], x[0] + 0.0015), y, (rim[0] + 0.0003, z[0])))
        m.hinge("flap", (x[0], middle(y), top + 0.0003), (0, -1, 0), m.pick(110, 170))


def remote_control(m: Model) -> None:
    """A remote for a television, a slim one, or one with a screen: keys that go down, a battery cover, a flap on some."""
    style, screen = m.pick("bar", "bar", "square", "waist", "slim", "broad"), m.chance(0.3)
    wide = {"slim": m.number(0.032, 0.04), "broad": m.number(0.055, 0.07)}.get(style, m.number(0.042, 0.054))
    long = m.number(0.12, 0.16) if style in ("slim", "broad") else m.number(0.15, 0.225)
    thick = m.number(0.009, 0.014) if style == "slim" else m.number(0.016, 0.024)
    x, y = (-wide / 2, wide / 2), (-long / 2, long / 2)
    keys, body = _Keys(m, thick), _body(m, x, y, (0, thick), style)
    if m.chance(0.75):
        body = _battery(m, body, x, y, thick)
    m.add(BASE, body)
    inner = shrunk(x, (0.2 if style == "waist" else 0.11) * wide)
    area = (y[0] + (0.014 if style == "slim" else 0.008), y[1] - (0.012 if style == "slim" else 0.008))
    if screen:
        low = area[1] - m.number(0.2, 0.28) * long
        m.add(BASE, prism(rounded(inner, (low, area[1]), 0.002), "z", (thick, thick + m.pick(0.0006, 0.0015))))
        area = (area[0], low - 0.006)
    elif m.chance(0.4):
        m.add(BASE, prism(square(inner[0], y[0] + 0.02, inner[1], y[1] - 0.02), "z", (thick, thick + 0.0003)))
    if style in ("bar", "square", "broad") and m.chance(0.3):
        low = (area[0], area[0] + m.number(0.3, 0.42) * long)
        keys.high = min(keys.high, 0.0024)
        _flap(m, shrunk(x, 0.002), (y[0] + 0.003, low[1] + 0.003), thick)
        _blocks(m, keys, shrunk(inner, 0.001), (low[0] + 0.002, low[1] - 0.002), ("digits", "rows"))
        area = (low[1] + 0.006, area[1])
        order = ("pad", "rockers", "rows")
    else:
        order = m.pick((), (), ("pad", "rockers", "rows"), ("rows", "pad", "rows", "rockers")) if style == "slim" else ()
    _blocks(m, keys, inner, area, order)
    if m.chance(0.5):
        m.add(BASE, box(shrunk(x, 0.3 * wide), (y[1] - 0.004, y[1] + 0.0006), (0.3 * thick, 0.75 * thick)))
