"""Vans, and the doors at the end of a vehicle body."""

from __future__ import annotations

from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, moved, prism, rectangle, rod, rounded
from training.kinds.vehicles.vehicles import prisms, vehicle


def _opened(m: Model, hole: Trimesh) -> None:
    """Cut a hole into all that is fixed."""
    m.pieces = [(p, cut(s, hole) if p == BASE and s.is_volume else s) for p, s in m.pieces]


def rear_doors(m: Model, half: float, y: float, z: Span, parent: str = BASE, glass: bool = False, lift: bool = False) -> None:
    """Two doors at the end of a body, hinged at its corners, or a flap hinged at the top; thick behind y."""
    split = m.pick(0.0, 0.0, 0.25 * half)
    spans = [(-half, half)] if lift else [(-half, split - 0.004), (split + 0.004, half)]
    thick, glazed, bars = 0.04, glass and m.chance(0.7), m.pick(0, 1, 2)
    for k, (a, b) in enumerate(spans):
        part, s = f"rear_door_{k}" if not lift else "tailgate", (-1, 1)[k]
        panel = rectangle((a, b), z)
        pane = rounded((a + 0.08, b - 0.08), (z[0] + 0.5 * (z[1] - z[0]), z[1] - 0.1), 0.04)
        m.add(part, prism(panel.difference(pane) if glazed else panel, "y", (y, y + thick)))
        if glazed and m.chance(0.7):
            m.add(part, prism(pane.buffer(0.005), "y", (y + 0.012, y + 0.02)))
        inner = b if k == 0 else a
        for c in range(bars if not glazed else 0):
            x = inner - (c + 1) * 0.09 * (-s)
            m.add(part, rod((x, y + thick + 0.02, z[0] + 0.02), (x, y + thick + 0.02, z[1] - 0.02), 0.014, 6))
            m.add(part, box((x - 0.02, x + 0.02), (y + thick, y + thick + 0.03), (z[0] + 0.4, z[0] + 0.46)))
        low = z[0] + (0.12 if lift else 0.4 * (z[1] - z[0]))
        x = 0.0 if lift else inner + 0.09 * s
        m.add(part, box((x - 0.06, x + 0.06), (y + thick, y + thick + 0.03), (low, low + 0.04)))
        if lift:
            m.hinge(part, (0, y + thick, z[1]), (1, 0, 0), m.pick(80, 90), parent)
            return
        edge = a if k == 0 else b
        for c in (0.15, 0.85) if m.chance(0.6) else ():
            at = z[0] + c * (z[1] - z[0])
            m.add(part, rod((edge, y + thick, at - 0.05), (edge, y + thick, at + 0.05), 0.014, 8))
        m.hinge(part, (edge, y + thick, z[0]), (0, 0, -s), m.pick(90, 110, 180), parent)


def _sliding(m: Model, name: str, s: int, half: float, y: Span, z: Span, glass: bool) -> None:
    """A door that runs to the rear outside the body, on rails."""
    window = rounded((y[0] + 0.1, y[1] - 0.1), (z[0] + 0.55 * (z[1] - z[0]), z[1] - 0.1), 0.06)
    panel = rounded(y, z, 0.05)
    x = tuple(sorted((s * (half + 0.022), s * (half + 0.055))))
    m.add(name, *prisms(panel.difference(window) if glass else panel, "x", x))
    if glass and m.chance(0.7):
        m.add(name, prism(window.buffer(0.004), "x", tuple(sorted((s * (half + 0.03), s * (half + 0.036))))))
    at = y[0] + 0.12, z[0] + 0.48 * (z[1] - z[0])
    face = s * (half + 0.055)
    m.add(name, box((face, face + s * 0.03), (at[0] - 0.05, at[0] + 0.1), (at[1] - 0.02, at[1] + 0.02)))
    run = 0.92 * (y[1] - y[0])
    for level in (z[0] + 0.42 * (z[1] - z[0]), z[0] + 0.03)[: m.pick(1, 2)]:
        m.add(BASE, box((s * half, s * (half + 0.02)), (y[1] - 0.1, y[1] + run), (level - 0.02, level + 0.02)))
    m.slide(name, (0, 1, 0), run)


