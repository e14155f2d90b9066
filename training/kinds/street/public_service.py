"""Jukeboxes and fuel pumps."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, hang, middle
from training.kinds.solids import Span, arch, ball, box, cut, prism, rectangle, ring, rod, rounded, tube, vec


def _mechanism(m: Model, x: Span, y: Span, z: float) -> None:
    """What plays the records: a turntable that spins with its arm, and a rack of records that stays."""
    r, a, b = min(0.15, 0.24 * (x[1] - x[0]), 0.4 * (y[1] - y[0])), x[0] + 0.3 * (x[1] - x[0]), middle(y)
    m.add(BASE, box(x, y, (z - 0.015, z)), rod((a, b, z), (a, b, z + 0.02), 0.02, 12))
    m.add(
        "turntable",
        rod((a, b, z + 0.021), (a, b, z + 0.032), r, m.pick(16, 24)),
        rod((a, b, z + 0.03), (a, b, z + 0.045), 0.006, 8),
    )
    m.spin("turntable", (a, b, z), (0, 0, 1))
    c = (a + 1.25 * r, b + 0.6 * r, z + 0.05)
    m.add(
        "arm", rod((c[0], c[1], z), (c[0], c[1], z + 0.06), 0.012, 10), rod(c, (a + 0.9 * r, b - 0.8 * r, z + 0.045), 0.005, 6)
    )
    m.hinge("arm", c, (0, 0, -1), 35)
    for k in range(m.pick(0, 6, 10)):
        at = a + 1.5 * r + k * 0.012
        m.add(BASE, rod((at, b, z + 0.8 * r), (at + 0.004, b, z + 0.8 * r), 0.8 * r, 12))


def _keys(m: Model, x: Span, y: float, z: float) -> None:
    """Rows of keys before a face, with strips of titles above them that stay."""
    count, rows = m.pick(6, 8, 10), m.pick(1, 1, 2)
    for k in range(count * rows):
        at = (x[0] + (k % count + 0.5) * (x[1] - x[0]) / count, y, z + 0.035 * (k // count))
        button(m, f"key_{k}", at, (0, -1, 0), 0.018)
    if m.chance(0.7):
        m.add(
            BASE,
            *(
                box((a, a + 0.09), (y - 0.003, y), (z + 0.035 * rows, z + 0.035 * rows + 0.07))
                for a in np.linspace(x[0], x[1] - 0.09, 4)
            ),
        )


def _speaker(m: Model, x: Span, y: float, z: Span) -> None:
    """A speaker grille: bars that lie or stand, crossed lines, or rings."""
    style = m.pick("stand", "lie", "fan", "rings")
    m.add(BASE, box(x, (y - 0.004, y), z))
    c, d = middle(x), middle(z)
    if style == "rings":
        m.add(
            BASE,
            *(ring((c, y - 0.004, d), (0, 1, 0), k * 0.45 * min(x[1] - x[0], z[1] - z[0]), 0.008, 20) for k in (0.3, 0.6, 1)),
        )
    elif style == "fan":
        m.add(
            BASE,
            *(
                rod((c, y - 0.006, z[0] + 0.01), (a, y - 0.006, z[1] - 0.01), 0.006, 6)
                for a in np.linspace(*shrunk(x, 0.02), 7)
            ),
        )
    elif style == "stand":
        m.add(BASE, *(box((a - 0.006, a + 0.006), (y - 0.015, y), z) for a in np.linspace(*shrunk(x, 0.02), 8)))
    else:
        m.add(BASE, *(box(x, (y - 0.015, y), (b - 0.006, b + 0.006)) for b in np.linspace(*shrunk(z, 0.02), 7)))


def _arched_jukebox(m: Model, wide: float, deep: float, high: float) -> None:
    """A body with a round top, glowing tubes round it, and an arched glass door before the records."""
    x, rise, low, t = (-wide / 2, wide / 2), wide * m.pick(0.18, m.number(0.35, 0.5)), m.number(0.78, 0.85), 0.05
    whole, inner = arch(x, (0.06, high), rise), arch(shrunk(x, t), (low, high - t), rise - t)
    m.add(
        BASE,
        cut(prism(whole, "y", (0, deep)), prism(inner, "y", (-1, deep - 0.05))),
        box(shrunk(x, 0.03), (0.03, deep), (0, 0.06)),
    )
    _mechanism(m, shrunk(x, t), (0.03, deep - 0.05), low + 0.02)
    gap, y = max(m.gap(0.3), 0.0), (m.pick(-0.02, 0.0), 0.018)
    outer = inner.buffer(-gap) if y[0] == 0 else arch(shrunk(x, 0.02), (low - 0.02, high - 0.02), rise - 0.02)
    y = y if y[0] == 0 else (-0.02, -gap)
    m.add("door", prism(outer.difference(outer.buffer(-0.035)), "y", y))
    pane_, side = outer.buffer(-0.034), m.pick("left", "right")
    m.add("door", prism(pane_, "y", (middle(y) - 0.002, middle(y) + 0.002)))
    a, b, c, d = outer.bounds
    hang(m, "door", (a, c), y, (b, d - rise), side, OUT, m.number(85, 110))
    at = 0.9 * (c if side == "left" else a)
    m.add("door", rod((at, y[0], b + 0.1), (at, y[0] - 0.015, b + 0.1), 0.01, 10))
    if m.chance(0.5):
        r, turn = wide / 2 + 0.012, np.linspace(0, np.pi, 13)
        top = np.c_[r * np.cos(turn), np.full(13, 0.03), high - rise + (rise + 0.012) * np.sin(turn)]
        m.add(BASE, tube([(r, 0.03, 0.1), *top, (-r, 0.03, 0.1)], 0.016, 8))
    m.add(
        BASE,
        *(rod((s * (wide / 2 - 0.04), -0.02, 0.08), (s * (wide / 2 - 0.04), -0.02, low - 0.05), 0.03, 12) for s in (-1, 1)),
    )
    _speaker(m, shrunk(x, 0.12), 0, (0.12, low - 0.24))
    _keys(m, shrunk(x, 0.12), 0, low - 0.18)


def _console_jukebox(m: Model, wide: float, deep: float, high: float) -> None:
    """A chest on legs with a glass canopy that is hinged behind over the records."""
    x, low, deck = (-wide / 2, wide / 2), m.pick(0.06, 0.15), 0.68 * high
    m.add(BASE, box(x, (0, deep), (low, deck)))
    feet(m, x, (0, deep), low)
    _mechanism(m, shrunk(x, 0.05), (0.1, deep - 0.08), deck + 0.015)
    line = [(0.0, deck), (0.0, deck + 0.05), (m.number(0.1, 0.25), high), (deep, high), (deep, deck)]
    gap = max(m.gap(0.2), 0.0)
    shell = prism(line, "x", x)
    inside = [
        (b + (0.015 if b == 0 else -0.015 if b == deep else 0), c - (0.015 if c == high else 1 if c == deck else 0))
        for b, c in line
    ]
    m.add("lid", cut(shell, prism(inside, "x", shrunk(x, 0.015))).apply_translation((0, 0, gap)))
    if m.chance(0.6):
        m.add(
            "lid",
            *(prism(Polygon(line).difference(Polygon(line).buffer(-0.04)), "x", (c, c + 0.012)) for c in (x[0] - 0.012, x[1])),
        )
    m.add("lid", box((-0.06, 0.06), (-0.02, 0), (deck + 0.01, deck + 0.035)))
    m.hinge("lid", (0, deep, deck), (-1, 0, 0), m.number(45, 75))
    _keys(m, shrunk(x, 0.1), 0, deck - m.number(0.12, 0.18))
    _speaker(m, shrunk(x, m.pick(0.05, 0.2)), 0, (low + 0.04, deck - 0.22))


def jukebox(m: Model) -> None:
    """A jukebox with an arched glass door, round or square at the top, or with a canopy that lifts; keys, records, a grille."""
    wide, deep, high = m.number(0.75, 1.0), m.number(0.5, 0.68), m.number(1.3, 1.55)
    m.pick(_arched_jukebox, _arched_jukebox, _console_jukebox)(m, wide, deep, high)


def _nozzle(m: Model, part: str, at: np.ndarray, out: np.ndarray, outlet: np.ndarray, lifts: bool) -> None:
    """A nozzle that hangs in its boot, spout down, with its trigger and the hose to an outlet; it stays or lifts out."""
    up, side = vec(0, 0, 1), np.abs(np.cross(out, (0, 0, 1)))
    name = part if lifts else BASE
    elbow, end = at + 0.06 * up + 0.02 * out, at + 0.2 * out + 0.05 * up
    m.add(name, tube([at - 0.11 * up, at + 0.02 * up, elbow], 0.011, 8), rod(at + 0.02 * up, elbow + 0.02 * out, 0.024, 10))
    m.add(name, rod(elbow, end, 0.019, 10))
    m.add(
        name,
        tube([elbow + 0.02 * out, elbow + 0.04 * out - 0.07 * up, end - 0.07 * up - 0.02 * out, end - 0.01 * out], 0.005, 6),
    )
    pivot = elbow + 0.03 * out - 0.01 * up
    trigger = f"{part}_trigger" if lifts or m.chance(0.5) else BASE
    m.add(trigger, rod(pivot, pivot + 0.1 * out - 0.025 * up, 0.006, 6))
    if trigger != BASE:
        m.hinge(trigger, pivot, np.cross(out, up), 12, name)
    h = 0.035 * (side + np.abs(out))
    hole = 0.024 * (side + np.abs(out))
    m.add(
        BASE, cut(box(*np.c_[at - h - 0.13 * up, at + h - 0.01 * up]), box(*np.c_[at - hole - 0.12 * up, at + hole + 0.1 * up]))
    )
    m.add(BASE, box(*np.c_[at - h - 0.03 * out - 0.13 * up, at + 0.04 * side - 0.03 * out + 0.16 * up]))
    if lifts:
        m.slide(part, up, m.number(0.12, 0.2))
    t = np.linspace(0, 1, 11)[:, None]
    low = min(end[2] - 0.2, 0.25) * up - end[2] * up
    path = (1 - t) ** 3 * end + 3 * (1 - t) ** 2 * t * (end + 0.2 * out + low) + 3 * (1 - t) * t**2 * (outlet + 0.3 * out + low)
    m.add(BASE, tube(path + t**3 * outlet, 0.013, 8))


def _pump_front(m: Model, x: Span, y: float, low: float, mid: float, high: float, blank: bool) -> None:
    """The face of a pump: displays, grade buttons, a card slot, a receipt flap, a service door; blank: only the door."""
    part = m.pick("service_door", "service_door", BASE)
    span, z, d = shrunk(x, 0.02), (low + 0.02, mid - 0.02), (y - m.number(0.012, 0.025), y - max(m.gap(0.2), 0.0))
    m.add(part, box(span, d, z))
    m.add(part, *(box((a, a + 0.1), (d[0] - 0.002, d[0]), (z[0] + 0.1, z[0] + 0.11)) for a in (span[0] + 0.06, span[1] - 0.16)))
    m.add(part, rod((middle(span), d[0] - 0.008, z[1] - 0.05), (middle(span), d[0], z[1] - 0.05), 0.012, 12))
    if part != BASE:
        hang(m, part, span, d, z, m.pick("left", "right"), OUT, m.number(95, 130))
    if blank:
        return
    wide, tall = x[1] - x[0], high - mid
    m.add(BASE, box(shrunk(x, 0.12 * wide), (y - 0.008, y), (high - 0.45 * tall, high - 0.12 * tall)))
    m.add(BASE, *(box(shrunk(x, 0.2 * wide), (y - 0.011, y), (high - c * tall, high - (c - 0.1) * tall)) for c in (0.26, 0.4)))
    for k in range(m.pick(0, 3, 4)):
        button(m, f"grade_{k}", (x[0] + (0.2 + 0.12 * k) * wide, y, mid + 0.42 * tall), (0, -1, 0), 0.03)
    m.add(BASE, box((x[1] - 0.3 * wide, x[1] - 0.1 * wide), (y - 0.02, y), (mid + 0.35 * tall, mid + 0.5 * tall)))
    if m.chance(0.6):
        a, z = (x[1] - 0.32 * wide, x[1] - 0.1 * wide), (mid + 0.1 * tall, mid + 0.25 * tall)
        m.add(BASE, prism(rectangle(shrunk(a, -0.008), shrunk(z, -0.008), 0.008), "y", (y - 0.015, y)))
        m.add("receipt_flap", box(a, (y - 0.012, y - 0.008), z))
        hang(m, "receipt_flap", a, (y - 0.012, y - 0.008), z, "top", OUT, m.number(50, 80))


def _old_pump(m: Model, wide: float, high: float) -> None:
    """A slim old pump: a dial with hands that turn, a globe on top, a tall door, a hose at the side."""
    x, d, high = (-wide / 2, wide / 2), 0.42, 0.8 * high
    m.add(
        BASE,
        prism(arch(x, (0.06, high), m.pick(0.05, 0.5 * wide)), "y", (0, d)),
        box(shrunk(x, -0.03), (-0.03, d + 0.03), (0, 0.06)),
    )
    at, r = vec(0, 0, high - 0.5 * wide), 0.36 * wide
    m.add(BASE, rod(at - (0, 0.008, 0), at + vec(0, 0.01, 0), r, 24), ring(at - (0, 0.01, 0), (0, 1, 0), r, 0.012, 24))
    for k, share in enumerate(m.pick((0.85,), (0.8, 0.55))):
        y = -0.012 - 0.005 * k
        m.add(f"hand_{k}", box((-0.006, 0.006), (y - 0.003, y), (at[2] - 0.15 * r, at[2] + share * r)))
        m.spin(f"hand_{k}", at, (0, 1, 0))
    if m.chance(0.8):
        top = vec(0, d / 2, high)
        m.add(
            BASE,
            rod(top - (0, 0, 0.02), top + vec(0, 0, 0.06), 0.06, 12),
            ball(top + vec(0, 0, 0.2), (0.16, m.pick(0.06, 0.16), 0.16), 16),
        )
    _pump_front(m, x, 0, 0.08, at[2] - r - 0.06, high, True)
    s = m.pick(-1.0, 1.0)
    surface = vec(s * wide / 2, d / 2, 0.6 * high)
    _nozzle(m, "nozzle", surface + vec(s * 0.065, 0, 0), vec(s, 0, 0), surface + vec(0, 0.1, 0.2), m.chance(0.6))


def fuel_pump(m: Model) -> None:
    """A pump with nozzles at its sides or in front, under a header or free, or an old one with a dial and a globe."""
    wide, deep, high = m.number(0.55, 1.0), m.number(0.4, 0.6), m.number(1.7, 2.2)
    style = m.pick("sides", "front", "header", "old")
    if style == "old":
        _old_pump(m, m.number(0.42, 0.55), high)
        return
    x, low, top = (-wide / 2, wide / 2), m.number(0.08, 0.15), high * (0.72 if style == "header" else 1.0)
    m.add(BASE, box(shrunk(x, -0.05), (-0.05, deep + 0.05), (0, low)))
    m.add(BASE, box(x, (0, deep), (low, top)) if m.chance(0.5) else prism(rounded(x, (0, deep), 0.06), "z", (low, top)))
    mid = m.number(0.75, 0.9)
    if style == "header":
        m.add(
            BASE,
            *(box((c - 0.05, c + 0.05), (0.3 * deep, 0.7 * deep), (top - 0.02, high)) for c in (-0.35 * wide, 0.35 * wide)),
        )
        m.add(BASE, box(shrunk(x, -0.08), (-0.02, deep + 0.02), (high - 0.02, high + 0.22)))
    _pump_front(
        m, shrunk(x, 0.05), 0, low, mid - (0.05 if style == "front" else 0.0), top - (0.4 if style == "front" else 0.0), False
    )
    lifts = m.chance(0.7)
    if style == "front":
        count = m.pick(2, 3)
        for k in range(count):
            a = vec(x[0] + (k + 0.5) * wide / count, 0, top - 0.3)
            _nozzle(m, f"nozzle_{k}", a - (0, 0.065, 0), vec(0, -1, 0), a + vec(0, 0, 0.22), lifts)
        return
    for k, s in enumerate(m.pick((-1.0, 1.0), (1.0,), (-1.0,))):
        for b in m.pick((0.5,), (0.28, 0.72)):
            a = vec(s * wide / 2, b * deep, m.number(1.0, 1.15))
            outlet = vec(s * (wide / 2 + 0.08), b * deep, high) if style == "header" else vec(a[0], a[1], top - 0.08)
            _nozzle(m, f"nozzle_{k}_{b > 0.5:d}", a + vec(s * 0.065, 0, 0), vec(s, 0, 0), outlet, lifts)
