"""Small gadgets of one artist: folding fans, key ring knives, egg timers."""

from __future__ import annotations

import numpy as np
from shapely import affinity
from shapely.geometry import Point as Dot
from shapely.geometry import Polygon

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, turned, vec
from training.kinds.trinket_style import Look, bevelled, draw_look, oriented, outline, pebble, ribs, sheet, shell, slab, spun


def folding_hand_fan(m: Model) -> None:
    """Sticks on one rivet, spread out or closed, bare like blades or each with its fold of the leaf."""
    look = draw_look(m)
    count, long, w = m.pick(7, 9, 11, 14), m.number(0.18, 0.26), m.number(0.008, 0.014)
    thick, opened = m.number(0.0008, 0.002), m.chance(0.7)
    spread = m.number(120, 175)
    step = spread / (count - 1)
    begin = -spread / 2 if opened else m.pick(-90.0, 0.0, -60.0)
    bare = m.chance(0.4)
    leaf = m.number(0.4, 0.62) * long
    for k in range(count):
        part, guard = f"stick_{k}" if k else BASE, k in (0, count - 1)
        z = (k * thick, (k + 0.92) * thick)
        grow = 1.6 if guard and look.style not in ("sheet", "blocky") else 1.0
        tip = w * grow * (m.number(1.6, 2.0) if bare and not guard else 1.0) if k == 0 or not bare else 2.6 * w
        solids = [prism(_stick(w * grow, tip, long, bare and look.style in ("soft", "old", "hollowed")), "z", z)]
        if not bare and k:
            t = np.deg2rad(90 + np.linspace(-step, 0, 3 if look.plain else 5))
            arc = np.c_[np.cos(t), np.sin(t)]
            low = z[0] + 0.35 * thick
            shape = Polygon(np.concatenate([0.98 * long * arc, (long - leaf) * arc[::-1]]))
            solids.append(sheet(shape, low) if look.style == "sheet" else prism(shape, "z", (low, low + 0.25 * thick)))
        if bare and look.style == "hollowed" and not guard:
            solids[0] = cut(solids[0], *(rod((0, a * long, -1), (0, a * long, 1), 0.3 * w, 8) for a in (0.5, 0.65, 0.8)))
        if guard and look.style == "old":
            solids += [
                rod((0, a * long, z[0]), (0, a * long, z[1] + (0.5 * thick if k else 0)), 0.45 * w, 8) for a in (0.4, 0.7)
            ]
        m.add(part, *(turned(s, (0, 0, 1), begin + (k * step if opened else 0.0), (0, 0, 0)) for s in solids))
        if k:
            m.hinge(part, (0, 0, z[0]), (0, 0, 1), (-k * step, 0.0) if opened else k * step)
    m.add(BASE, rod((0, 0, -thick), (0, 0, (count + 0.6) * thick), 0.3 * w, 12))
    if m.chance(0.5):
        m.add(BASE, ring((0, -0.035 * long - 0.3 * w, 0), (1, 0, 0), 0.03 * long + 0.25 * w, 0.08 * w, 12))
    if m.chance(0.5):
        m.add(BASE, *(rod((0, 0, z), (0, 0, z + 0.5 * thick), 0.55 * w, 12) for z in (-thick, (count + 0.1) * thick)))


def _stick(w: float, tip: float, long: float, petal: bool) -> Polygon:
    """A stick along y from behind the rivet to its end, straight or widening to a petal."""
    if petal:
        half = [(0.5 * w, -0.05 * long), (0.35 * w, 0.3 * long), (0.5 * tip, 0.75 * long), (0.4 * tip, 0.95 * long)]
    else:
        half = [(0.5 * w, -0.05 * long), (0.5 * w, 0.05 * long), (0.5 * tip, 0.97 * long)]
    return Polygon([*half, (0, long), *((-a, b) for a, b in half[::-1])])


