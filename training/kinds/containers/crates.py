"""Crates with lids."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.containers.cartons import shell
from training.kinds.containers.cases import drop_handle
from training.kinds.joinery import shrunk
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rod, tube


def _slatted(m: Model, x: Span, y: Span, z: Span, t: float) -> None:
    """Walls of boards with gaps, on posts inside the corners or battens outside, and a floor of boards."""
    count, share = m.pick(2, 3, 4, 5), m.number(0.7, 0.95)
    step = (z[1] - z[0]) / (count - 1 + share)
    for k in range(count):
        level = z[0] + k * step, z[0] + (k + share) * step
        m.add(BASE, *(box(x, (b, b + t), level) for b in (y[0], y[1] - t)))
        m.add(BASE, *(box((a, a + t), shrunk(y, t), level) for a in (x[0], x[1] - t)))
    if m.chance(0.6):
        post = min(0.035, 0.1 * (y[1] - y[0]))
        m.add(
            BASE,
            *(box((a, a + post), (b, b + post), z) for a in (x[0] + t, x[1] - t - post) for b in (y[0] + t, y[1] - t - post)),
        )
    else:
        out = 0.7 * t
        m.add(
            BASE, *(box((a, a + 3 * t), b, z) for a in (x[0], x[1] - 3 * t) for b in ((y[0] - out, y[0]), (y[1], y[1] + out)))
        )
    if m.chance(0.5):
        m.add(BASE, box(shrunk(x, t), shrunk(y, t), (z[0], z[0] + t)))
        return
    edges = np.linspace(y[0] + t, y[1] - t, 5)
    m.add(BASE, *(box(shrunk(x, t), (a, b - 0.006), (z[0], z[0] + t)) for a, b in pairwise(edges)))


def _planks(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A lid of one board or of planks along x, with battens across its top or its underside."""
    count, space = m.pick(1, 3, 4, 6), m.pick(0.0, 0.002, 0.008)
    edges = np.linspace(*y, count + 1)
    m.add(part, *(box(x, (a, b - (space if count > 1 else 0)), z) for a, b in pairwise(edges)))
    thick, side = z[1] - z[0], m.pick("top", "top", "none")
    if side == "top" or count > 1:
        spots = m.pick((0.12, 0.88), (0.2, 0.8), (0.1, 0.5, 0.9))
        wide = 0.03 + 0.02 * (x[1] - x[0])
        ends = [x[0] + c * (x[1] - x[0]) for c in spots]
        m.add(part, *(box((a - wide, a + wide), shrunk(y, 0.004), (z[1], z[1] + thick)) for a in ends))


def _end_handles(m: Model, x: Span, z: float) -> None:
    """Rope loops, cleats, or metal handles that swing, on both ends."""
    style, still = m.pick("rope", "cleat", "metal", "metal", "none"), m.chance(0.2)
    for name, a, s in (("handle_left", x[0], -1), ("handle_right", x[1], 1)):
        if style == "rope":
            t = np.linspace(0, np.pi, 7)[:, None]
            path = [a, 0, z] + np.cos(t) * [0, 0.07, 0] + np.sin(t) * [s * 0.03, 0, -0.05]
            m.add(BASE, tube(path, 0.007, 6), *(ball((a, b, z), (0.012,) * 3, 8) for b in (-0.07, 0.07)))
        elif style == "cleat":
            m.add(BASE, box((a, a + s * 0.025), (-0.09, 0.09), (z - 0.02, z + 0.02)))
        elif style == "metal":
            drop_handle(m, name, s, a, z, 0.09, still)


def _hasp(m: Model, front: float, z: float, x: float, name: str) -> None:
    """A hasp that hangs from the lid over a staple on the body."""
    m.add(name, box((x - 0.018, x + 0.018), (front - 0.006, front - 0.002), (z - 0.06, z + 0.006)))
    m.add(name, rod((x - 0.018, front - 0.004, z + 0.006), (x + 0.018, front - 0.004, z + 0.006), 0.004, 8))
    m.add("lid", box((x - 0.02, x + 0.02), (front - 0.002, front + 0.001), (z + 0.001, z + 0.012)))
    m.add(BASE, box((x - 0.025, x + 0.025), (front - 0.002, front), (z - 0.065, z - 0.01)))
    if m.chance(0.6):
        m.add(BASE, box((x - 0.003, x + 0.003), (front - 0.018, front), (z - 0.045, z - 0.03)))
    m.hinge(name, (x, front - 0.004, z + 0.006), (-1, 0, 0), m.pick(90, 120), "lid")


