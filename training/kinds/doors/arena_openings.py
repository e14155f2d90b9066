"""A sliding blast door, a science fiction crate and a treasure coffer of one artist."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon
from trimesh import Trimesh

from training.kinds.arena_style import Look, boards, look, shell
from training.kinds.model import BASE, Model
from training.kinds.solids import arch, box, cut, prism, rectangle, ring, rod, vec


def sliding_blast_door(m: Model) -> None:
    """One or two armoured leaves that slide apart into pockets or behind a frame, with a seam of some shape."""
    k, upright = look(m), m.chance(0.35)
    half, high, t = m.number(0.6, 1.2), m.number(2.0, 2.8), m.number(0.06, 0.16)
    if upright:
        half, high = high / 2, 2 * half
    single, g = m.chance(0.4), abs(m.gap(0.3))
    over = m.number(0.02, 0.06)
    seam = _seam(m, high)
    sides = [(-half - over, half + over)] if single else [(-half - over, -g / 2), (g / 2, half + over)]
    pocket = upright or m.chance(0.6)
    y = (-t / 2, t / 2) if pocket else (0.2, 0.2 + t)
    for i, (a, b) in enumerate(sides):
        way = (1 if m.chance(0.5) or upright else -1) if single else 2 * i - 1
        outline = [(a, -over), (b, -over), (b, high + over), (a, high + over)]
        if not single:
            edge = [(s + (i - 0.5) * g, z) for s, z in seam]
            ends = [(a if i == 0 else b, high + over), (a if i == 0 else b, -over)]
            outline = edge + ends
        name = "door" if single else f"door_{i}"
        m.add(name, *(_stood(s, upright, half, high) for s in _leaf(m, k, outline, y)))
        axis = vec(0, 0, way) if upright else vec(way, 0, 0)
        m.slide(name, axis, (2 * half if single else half) * m.pick(0.9, 0.97))
    m.add(BASE, *(_stood(s, upright, half, high) for s in _wall(m, k, half, high, over, t, pocket, single)))


def _seam(m: Model, high: float) -> list[tuple[float, float]]:
    """Where two leaves meet, from below to above as (along, up)."""
    d = m.number(0.06, 0.2)
    low, top = -0.07, high + 0.07
    return m.pick(
        [(0, low), (0, top)],
        [(0, low), (0, 0.3 * high), (d, 0.4 * high), (d, 0.6 * high), (0, 0.7 * high), (0, top)],
        [(-d, low), (d, top)],
        [(0, low), *((d * (-1) ** i, high * (0.1 + 0.16 * i)) for i in range(6)), (0, top)],
        [(d, low), (d, 0.5 * high), (-d, 0.5 * high), (-d, top)],
    )


def _leaf(m: Model, k: Look, outline: list[tuple[float, float]], y: tuple[float, float]) -> list[Trimesh]:
    shape = Polygon(outline)
    t = y[1] - y[0]
    found = k.panel(shape, "y", (y[1], y[0])) if k.style != "sheet" or m.chance(0.5) else [prism(shape, "y", y)]
    left, low, right, high = shape.bounds
    bars = m.pick(0, 0, 2, 3)
    for z in np.linspace(low, high, bars + 2)[1:-1]:
        band = shape.buffer(-0.1, join_style="mitre").intersection(rectangle((left, right), (z - 0.05, z + 0.05)))
        if band.geom_type == "Polygon" and not band.is_empty:
            found.append(prism(band, "y", (y[0] - 0.1 * t, y[0] + 0.5 * t)))
    if m.chance(0.3):
        spot = shape.representative_point()
        found.append(rod((spot.x, y[0] - 0.1 * t, spot.y), (spot.x, y[1], spot.y), 0.12, max(10, k.n)))
    return found


def _wall(m: Model, k: Look, half: float, high: float, over: float, t: float, pocket: bool, single: bool) -> list[Trimesh]:
    """The frame: two skins with an opening, or a portal in front of the leaves; trims and a panel of keys."""
    jamb = 2.1 * half + 0.15 if single and pocket else (1.15 * half if pocket else m.number(0.2, 0.5))
    a, b = (-half - jamb, half + jamb), (-over - 0.12, high + m.number(0.15, 0.4))
    hole = rectangle((-half, half), (0, high))
    front = rectangle(a, b).difference(hole)
    found = []
    if pocket:
        s = t / 2 + 0.008
        skin = m.number(0.03, 0.1)
        found += [prism(front, "y", (-s - skin, -s)), prism(front, "y", (s, s + skin))]
        found += [box(a, (-s, s), (b[0], -over - 0.002)), box(a, (-s, s), (high + over + 0.002, b[1]))]
        face = -s - skin
    else:
        far = half * (1.7 if single else 0.8)
        found += [prism(front, "y", (-0.1, 0.198))]
        found += [box((a[0] - far, a[1] + far), (0.15, 0.25 + t), (high + over + 0.003, b[1] + 0.02))]
        face = -0.1
    trim = hole.buffer(m.number(0.06, 0.12), join_style="mitre").difference(hole)
    if m.chance(0.6) and k.style != "sheet":
        found.append(prism(trim, "y", (face - 0.05, face)))
        found += [prism(trim, "y", (-face, 0.05 - face))] if pocket else []
    if m.chance(0.5):
        x, z = half + 0.2, 0.5 * high
        found += k.plate((x, x + 0.14), (face - 0.03, face), (z, z + 0.22), "-y")
        found += [box((x + 0.02 + 0.04 * i, x + 0.05 + 0.04 * i), (face - 0.036, face), (z + 0.02, z + 0.05)) for i in range(3)]
    if m.chance(0.4):
        found.append(box((-0.3 * half, 0.3 * half), (face - 0.04, face), (high + 0.01, high + 0.09)))
    return found


def _stood(solid: Trimesh, upright: bool, half: float, high: float) -> Trimesh:
    """A door that slides along x, or the same stood on end with its height across."""
    if upright:
        x, y, z = solid.vertices.T
        solid.vertices = np.c_[high / 2 - z, y, half + x]
    return solid


def sci_fi_crate(m: Model) -> None:
    """A crate with a lid, a pair of top flaps, a side flap or a sliding top; latches, ribs, perhaps folding handles."""
    k, style = look(m), m.pick("lid", "flaps", "side", "slide")
    w, d, h = m.number(0.3, 0.7), m.number(0.25, 0.5), m.number(0.22, 0.6)
    t = m.number(0.02, 0.04)
    x, y = (-w, w), (-d, d)
    walls = rectangle(x, y, t)
    front = style == "side"
    g = abs(m.gap(0.1)) + 0.001
    if k.style == "sheet":
        m.add(BASE, shell(x, y, (0, h), "-y" if front else "+z"))
    elif front:
        m.add(BASE, *boards(x, y, (0, h), t)[:4], box((-w + t, w - t), (d - t, d), (t, h - t)))
    else:
        m.add(BASE, prism(walls, "z", (t, h)), box(x, y, (0, t)))
    m.add(BASE, *_ribs(m, k, w, d, h, t, front))
    if style == "lid":
        top = m.number(0.05, 0.15)
        m.add("lid", *k.body(x, y, (h + g, h + g + top), "-z"))
        m.hinge("lid", (0, d, h + g), (-1, 0, 0), m.pick(80, 100, 110))
        if k.style == "cad":
            m.add(
                BASE,
                *(rod((s * w * 0.6 - 0.04, d + 0.004, h), (s * w * 0.6 + 0.04, d + 0.004, h), 0.008, k.n) for s in (-1, 1)),
            )
        _latches(m, k, w, d, h + g)
    elif style == "flaps":
        for s, name in ((-1, "flap_left"), (1, "flap_right")):
            m.add(name, *k.plate((s * g, s * w), y, (h + g, h + g + t), "+z"))
            m.hinge(name, (s * w, 0, h + g), (0, s, 0), m.pick(90, 120, 170))
    elif style == "slide":
        m.add("lid", *k.plate(x, y, (h + g, h + g + t), "+z"), box((-0.3 * w, 0.3 * w), (-d, -d + 0.03), (h + t, h + 2 * t)))
        m.slide("lid", m.pick((0, -1, 0), (0, 1, 0)), 1.6 * d)
    else:
        m.add("flap", *k.plate((-w + t + g, w - t - g), (-d, -d + t), (t + g, h - t - g), "-y"))
        m.add("flap", box((-0.2 * w, 0.2 * w), (-d - 0.02, -d + 0.01), (0.7 * h, 0.75 * h)))
        m.hinge("flap", (0, -d, t + g), (1, 0, 0), m.pick(90, 85))
        if m.chance(0.5):
            m.add(BASE, box((-w + t, w - t), (-d + 0.1, d - t), (0.5 * h, 0.5 * h + 0.012)))


def _ribs(m: Model, k: Look, w: float, d: float, h: float, t: float, front: bool) -> list[Trimesh]:
    """Corner posts, ribs, feet and plates that only look like parts."""
    found = []
    e = 0.3 * t
    if m.chance(0.7):
        c = t if front else m.number(0.05, 0.1)
        found += [
            box(
                (sx * (w - c), sx * (w + e)),
                (d + e, d - c) if sy > 0 else (-d - e, -d + t),
                (-0.02, m.pick(h, 0.2 * h) - 0.001),
            )
            for sx in (-1, 1)
            for sy in (-1, 1)
        ]
    if m.chance(0.5):
        found += [
            box((s * w, s * (w + e)), (q * d - 0.03, q * d + 0.03), (0.05 * h, 0.95 * h)) for s in (-1, 1) for q in (-0.4, 0.4)
        ]
    if m.chance(0.5):
        found += [
            p
            for s in "+-"
            for p in k.plate((w, w + 0.012) if s == "+" else (-w - 0.012, -w), (-0.3 * d, 0.3 * d), (0.3 * h, 0.6 * h), s + "x")
        ]
    return found


def _latches(m: Model, k: Look, w: float, d: float, h: float) -> None:
    for i, q in enumerate(m.pick((-0.5, 0.5), (-0.6, 0.0, 0.6), (0.0,), ())):
        x = (q * w - 0.03, q * w + 0.03)
        m.add(BASE, box(x, (-d - 0.012, -d), (h - 0.09, h - 0.07)))
        m.add(f"latch_{i}", *k.plate(x, (-d - 0.016, -d - 0.001), (h - 0.069, h + 0.03), "-y"))
        m.hinge(f"latch_{i}", (q * w, -d - 0.008, h - 0.069), (1, 0, 0), m.pick(60, 90, 120))


def treasure_coffer(m: Model) -> None:
    """A coffer with an arched, flat, hipped or faceted lid, bands, a hasp and drop handles; perhaps coins inside."""
    k = look(m)
    w, d, h = m.number(0.28, 0.5), m.number(0.16, 0.26), m.number(0.2, 0.36)
    t, g = m.number(0.012, 0.025), abs(m.gap(0.08))
    if k.style == "sheet":
        m.add(BASE, shell((-w, w), (-d, d), (0, h), "+z"))
    elif k.style == "cut":
        m.add(BASE, cut(box((-w, w), (-d, d), (0, h)), box((t - w, w - t), (t - d, d - t), (t, 1))))
    else:
        m.add(BASE, *boards((-w, w), (-d, d), (0, h + t), t)[2:], box((-w, w), (-d, d), (0, t)))
    z = h + g
    rise = m.number(0.5, 1.0) * d
    shape = m.pick(
        arch((-d, d), (z, z + 0.02 + rise), rise, m.pick(5, 8, 16)),
        Polygon([(-d, z), (d, z), (d, z + 0.06), (-d, z + 0.06)]),
        Polygon([(-d, z), (d, z), (d, z + 0.04), (0.4 * d, z + rise), (-0.4 * d, z + rise), (-d, z + 0.04)]),
    )
    inside = shape.buffer(-t, join_style="mitre").union(rectangle((t - d, d - t), (z - 0.01, z + 1.5 * t)))
    hollow = m.chance(0.5) and k.style != "low"
    m.add("lid", prism(shape.difference(inside) if hollow else shape, "x", (-w, w)))
    if hollow:
        m.add("lid", *(prism(shape, "x", (s * w, s * (w + t))) for s in (-1, 1)))
    m.hinge("lid", (0, d, z), (-1, 0, 0), m.pick(75, 95, 110))
    band = shape.buffer(0.007, join_style="mitre").intersection(rectangle((-1, 1), (z, 9))).difference(shape.buffer(-0.002))
    for q in m.pick((-0.6, 0.6), (-0.85, 0.0, 0.85), (-0.9, 0.9), ()):
        b = (q * w - 0.02, q * w + 0.02)
        m.add("lid", prism(band, "x", b))
        m.add(BASE, box(b, (-d - 0.007, -d + 0.002), (0, h)), box(b, (d - 0.002, d + 0.007), (0, h)))
    _coffer_trims(m, k, w, d, h, t)


def _coffer_trims(m: Model, k: Look, w: float, d: float, h: float, t: float) -> None:
    """Hasp and lock, drop handles at the ends, a tray, feet."""
    if m.chance(0.6):
        m.add(BASE, *k.plate((-0.04, 0.04), (-d - 0.014, -d), (0.55 * h, 0.85 * h), "-y"))
        m.add("hasp", box((-0.018, 0.018), (-d - 0.021, -d - 0.0145), (0.62 * h, h + 0.02)))
        m.hinge("hasp", (0, -d - 0.014, h + 0.02), (-1, 0, 0), m.pick(70, 100), "lid")
        m.add("lid", rod((-0.03, -d - 0.013, h + 0.022), (0.03, -d - 0.013, h + 0.022), 0.013, 8))
    if m.chance(0.6):
        for s, name in ((-1, "handle_left"), (1, "handle_right")):
            r = 0.2 * d
            m.add(name, ring((s * (w + t + 0.012), 0, 0.65 * h - r), (1, 0, 0), r, 0.006, 16))
            m.hinge(name, (s * (w + t + 0.012), 0, 0.65 * h), (0, -s, 0), 80)
            m.add(BASE, rod((s * w, 0, 0.65 * h), (s * (w + t + 0.022), 0, 0.65 * h), 0.012, 8))
    if m.chance(0.4):
        m.add(BASE, box((t - w, w - t), (t - d, d - t), (t, m.number(0.5, 0.8) * h)))
    if m.chance(0.5):
        m.add(BASE, *(box((s * w, s * (w - 0.06)), (q * d, q * (d - 0.06)), (-0.04, 0)) for s in (-1, 1) for q in (-1, 1)))