def key_ring_knife(m: Model) -> None:
    """A small knife for a key ring: blades that lie in the body, a ring that swings, perhaps things that are pulled out."""
    look = draw_look(m)
    long, w, count = m.number(0.05, 0.085), m.number(0.013, 0.02), m.pick(1, 2, 3, 4)
    layer, scale = m.number(0.0015, 0.0025), m.number(0.0015, 0.0035)
    outer = count * layer + 2 * scale
    ends = _scale(m, look, long, w)
    for z in ((0, scale), (outer - scale, outer)):
        m.add(BASE, bevelled(ends, z, 0.3) if look.style == "soft" else prism(ends, "z", z))
    spine = Polygon(ends).intersection(Polygon([(-long, -w), (long, -w), (long, -0.28 * w), (-long, -0.28 * w)]))
    m.add(BASE, prism(spine, "z", (scale, outer - scale)))
    pins = [(s * (long / 2 - 0.32 * w), 0.05 * w) for s in (-1, 1)]
    m.add(BASE, *(rod((x, y, -0.0004), (x, y, outer + 0.0004), 0.12 * w, 10) for x, y in pins))
    angle, drawn = m.pick(150, 180, 180), m.chance(0.3)
    for k in range(count):
        side = 1 if k % 2 == 0 else -1
        z = scale + k * layer
        name, kind = f"blade_{k}", m.pick("blade", "file", "opener", "hook") if k else "blade"
        reach = long - 0.66 * w - 0.3 * w
        shape = affinity.scale(_blade(kind, reach, w), side, 1, origin=(0, 0))
        x, y = pins[0] if side > 0 else pins[1]
        solid = prism(affinity.translate(shape, x, y), "z", (z + 0.06 * layer, z + 0.94 * layer))
        hole = rod((x, y, -1), (x, y, 1), 0.11 * w, 10)
        solid = cut(solid, hole) if look.style in ("assembly", "hollowed") else solid
        out = drawn and k < 2
        m.add(name, turned(solid, (0, 0, side), angle if out else 0, (x, y, 0)))
        m.hinge(name, (x, y, z + layer / 2), (0, 0, side), (-angle, 0.0) if out else angle)
    if m.chance(0.4) and not look.plain:
        z = outer - 0.5 * scale
        part = m.pick("tweezers", "toothpick")
        m.add(part, box((0.1 * long, 0.5 * long + 0.002), (-0.42 * w, -0.32 * w), (z, z + 0.7 * scale)))
        m.slide(part, (1, 0, 0), 0.35 * long)
    if look.style in ("soft", "old", "hollowed"):
        m.add(BASE, prism(_shield(0.22 * w), "z", (outer - 0.1 * scale, outer + 0.0003)))
    if m.chance(0.85):
        r, x, z = m.number(0.45, 0.8) * w, -long / 2 - 0.12 * w, outer / 2
        m.add(
            BASE,
            cut(
                rod((x, -0.36 * w, z - 0.6 * layer), (x, -0.36 * w, z + 0.6 * layer), 0.26 * w, 14),
                rod((x, -0.36 * w, -1), (x, -0.36 * w, 1), 0.14 * w, 10),
            ),
        )
        m.add("ring", ring((x - r, -0.36 * w, z), (0, 1, 0), r, 0.05 * w, 16 if look.plain else 28))
        m.hinge("ring", (x - 0.05 * w, -0.36 * w, z), (0, 1, 0), (-80, 80))


def _scale(m: Model, look: Look, long: float, w: float) -> Polygon:
    """The outline of the body: a bar with round ends, one that widens, or one with a waist."""
    shape = rounded((-long / 2, long / 2), (-w / 2, w / 2), m.pick(0.15, 0.3, 0.49) * w, 3 if look.plain else 8)
    kind = m.pick("bar", "bar", "drop", "waist")
    if kind == "drop":
        return shape.union(Dot(0.5 * long - 0.4 * w, 0).buffer(0.62 * w, quad_segs=4 if look.plain else 10)).convex_hull
    if kind == "waist":
        ends = [Dot(s * (0.5 * long - 0.3 * w), 0).buffer(0.6 * w, quad_segs=4 if look.plain else 10) for s in (-1, 1)]
        return shape.union(ends[0]).union(ends[1])
    return shape


