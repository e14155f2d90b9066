"""Cars, trucks and buses: sides with doors cut out of one outline, wheels, bonnets, tailgates, tipping beds."""

from __future__ import annotations

import itertools

import numpy as np
from shapely.affinity import translate
from shapely.geometry import MultiPolygon, Point, Polygon
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, prism, rectangle, rod
from training.kinds.wheels import axled, beam, wheel_maker


def prisms(outline: Polygon | MultiPolygon, axis: str, depth: Span) -> list[Trimesh]:
    """Push every piece of an outline along an axis; slivers are left out."""
    pieces = getattr(outline, "geoms", [outline])
    return [prism(p, axis, depth) for p in pieces if p.geom_type == "Polygon" and p.area > 1e-6]


def skin(outline: Polygon, thick: float, y: Span) -> Polygon:
    """The upper layer of a side outline between two y."""
    layer = outline.difference(translate(outline, 0, -thick)).intersection(rectangle(y, (-9, 9)))
    return max(getattr(layer, "geoms", [layer]), key=lambda p: p.area)


def side_door(m: Model, part: str, outline: Polygon, side: int, x: float, thick: float, window: Polygon | None, slides: bool):
    """A door in the side of a vehicle: hinged at its front edge, or sliding to the rear; x: the outer face, positive."""
    low_y, low_z, high_y, high_z = outline.bounds
    faces = sorted((side * x, side * (x - thick)))
    m.add(part, *prisms(outline.difference(window) if window else outline, "x", (faces[0], faces[1])))
    if window and m.chance(0.6):
        m.add(part, *prisms(window.buffer(0.003), "x", (side * (x - 0.6 * thick), side * (x - 0.4 * thick))))
    at = high_y - 0.18 * (high_y - low_y), low_z + 0.52 * (high_z - low_z)
    style = m.pick("bar", "none", "box")
    if style == "bar":
        m.add(part, beam((side * (x + 0.03), at[0] - 0.08, at[1]), (side * (x + 0.03), at[0] + 0.08, at[1]), 0.02, 0.02))
        m.add(part, *(rod((side * x, at[0] + c, at[1]), (side * (x + 0.03), at[0] + c, at[1]), 0.01, 6) for c in (-0.06, 0.06)))
    elif style == "box":
        m.add(part, box((side * x, side * (x + 0.02)), (at[0] - 0.1, at[0] + 0.05), (at[1] - 0.02, at[1] + 0.02)))
    if slides:
        m.slide(part, (0, 1, 0), 0.9 * (high_y - low_y))
    else:
        m.hinge(
            part, (side * (x - m.pick(0.0, 0.5, 1.0) * thick), low_y, middle((low_z, high_z))), (0, 0, -side), m.pick(60, 75)
        )


def mirrors_lights(m: Model, half: float, y: Span, z: float, mirror: tuple[float, float]) -> None:
    """Fixed things on a body: lamps, bumpers, number plates, mirrors."""
    for side in (-1, 1):
        if m.chance(0.8):
            m.add(BASE, ball((side * (half - 0.2), y[0], z), (0.1, 0.05, 0.08), m.sections()))
        if m.chance(0.7):
            m.add(BASE, box((side * (half - 0.3), side * (half - 0.05)), (y[1] - 0.02, y[1] + 0.015), (z - 0.05, z + 0.08)))
        if m.chance(0.7):
            m.add(
                BASE,
                box((side * half, side * (half + 0.16)), (mirror[0] - 0.04, mirror[0] + 0.04), (mirror[1], mirror[1] + 0.1)),
            )
    if m.chance(0.6):
        for at in y:
            m.add(BASE, box((-half - 0.01, half + 0.01), (at - 0.07, at + 0.07), (0.28, 0.45)))


