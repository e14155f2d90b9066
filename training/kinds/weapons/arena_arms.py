"""A revolver of one artist, and grips and triggers of arms; the muzzle looks to -Y."""

from __future__ import annotations

import numpy as np
from shapely.geometry import LineString, Polygon
from trimesh import Trimesh

from training.kinds.arena_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.solids import box, cut, prism, rectangle, rod


def slab(k: Look, outline: Polygon, half: float) -> list[Trimesh]:
    """A side view with a thickness, in CAD with cover plates, in other styles with an inlay."""
    found = [prism(outline, "x", (-half, half))]
    inner = outline.buffer(-0.006)
    if k.style in ("cad", "round", "old") and inner.geom_type == "Polygon" and not inner.is_empty:
        found += [prism(inner, "x", (s * 0.9 * half, s * 1.12 * half)) for s in (-1, 1)]
    return found


def trigger(m: Model, y: float, z: float, half: float) -> None:
    """A guard below (y, z) and a trigger that is pulled back."""
    deep, long = m.number(0.022, 0.03), m.number(0.022, 0.03)
    way = m.pick(
        [(-long, 0.002), (-long, -deep), (long, -deep), (long, 0.002)],
        [(-long, 0.002), (-0.8 * long, -0.8 * deep), (0, -deep), (0.8 * long, -0.7 * deep), (long, 0.002)],
    )
    guard = LineString([(y + a, z + b) for a, b in way]).buffer(0.0018, cap_style="flat")
    m.add(BASE, prism(guard, "x", (-0.5 * half, 0.5 * half)))
    blade = LineString([(y, z + 0.004), (y + 0.003, z - 0.4 * deep), (y - 0.002, z - 0.78 * deep)]).buffer(0.0024, quad_segs=2)
    m.add("trigger", prism(blade, "x", (-0.35 * half, 0.35 * half)))
    m.hinge("trigger", (0, y, z + 0.002), (1, 0, 0), m.pick(15, 20, 25))


def grip(m: Model, k: Look, y: float, z: float, half: float, long: float) -> list[Trimesh]:
    """A straight, raked or bulging grip below (y, z)."""
    rake = m.number(0.2, 0.5) * long
    wide = m.number(0.028, 0.042)
    shape = m.pick(
        [(y, z + 0.004), (y + wide, z + 0.004), (y + wide + rake, z - long), (y + rake, z - long)],
        [
            (y, z + 0.004),
            (y + wide, z + 0.004),
            (y + wide + 0.7 * rake, z - 0.6 * long),
            (y + wide + 1.1 * rake, z - long),
            (y + 0.9 * rake - 0.006, z - long),
            (y + 0.4 * rake, z - 0.5 * long),
        ],
    )
    return slab(k, Polygon(shape), half)