def _wooden(m: Model, style: str) -> None:
    """A crate of boards or slats whose lid hinges at its back or lifts off."""
    wide, high, t = m.number(0.35, 0.9), m.number(0.15, 0.45), m.number(0.01, 0.02)
    deep, foot = wide * m.number(0.45, 0.85), m.pick(0.0, 0.03)
    high = min(high, 0.65 * wide)
    x, y, top = (-wide / 2, wide / 2), (-deep / 2, deep / 2), foot + high
    slatted = m.chance(0.6)
    if slatted:
        _slatted(m, x, y, (foot, top), t)
    else:
        shell(m, BASE, x, y, (foot, top), t, 1, m.pick("cut", "boards"))
        battens = m.chance(0.5)
        for a in (x[0] + 0.1 * wide, x[1] - 0.1 * wide) if battens else ():
            m.add(BASE, box((a - 0.025, a + 0.025), (y[0] - 0.8 * t, y[0]), (foot, top)))
            m.add(BASE, box((a - 0.025, a + 0.025), (y[1], y[1] + 0.8 * t), (foot, top)))
    g, over = m.pick(0.0, 0.001, 0.004), m.pick(0.0, 0.012)
    _planks(m, "lid", shrunk(x, -over), (y[0] - over, y[1]), (top + g, top + g + t))
    if style == "lift":
        m.add("lid", *(box((a - 0.015, a + 0.015), shrunk(y, t + 0.006), (top - t, top + g)) for a in (0.5 * x[0], 0.5 * x[1])))
        if m.chance(0.5):
            m.add(
                "lid",
                tube(
                    [(-0.06, 0, top + t), (-0.05, 0, top + t + 0.04), (0.05, 0, top + t + 0.04), (0.06, 0, top + t)], 0.007, 6
                ),
            )
        m.slide("lid", (0, 0, 1), m.number(0.5, 1.0) * high)
    else:
        m.hinge("lid", (0, y[1], top), (-1, 0, 0), m.pick(90, 105, 170))
        for a in m.pick((), (0.6 * x[0], 0.6 * x[1]), (0.6 * x[0], 0, 0.6 * x[1])):
            m.add(BASE, box((a - 0.02, a + 0.02), (y[1], y[1] + 0.003), (top - 0.06, top - 0.004)))
            m.add("lid", box((a - 0.02, a + 0.02), (y[1], y[1] + 0.003), (top + 0.004, top + t)))
            m.add(m.pick(BASE, "lid"), rod((a - 0.02, y[1] + 0.002, top), (a + 0.02, y[1] + 0.002, top), 0.005, 8))
        for k, c in enumerate(m.pick((), (0.0,), (-0.3, 0.3))):
            _hasp(m, y[0] - over - 0.001, top, c * wide, f"hasp_{k}")
    _end_handles(m, x, foot + 0.62 * high)
    if not slatted and m.chance(0.6):
        m.add(BASE, box((-0.12 * wide, 0.12 * wide), (y[0] - 0.0015, y[0]), (foot + 0.25 * high, foot + 0.5 * high)))
    if foot:
        m.add(BASE, *(box((a - 0.03, a + 0.03), y, (0, foot)) for a in shrunk(x, 0.06)))


def _sliding(m: Model) -> None:
    """A flat case for bottles or dominoes whose lid slides out of grooves to the front or the right."""
    wide, high, t = m.number(0.2, 0.5), m.number(0.08, 0.2), m.number(0.008, 0.014)
    deep = wide * m.number(0.5, 1.2)
    x, y, lid = (-wide / 2, wide / 2), (-deep / 2, deep / 2), 0.8 * t
    m.add(BASE, box(x, y, (0, t)), box(x, (y[1] - t, y[1]), (t, high)), box(x, (y[0], y[0] + t), (t, high - lid - 0.006)))
    groove = box((x[0] + 0.5 * t, x[1] - 0.5 * t), (y[0] - 1, y[1] - 0.5 * t), (high - lid - 0.006, high - 0.005))
    solid = m.chance(0.5)
    for a in (x[0], x[1] - t):
        m.add(BASE, cut(box((a, a + t), (y[0], y[1] - t), (t, high)), groove))
    c = m.pick(0.0, 0.0004, 0.001)
    m.add("lid", box(shrunk(x, 0.5 * t + c), (y[0], y[1] - t), (high - lid - 0.006 + c, high - 0.005 - c)))
    grip = m.pick("bar", "dot", "rim", "none")
    if grip == "bar":
        m.add("lid", box((-0.04, 0.04), (y[0] + 0.02, y[0] + 0.03), (high - 0.006, high + 0.004)))
    elif grip == "dot":
        m.add("lid", rod((0, y[0] + 0.04, high - 0.006), (0, y[0] + 0.04, high + 0.006), 0.012, 12))
    elif grip == "rim":
        m.add("lid", box(shrunk(x, t + 0.004), (y[0] - 0.006, y[0] + 0.006), (high - lid - 0.006, high + 0.002)))
    m.slide("lid", (0, -1, 0), m.number(0.7, 0.95) * deep)
    if m.chance(0.6):
        m.add("lid", box((-0.25 * wide, 0.25 * wide), (-0.1 * deep, 0.25 * deep), (high - 0.006, high - 0.0045)))
    if solid:
        for k in range(m.pick(1, 2, 3)):
            a = x[0] + (k + 0.5) * wide / 3
            m.add(
                BASE,
                rod(
                    (a, y[0] + 0.1 * deep, 0.45 * high), (a, y[1] - 0.12 * deep, 0.45 * high), min(0.28 * high, 0.14 * wide), 12
                ),
            )
    if m.chance(0.5):
        m.add(BASE, box((-0.3 * wide, 0.3 * wide), (y[0] - 0.001, y[0]), (0.2 * high, 0.6 * high)))
    _end_handles(m, x, 0.6 * high)