def vehicle(m: Model, top: list, half: float, axles: tuple[float, float], radius: float, doors: list, lids: list) -> Polygon:
    """Build a body from the line over its roof, front to rear; doors: (y span, window or not), lids: (y span, hinge end)."""
    low, board, n = 0.6 * radius, m.pick(0.04, 0.06, 0.1), m.pick(8, 12, 20)
    outline = Polygon([(top[0][0], low), *top, (top[-1][0], low)])
    arches = [Point(y, radius).buffer(1.18 * radius, quad_segs=n // 2) for y in axles]
    body = outline.difference(arches[0]).difference(arches[1])
    gap, hollow = abs(m.gap(0.8)), m.chance(0.5)
    waist = 0.5 * (radius * 2 + max(z for _, z in top))
    panels, layer = [], 0.05
    for k, (y, glass, slides) in enumerate(doors):
        inner = body.intersection(rectangle(y, (low + 0.1, 9))).intersection(outline.buffer(-0.06))
        inner = max(getattr(inner, "geoms", [inner]), key=lambda p: p.area)
        window = inner.buffer(-0.06).intersection(rectangle((-99, 99), (waist, 9))) if glass else None
        window = None if window is None or window.is_empty or window.geom_type != "Polygon" else window
        panels.append(inner)
        for side in (-1, 1):
            name = f"door_{k}_{'lr'[side > 0]}"
            side_door(m, name, inner.buffer(-gap, join_style=2), side, half + (m.pick(0.0, 0.01)), board, window, slides)
    strips = [skin(outline, layer, y) for y, _ in lids]
    core = body
    for k, ((y, hinged), strip) in enumerate(zip(lids, strips, strict=True)):
        core = core.difference(strip)
        m.add(f"lid_{k}", *prisms(strip.buffer(-gap / 2, join_style=2), "x", (-half + board + gap, half - board - gap)))
        at = y[hinged]
        z = max(z for a, z in strip.exterior.coords if abs(a - at) < 0.02)
        m.hinge(f"lid_{k}", (0, at, z), (-1 if hinged else 1, 0, 0), m.pick(50, 70))
    if hollow:
        core = core.difference(core.buffer(-0.07).intersection(rectangle((-99, 99), (low + 0.12, 9))))
    m.add(BASE, *prisms(core, "x", (-half + board, half - board)))
    for shut in panels:
        body = body.difference(shut)
    for side in (-1, 1):
        m.add(BASE, *prisms(body, "x", tuple(sorted((side * half, side * (half - board))))))
    make = wheel_maker(m, tread=0.1)
    for name, y in zip(("front", "rear"), axles, strict=True):
        axled(m, make, (-half + 0.01, half - 0.01), y, radius, 0.22 * half + 0.05, name)
    if m.chance(0.6):  # a windscreen
        m.add(
            BASE, beam((0, *np.array(top[1]) + np.array([0.06, 0.05])), (0, *np.array(top[2]) - (0.04, 0.02)), 1.7 * half, 0.02)
        )
    if hollow and m.chance(0.6):  # seats
        for x in (-0.4 * half, 0.4 * half):
            y = doors[0][0][1] - 0.4
            m.add(BASE, box((x - 0.22, x + 0.22), (y - 0.3, y + 0.2), (low + 0.1, low + 0.35)))
            m.add(BASE, box((x - 0.22, x + 0.22), (y + 0.15, y + 0.25), (low + 0.3, low + 0.8)))
    return outline


def car(m: Model) -> None:
    """A saloon, hatchback or van: doors, bonnet, boot or hatch."""
    form = m.pick("saloon", "hatch", "van", "saloon")
    long, half, high, radius = m.number(3.6, 4.8), m.number(0.8, 0.95), m.number(1.3, 1.5), m.number(0.28, 0.36)
    bonnet, boot, deck = m.number(0.9, 1.2), m.number(0.7, 0.95), m.number(0.8, 0.95)
    rear = {"saloon": [(long - boot - 0.5, high), (long - boot, deck + 0.05), (long, deck)]}.get(form, [])
    if form == "van":
        high = m.number(1.7, 2.1)
    rear = rear or [(long - m.pick(0.1, 0.35), high), (long, deck)]
    top = [(0, deck - 0.15), (bonnet, deck + 0.03), (bonnet + m.number(0.4, 0.7), high), *rear]
    axles = (0.75, long - 0.8)
    count = 1 if form == "van" or m.chance(0.3) else 2
    first, last = bonnet + 0.12, min(axles[1] - 0.25, long - boot - 0.05)
    cuts = np.linspace(first, last if count == 2 else 0.5 * (first + last), count + 1)
    doors = [((a + 0.01, b - 0.01), m.chance(0.8), False) for a, b in itertools.pairwise(cuts)]
    if form == "van":
        doors.append(((cuts[-1] + 0.03, axles[1] - 0.35), m.chance(0.5), m.chance(0.8)))
    lids = [((0.08, bonnet - 0.03), 1)] * m.chance(0.85)
    if form == "saloon":
        lids.append(((long - boot + 0.04, long - 0.05), 0))
    vehicle(m, top, half, axles, radius, doors, lids)
    if form != "saloon":
        a, b = np.array([0, rear[0][0], high - 0.05]), np.array([0, long, deck])
        off = np.array([0, 0.02, 0.02])
        m.add("hatch", beam(a + off, b + off, 1.7 * half, 0.04))
        m.hinge("hatch", a + off, (1, 0, 0), m.pick(70, 85))
        if m.chance(0.5):
            m.add("hatch", box((-0.1, 0.1), (long, long + 0.06), (deck + 0.05, deck + 0.09)))
    mirrors_lights(m, half, (0, long), 0.62, (bonnet + 0.3, deck + 0.05))
    if m.chance(0.3):
        m.add(
            BASE,
            *(box((x - 0.02, x + 0.02), (bonnet + 0.9, long - 1.1), (high, high + 0.06)) for x in (-0.8 * half, 0.8 * half)),
        )


def pickup_truck(m: Model) -> None:
    """A cab with doors and an open bed with a tailgate."""
    long, half, high, radius = m.number(4.6, 5.6), m.number(0.85, 1.0), m.number(1.6, 1.85), m.number(0.35, 0.45)
    bonnet, deck, cab = m.number(1.1, 1.4), m.number(0.95, 1.1), m.number(1.3, 2.2)
    back = bonnet + 0.4 + cab
    top = [(0, deck - 0.1), (bonnet, deck), (bonnet + 0.45, high), (back - 0.1, high), (back, deck), (back + 0.02, 0.65)]
    double = cab > 1.8
    cuts = np.linspace(bonnet + 0.1, back - 0.15, 2 + double)
    doors = [((a + 0.01, b - 0.02), m.chance(0.8), False) for a, b in itertools.pairwise(cuts)]
    vehicle(m, [*top, (long, 0.65)], half, (0.85, long - 1.0), radius, doors, [((0.08, bonnet - 0.03), 1)] * m.chance(0.8))
    wall, lift = m.pick(0.04, 0.08), deck + m.pick(-0.05, 0.0, 0.05)
    for side in (-1, 1):
        m.add(BASE, box((side * half, side * (half - wall)), (back + 0.03, long), (0.65, lift)))
        if m.chance(0.4):
            m.add(
                BASE, rod((side * (half - wall / 2), back + 0.1, lift), (side * (half - wall / 2), long - 0.1, lift), 0.03, 8)
            )
    gap = abs(m.gap(0.5))
    gate = rectangle((-half + wall + gap, half - wall - gap), (0.67, lift - 0.01), m.pick(0.0, 0.0, 0.06))
    m.add("tailgate", prism(gate, "y", (long - 0.06, long)))
    if gate.interiors:
        m.add("tailgate", box((-half + wall + 0.05, half - wall - 0.05), (long - 0.05, long - 0.02), (0.7, lift - 0.04)))
    m.add("tailgate", box((-0.15, 0.15), (long, long + 0.02), (lift - 0.14, lift - 0.08)))
    m.hinge("tailgate", (0, long - m.pick(0.0, 0.03), 0.67), (-1, 0, 0), m.pick(90, 95))
    mirrors_lights(m, half, (0, long), 0.7, (bonnet + 0.3, deck + 0.05))
    if m.chance(0.4):
        m.add(BASE, *(box((x - 0.03, x + 0.03), (back + 0.06, back + 0.12), (0.65, high)) for x in (-0.6 * half, 0.6 * half)))