def _blade(kind: str, reach: float, w: float) -> Polygon:
    """The outline of a blade that lies along x, its pin at the origin."""
    tang = Dot(0, 0).buffer(0.26 * w, quad_segs=4)
    up, low = 0.36 * w, -0.24 * w
    if kind == "blade":
        shape = [(0, low), (0.9 * reach, low), (reach, 0.0), (0.75 * reach, 0.9 * up), (0.2 * reach, up), (0, 0.2 * w)]
    elif kind == "file":
        shape = [(0, low), (0.95 * reach, low), (reach, -0.05 * w), (0.9 * reach, 0.2 * w), (0, 0.2 * w)]
    elif kind == "opener":
        shape = [
            (0, low),
            (0.6 * reach, low),
            (0.6 * reach, up),
            (0.5 * reach, up),
            (0.42 * reach, 0.05 * w),
            (0.3 * reach, up),
            (0, 0.2 * w),
        ]
    else:
        shape = [(0, low), (0.5 * reach, low), (0.55 * reach, up), (0.48 * reach, up), (0.4 * reach, 0.0), (0, 0.2 * w)]
    return tang.union(Polygon(shape))


def _shield(r: float) -> Polygon:
    return Polygon([(-r, r), (r, r), (0.9 * r, -0.2 * r), (0, -r), (-0.9 * r, -0.2 * r)])


def egg_timer(m: Model) -> None:
    """An egg whose upper half is turned, a dial in front of a case or of a disc on a foot, or a screen with buttons."""
    look = draw_look(m)
    r, kind = m.number(0.025, 0.04), m.pick("egg", "case", "disc", "egg", "digital")
    line = outline(max(look.n, 10))
    if kind == "digital":
        _digital_timer(m, look, r)
        return
    if kind == "egg":
        split, top = m.number(0.8, 1.1) * r, m.number(2.3, 2.9) * r
        gap, t = 0.015 * r, np.linspace(0, np.pi / 2, 5 if look.style == "blocky" else 8)
        lower = np.c_[r * np.sin(t), (split - gap) * (1 - np.cos(t))]
        upper = np.c_[r * np.cos(t), split + (top - split) * np.sin(t)]
        lower[1:, 0] = np.maximum(lower[1:, 0], 0.5 * r)
        upper[-1, 0] = 0.0
        m.add(BASE, shell(look, lower, 0.06 * r, line))
        m.add("dial", shell(look, upper, 0.06 * r, line, down=True))
        if not look.plain:
            m.add(BASE, rod((0, 0, 0.2 * r), (0, 0, split + 0.3 * r), 0.75 * r, look.n))
            m.add("dial", *ribs(m.pick(12, 24), 0.995 * r, (split + 0.02 * r, split + 0.15 * r), 0.02 * r))
        m.add(BASE, box((-0.06 * r, 0.06 * r), (-1.04 * r, -0.9 * r), (split - 0.3 * r, split - 2 * gap)))
        m.spin("dial", (0, 0, (split + top) / 2), (0, 0, 1))
        return
    z, deep = 1.25 * r, m.number(0.5, 0.9) * r
    _timer_body(m, look, kind, r, z, deep)
    face, high = 0.75 * r, m.number(0.25, 0.5) * r
    front = -deep - 0.03 * r
    solids = [spun([(0, 0), (face, 0), (0.92 * face, 0.3 * high), (0, 0.3 * high)], line)]
    if m.chance(0.6):
        solids.append(box((-0.12 * face, 0.12 * face), (-0.85 * face, 0.85 * face), (0.2 * high, high)))
    else:
        solids += [
            rod((0, 0, 0.2 * high), (0, 0, high), 0.5 * face, look.n),
            *ribs(16, 0.5 * face, (0.3 * high, 0.95 * high), 0.03 * face),
        ]
        solids.append(box((-0.04 * face, 0.04 * face), (0.3 * face, 0.52 * face), (0.9 * high, 1.08 * high)))
    m.add("dial", *(oriented(s, (0, -1, 0), (0, front, z)) for s in solids))
    m.spin("dial", (0, front, z), (0, -1, 0))
    m.add(BASE, rod((0, front - 0.02 * r, z), (0, -0.5 * deep, z), 0.15 * r, 10))
    if not look.plain:
        for t in 2 * np.pi * np.arange(12) / 12:
            c, s = 0.88 * r * np.sin(t), 0.88 * r * np.cos(t)
            m.add(BASE, rod((c, front - 0.005 * r, z + s), (c, -0.95 * deep, z + s), 0.035 * r, 6))