def revolver_gun(m: Model) -> None:
    """A frame with a drum that spins on a crane, in a barrel that breaks open, or in a solid frame with a gate."""
    k, style = look(m), m.pick("crane", "crane", "break", "solid")
    long, r, drum = m.number(0.06, 0.2), m.number(0.017, 0.023), m.number(0.034, 0.045)
    b, half, shots = m.number(0.006, 0.009), m.number(0.009, 0.013), m.pick(5, 6, 6, 8)
    top, low = r + m.pick(0.004, 0.008), -0.62 * r
    bore = 0.55 * r
    frame = Polygon([(-0.012, low - r), (drum + 0.05, low - r), (drum + 0.04, top), (-0.012, top)])
    opened = style == "break"
    sill, lintel = (low - r + 0.005, 9.0) if opened else (low - 0.75 * r, top - 0.006)
    window = rectangle((-0.013 if opened else 0.0, drum + 0.002), (sill, lintel))
    m.add(BASE, *slab(k, frame.difference(window), half))
    m.add(BASE, *grip(m, k, drum + 0.012, low - 0.9 * r, 1.1 * half, m.number(0.07, 0.1)))
    barrel = "barrel" if style == "break" else BASE
    n = max(8, k.n)
    m.add(
        barrel,
        m.pick(rod((0, -0.01, bore), (0, -0.01 - long, bore), b, n), box((-b, b), (-0.01 - long, -0.01), (bore - b, bore + b))),
    )
    if m.chance(0.6):
        m.add(barrel, box((-0.6 * b, 0.6 * b), (-0.01 - m.pick(0.6, 0.95) * long, -0.01), (bore - 2.1 * b, bore - 0.5 * b)))
    if m.chance(0.7):
        m.add(barrel, box((-0.0015, 0.0015), (-long, -0.88 * long), (bore + 0.5 * b, bore + 2.2 * b)))
    center = low + 0.26 * r
    if style == "break":
        m.add("barrel", box((-0.4 * half, 0.4 * half), (-0.02, drum + 0.004), (top - 0.005, top + 0.001)))
        m.add("barrel", box((-0.8 * half, 0.8 * half), (-0.026, -0.0125), (low - r + 0.0052, top + 0.001)))
        m.hinge("barrel", (0, -0.013, low - 0.8 * r), (1, 0, 0), m.pick(50, 80))
    _drum(m, k, style, center, drum, r, shots)
    _hammer(m, drum + 0.026, top, half)
    trigger(m, drum - 0.004, low - r, half)
    if style == "solid" and m.chance(0.6):
        m.add("gate", box((half, half + 0.004), (drum + 0.004, drum + 0.016), (center - 0.012, center + 0.012)))
        m.hinge("gate", (half + 0.002, drum + 0.01, center - 0.012), (0, 1, 0), 80)
        m.add(BASE, rod((half - 0.001, drum + 0.01, center - 0.013), (half + 0.005, drum + 0.01, center - 0.013), 0.002, 6))


def _drum(m: Model, k: Look, style: str, z: float, drum: float, r: float, shots: int) -> None:
    """The drum with chambers or flutes, on a crane, and its ejector."""
    n = max(12, k.n)
    solid = rod((0, 0.001, z), (0, drum, z), r, n)
    turn = 2 * np.pi * np.arange(shots) / shots
    if k.style not in ("low", "sheet"):
        flutes = [
            rod(
                (1.05 * r * np.sin(a), -1, z + 1.05 * r * np.cos(a)),
                (1.05 * r * np.sin(a), 0.6 * drum, z + 1.05 * r * np.cos(a)),
                0.24 * r,
                8,
            )
            for a in turn + np.pi / shots
        ]
        holes = [
            rod(
                (0.6 * r * np.sin(a), -1, z + 0.6 * r * np.cos(a)),
                (0.6 * r * np.sin(a), 1, z + 0.6 * r * np.cos(a)),
                0.2 * r,
                8,
            )
            for a in turn
        ]
        solid = cut(solid, *flutes, *holes)
    m.add("cylinder", solid)
    parent = {"crane": "crane", "break": "barrel", "solid": BASE}[style]
    if style == "crane":
        low = z - 0.85 * r
        m.add(
            "crane",
            box((-0.004, 0.004), (-0.0105, -0.0005), (low - 0.003, z + 0.004)),
            rod((0, -0.0105, z), (0, 0.4 * drum, z), 0.15 * r, 8),
        )
        m.hinge("crane", (0, -0.005, low - 0.004), (0, -1, 0), m.pick(70, 90))
        if m.chance(0.6):
            m.add("ejector", rod((0, -0.035, z), (0, -0.0095, z), 0.0022, 8), rod((0, -0.037, z), (0, -0.033, z), 0.0034, 8))
            m.slide("ejector", (0, 1, 0), 0.018, "crane")
    else:
        m.add(parent, rod((0, -0.012, z), (0, drum * 0.5, z), 0.12 * r, 8))
    m.spin("cylinder", (0, 0, z), (0, 1, 0), parent)


def _hammer(m: Model, y: float, z: float, half: float) -> None:
    """A hammer with a spur behind the frame."""
    shape = LineString([(y, z - 0.016), (y + 0.008, z + 0.004)]).buffer(0.004, quad_segs=2)
    shape = shape.union(LineString([(y + 0.008, z + 0.004), (y + 0.022, z + m.pick(0.002, 0.009))]).buffer(0.0022, quad_segs=2))
    m.add("hammer", prism(shape, "x", (-0.3 * half, 0.3 * half)))
    m.hinge("hammer", (0, y, z - 0.016), (-1, 0, 0), m.pick(35, 50))