def _tote(m: Model) -> None:
    """A plastic tote, narrower below, with two lids that meet in fingers and hinge at the long sides."""
    wide, deep, high, t = m.number(0.5, 0.65), m.number(0.34, 0.42), m.number(0.24, 0.36), 0.006
    taper, x, y = m.number(0.02, 0.05), (-wide / 2, wide / 2), (-deep / 2, deep / 2)

    def outline(by: float, z: float) -> np.ndarray:
        return np.array(
            [
                (a, b, z)
                for a, b in ((x[0] + by, y[0] + by), (x[1] - by, y[0] + by), (x[1] - by, y[1] - by), (x[0] + by, y[1] - by))
            ]
        )

    m.add(BASE, loft(np.stack([outline(taper, 0), outline(0, high), outline(t, high), outline(taper + t, t)])))
    rim = 0.02
    m.add(BASE, *(box(x, (b, b + s * 0.012), (high - rim, high)) for b, s in ((y[0], -1), (y[1], 1))))
    m.add(BASE, *(box((a, a + s * 0.025), (y[0], y[1]), (high - rim, high)) for a, s in ((x[0], -1), (x[1], 1))))
    teeth, reach, g = m.pick(3, 5, 7), m.number(0.015, 0.03), m.pick(0.0, 0.002)
    steps = np.linspace(*x, teeth + 1)
    for name, s in (("lid_front", -1), ("lid_back", 1)):
        edge = [(c, -reach if k % 2 else reach) for k in range(teeth) for c in (steps[k] + g / 2, steps[k + 1] - g / 2)]
        line = [(c, b - s * -g / 2) for c, b in edge]
        m.add(name, prism([(x[0], s * deep / 2), *line, (x[1], s * deep / 2)], "z", (high, high + t)))
        inside = sorted((s * (reach + 0.02), s * (deep / 2 - 0.03)))
        for a in np.linspace(x[0] + 0.06, x[1] - 0.06, m.pick(0, 3, 5)):
            m.add(name, box((a - 0.006, a + 0.006), tuple(inside), (high + t, high + t + 0.004)))
        m.hinge(name, (0, s * (deep / 2), high + t), (-s, 0, 0), m.pick(110, 180, 250))
        m.add(
            m.pick(name, BASE),
            *(
                rod((c - 0.05, s * deep / 2, high + t), (c + 0.05, s * deep / 2, high + t), 0.005, 8)
                for c in (x[0] / 2, x[1] / 2)
            ),
        )
    for a in np.linspace(x[0] + 0.08, x[1] - 0.08, m.pick(0, 4, 6)):
        for b, s in ((y[0], 1), (y[1], -1)):
            low, up = b + s * (taper - 0.002), b - s * 0.002
            m.add(
                BASE,
                prism(
                    [(low, 0.02), (up, high - rim), (up - s * 0.008, high - rim), (low - s * 0.006, 0.02)],
                    "x",
                    (a - 0.004, a + 0.004),
                ),
            )
    if m.chance(0.6):
        a = x[1] - 0.3 * taper
        m.add(BASE, box((a - 0.01, a + 0.004), (-0.07, 0.07), (0.6 * high, 0.75 * high)))


def crate_with_lid(m: Model) -> None:
    """A crate: slats or boards with a hinged or loose lid, a flat case with a sliding lid, or a tote with two lids."""
    style = m.pick("hinged", "hinged", "lift", "slide", "tote")
    if style == "slide":
        _sliding(m)
    elif style == "tote":
        _tote(m)
    else:
        _wooden(m, style)