def _timer_body(m: Model, look: Look, kind: str, r: float, z: float, deep: float) -> None:
    """A case or a disc on a foot behind the dial; perhaps with bells, feet and a plate."""
    wide = m.number(1.0, 1.5) * r
    if kind == "case":
        if look.style == "soft":
            m.add(BASE, pebble((-wide, wide), (-deep, deep), (0, 2.4 * r), 6))
            m.add(BASE, rod((0, -1.02 * deep, z), (0, 0, z), 0.98 * r, 28))
        else:
            radius = m.pick(0.02, 0.3) * r
            m.add(BASE, prism(rounded((-wide, wide), (0, 2.4 * r), radius, 2 if look.plain else 6), "y", (-deep, deep)))
        m.add(BASE, rod((0, -deep - 0.03 * r, z), (0, 0, z), 0.98 * r, max(look.n, 12)))
        return
    m.add(BASE, rod((0, -deep - 0.03 * r, z), (0, 0.3 * deep, z), 1.02 * r, max(look.n, 12)))
    m.add(BASE, *slab(look, (-0.8 * r, 0.8 * r), (-deep, deep), (0, 0.12 * r), 0.15 * r))
    m.add(BASE, box((-0.25 * r, 0.25 * r), (-0.3 * deep, 0.2 * deep), (0.08 * r, 0.5 * r)))
    if m.chance(0.5):
        for s in (-1, 1):
            at = vec(s * 0.6 * r, -0.3 * deep, z + 0.95 * r)
            m.add(BASE, ball(at, (0.35 * r, 0.35 * r, 0.28 * r), 10), rod(at, at - vec(s * 0.1 * r, 0, 0.4 * r), 0.05 * r, 6))


def _digital_timer(m: Model, look: Look, r: float) -> None:
    """A flat case that leans on a foot behind it, with a screen and buttons that are pressed in."""
    wide, high, deep = m.number(1.0, 1.5) * r, m.number(1.8, 2.6) * r, m.number(0.2, 0.35) * r
    body = rounded((-wide, wide), (0, high), 0.2 * r, 2 if look.plain else 6)
    screen = rounded((-0.8 * wide, 0.8 * wide), (0.55 * high, 0.9 * high), 0.06 * r, 2)
    solid = prism(body, "y", (-deep, deep))
    if look.style in ("hollowed", "assembly"):
        solid = cut(solid, prism(screen.buffer(0.02 * r), "y", (-2 * deep, -0.8 * deep)))
    m.add(BASE, solid, prism(screen, "y", (-0.9 * deep if look.style == "hollowed" else -1.05 * deep, -0.5 * deep)))
    count, size = m.pick(2, 3, 4), m.number(0.14, 0.2) * r
    for k in range(count):
        x, z = 1.5 * wide * ((k + 0.5) / count - 0.5), 0.28 * high
        if look.plain or m.chance(0.2):
            button = box((x - size, x + size), (-1.35 * deep, -0.8 * deep), (z - size, z + size))
        else:
            button = rod((x, -1.35 * deep, z), (x, -0.8 * deep, z), size, look.n)
        m.add(f"button_{k}", button)
        m.slide(f"button_{k}", (0, 1, 0), 0.25 * deep)
    if m.chance(0.6):
        top = 0.6 * high
        m.add("foot", box((-0.4 * wide, 0.4 * wide), (deep + 0.0002, 1.25 * deep), (0.08 * high, top)))
        m.add(BASE, rod((-0.45 * wide, 1.1 * deep, top), (0.45 * wide, 1.1 * deep, top), 0.15 * deep, 8))
        m.hinge("foot", (0, 1.1 * deep, top), (1, 0, 0), m.pick(30, 45))