def _van_trims(m: Model, half: float, long: float, high: float, nose: float) -> None:
    for s in (-1, 1):
        m.add(BASE, box((s * (half - 0.3), s * (half - 0.06)), (-0.02, 0.08), (nose - 0.28, nose - 0.12)))
        m.add(BASE, box((s * (half - 0.1), s * (half - 0.01)), (long - 0.02, long + 0.03), (0.75, 1.2)))
        x = s * (half + 0.02)
        m.add(
            BASE, box((x, x + s * 0.16), (0.95, 1.02), (nose + 0.15, nose + 0.4)), box((s * half, x), (0.97, 1.0), (1.2, 1.3))
        )
    m.add(BASE, box((-half, half), (-0.08, 0.05), (0.3, 0.5)), box((-half, half), (long - 0.05, long + 0.09), (0.32, 0.45)))
    m.add(BASE, *(box((-0.5, 0.5), (-0.03, 0.0), (c, c + 0.03)) for c in (0.56, 0.62, 0.68)))
    extra = m.pick("rack", "vent", "box", "none")
    if extra == "rack":
        m.add(BASE, *(rod((-half + 0.1, y, high + 0.1), (half - 0.1, y, high + 0.1), 0.02, 6) for y in (1.8, 2.5, 3.2)))
        m.add(BASE, *(box((x - 0.02, x + 0.02), (1.6, 3.4), (high - 0.02, high + 0.1)) for x in (-half + 0.12, half - 0.12)))
    elif extra != "none":
        m.add(BASE, box((-0.35, 0.35), (2.0, 2.0 + m.pick(0.5, 1.2)), (high - 0.01, high + m.pick(0.06, 0.2))))


def van(m: Model) -> None:
    """Make a panel van, minibus or flat-nosed van: sliding doors on one or both sides, rear doors or a tailgate, windows."""
    long, half, high, radius = m.number(4.7, 5.8), m.number(0.88, 1.0), m.number(1.9, 2.6), m.number(0.32, 0.38)
    nose, form = m.number(0.95, 1.1), m.pick("panel", "bus", "flat")
    bonnet = 0.15 if form == "flat" else m.number(0.6, 0.85)
    screen = bonnet + m.number(0.55, 0.75)
    top = [(0, nose - 0.15), (bonnet, nose + (0.0 if form == "flat" else 0.12)), (screen, high - 0.08), (screen + 0.4, high)]
    top += [(long - 0.06, high), (long, high - 0.12)]
    axles = (0.8 if form != "flat" else 0.75, long - m.number(0.85, 1.1))
    front = (max(axles[0] + 0.25, screen - 0.15), 0.0)
    front = (front[0], front[0] + m.number(0.8, 0.95))
    lids = [((0.06, bonnet - 0.02), 1)] if form != "flat" and m.chance(0.8) else []
    vehicle(m, top, half, axles, radius, [(front, True, False)], lids)
    for part, solid in m.pieces:
        if part == "lid_0":
            moved(solid, (0, 0, 0.005))
    z, start = (0.42, high - 0.2), front[1] + 0.06
    y = (start, min(start + m.number(1.0, 1.25), start + 0.5 * (long - start) - 0.05, axles[1] - 1.2 * radius))
    glass, sides = form == "bus" or m.chance(0.3), m.pick((1,), (-1,), (-1, 1))
    recess = m.chance(0.6)
    for s in sides:
        if recess:
            _opened(m, box((s * (half - 0.45), s * (half + 1)), (y[0] + 0.06, y[1] - 0.06), (z[0] + 0.08, z[1] - 0.06)))
        _sliding(m, "sliding_door" + ("_l" if s < 0 else "_r"), s, half, y, z, glass)
    for s in (-1, 1) if form == "bus" else ():
        for a, b in [(y[1] + 0.12, long - 0.2)] + ([] if s in sides else [y]):
            at = sorted((s * half, s * (half + 0.012)))
            m.add(BASE, prism(rounded((a, b), (1.3, high - 0.3), 0.06), "x", (at[0], at[1])))
    if m.chance(0.5):
        _opened(m, box((-half + 0.16, half - 0.16), (y[1] + 0.1, long + 1), (0.65, high - 0.3)))
    rear_doors(m, half - 0.12, long + 0.003, (0.5, high - 0.16), BASE, m.chance(0.6), m.chance(0.25))
    _van_trims(m, half, long, high, nose)
