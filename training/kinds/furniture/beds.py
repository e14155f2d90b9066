"""Trundle beds, wall beds and folding screens."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import trimesh

from training.kinds.cabinets.drawers import rows_of
from training.kinds.carcass import cabinet, clutter
from training.kinds.furniture.seating import cushion
from training.kinds.joinery import Style, alike, drawer, face, front, pull, shrunk, style
from training.kinds.model import BASE, Model
from training.kinds.panels import middle, pane
from training.kinds.solids import Span, arch, box, prism, rectangle, rod, rounded, tube

FLAT = ("slab", "framed", "moulded", "planks", "sunk", "rounded")


def _mattress(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    """A mattress, perhaps with a blanket over its lower half."""
    m.add(part, cushion(m, x, y, z))
    if m.chance(0.3):
        m.add(part, box((x[0] + 0.45 * (x[1] - x[0]), x[1] - 0.02), shrunk(y, -0.004), (z[0] + 0.03, z[1] + 0.012)))


def _bed_ends(m: Model, x: Span, y: Span, rail: float, kind: str) -> None:
    """Head and foot of a bed: boards, arched boards or tubes with bars; a daybed has a back as well."""
    tall = m.number(0.25, 0.6)
    for k, (a, way) in enumerate(((x[0], -1), (x[1], 1))):
        high = rail + (tall if k == 0 or kind == "daybed" else m.pick(0.1, 0.2))
        if kind == "tube":
            r, c = m.pick(0.016, 0.022), a + way * 0.022
            m.add(BASE, tube([(c, y[0] + r, 0), (c, y[0] + r, high), (c, y[1] - r, high), (c, y[1] - r, 0)], r, 8))
            m.add(BASE, rod((c, y[0] + r, rail), (c, y[1] - r, rail), 0.8 * r, 8))
            m.add(BASE, *(rod((c, b, rail), (c, b, high), 0.4 * r, 6) for b in np.linspace(*y, m.pick(4, 6, 9))[1:-1]))
        else:
            outline = arch(y, (0, high), 0.3 * (high - rail)) if kind == "arch" else rectangle(y, (0, high))
            m.add(BASE, prism(outline, "x", (a, a + way * 0.035)))
    if kind == "daybed":
        m.add(BASE, box(x, (y[1], y[1] + 0.03), (m.pick(0.0, rail), rail + tall)))
        for a in rows_of(x, [1.0] * m.pick(0, 2, 3), 0.02) if m.chance(0.6) else ():
            m.add(BASE, cushion(m, a, (y[1] - 0.16, y[1]), (rail + 0.16, rail + 0.16 + 0.8 * tall)))


def _trundle(m: Model, x: Span, y: Span, z: Span, s: Style, wheels: str) -> None:
    """The bed that rolls out: a long front, a shallow box with a mattress, wheels that turn, stay, or none."""
    r, face_y = m.pick(0.02, 0.03), -s.thick - 0.002 if s.mount == "overlay" else 0.004
    part, low = "trundle", z[0] + (2 * r if wheels != "none" else 0.01)
    face(alike(m, s.seed), part, x, (face_y, face_y + s.thick), (z[0] + 0.01, z[1]), s.front)
    inner, deep, high = shrunk(x, 0.03), (face_y + s.thick, y[1] - 0.05), low + m.number(0.08, 0.12)
    m.add(part, *(box(a, deep, (low, high)) for a in ((inner[0], inner[0] + 0.02), (inner[1] - 0.02, inner[1]))))
    m.add(part, box(inner, (deep[1] - 0.02, deep[1]), (low, high)))
    slats = rows_of(inner, [1.0] * m.pick(1, 9, 12), 0.02)
    m.add(part, *(box(a, deep, (low + 0.02, low + 0.035)) for a in slats))
    if m.chance(0.8):
        _mattress(m, part, shrunk(inner, 0.025), shrunk(deep, 0.02), (low + 0.035, min(z[1] - 0.005, low + 0.2)))
    for c in m.pick((0.5,), (0.25, 0.75), (0.15, 0.85)):
        at = (x[0] + c * (x[1] - x[0]), middle(z) + 0.2 * (z[1] - z[0]))
        pull(alike(m, s.seed + 1), part, at, face_y, s.pull, 0.14)
    m.slide(part, (0, -1, 0), m.number(0.7, 0.95) * (y[1] - y[0]))
    places = [(a, b) for a in shrunk(inner, 0.12) for b in shrunk(deep, 0.1)] if wheels != "none" else []
    for k, (a, b) in enumerate(places):
        name = f"wheel_{k}" if wheels == "spin" else part
        m.add(name, rod((a - 0.012, b, r + z[0]), (a + 0.012, b, r + z[0]), r, m.sections()))
        m.add(part, box((a - 0.018, a + 0.018), (b - 0.008, b + 0.008), (z[0] + r + 0.003, low + 0.02)))
        if name != part:
            m.spin(name, (a, b, r + z[0]), (1, 0, 0), part)


def trundle_bed(m: Model) -> None:
    """A bed with a bed that rolls out below; plain, arched, tubular or a daybed, drawers between in some, wheels vary."""
    kind, long, wide = m.pick("board", "arch", "tube", "daybed", "daybed"), m.number(1.9, 2.05), m.number(0.85, 1.2)
    s, captain = replace(style(m), carcass="boards"), kind != "tube" and m.chance(0.4)
    s = replace(s, front=m.pick(*FLAT), pull=m.pick("bar", "rail", "knob", "cup", "recess", "block", "edge", "none"))
    x, y, foot = (0.0, long), (0.0, wide), m.number(0.26, 0.32)
    rail = foot + (m.number(0.2, 0.24) if captain else m.number(0.02, 0.06))
    _bed_ends(m, x, y, rail + 0.12, kind)
    side = shrunk(x, -0.001)
    if captain:
        m.add(BASE, box(side, (0.02, wide), (foot, foot + 0.015)), box(side, (wide - 0.015, wide), (foot, rail)))
        for k, a in enumerate(rows_of(x, [1.0] * m.pick(2, 3), 0.004)):
            at = (-s.thick - 0.002, -0.002) if s.mount == "overlay" else (0.004, s.thick + 0.004)
            part = BASE if k == 2 and m.chance(0.3) else f"drawer_{k}"
            if part == BASE:
                front(m, BASE, a, at, (foot + 0.018, rail - 0.003), s)
            else:
                drawer(m, part, a, at, (foot + 0.018, rail - 0.003), s, m.number(0.45, 0.8))
    m.add(BASE, box(side, (0, 0.025), (rail, rail + 0.12)), box(side, (wide - 0.025, wide), (rail, rail + 0.12)))
    if kind != "tube" and m.chance(0.6):
        m.add(BASE, box(side, (wide - 0.02, wide), (0, rail)))
    m.add(BASE, box(side, shrunk(y, 0.025), (rail + 0.02, rail + 0.04)))
    _mattress(m, BASE, shrunk(x, 0.01), shrunk(y, 0.03), (rail + 0.04, rail + m.number(0.18, 0.24)))
    m.add(BASE, prism(rounded((0.06, 0.42), shrunk(y, 0.15), 0.07), "z", (rail + 0.2, rail + 0.3)))
    if m.chance(0.25):  # a guard rail
        m.add(BASE, *(box((0.3, 1.3), (-0.002, 0.02), (rail + c, rail + c + 0.05)) for c in (0.25, 0.35)))
        m.add(BASE, *(box((c, c + 0.05), (0.0, 0.025), (rail, rail + 0.4)) for c in (0.4, 1.15)))
    top = foot - (0.004 if captain or s.mount == "overlay" else 0.012)
    _trundle(m, shrunk(x, m.pick(0.003, 0.008)), y, (0.0, top), s, m.pick("spin", "still", "none"))


def _bed_face(m: Model, x: Span, y: Span, z: Span, s: Style) -> None:
    """The underside of a wall bed, which looks like cupboard doors with handles when it stands."""
    columns, rows = m.pick((1, [1.0]), (2, [1.0]), (2, [1.0, 2.0]), (3, [1.0]), (2, [1.0, 1.0, 1.0]))
    m.add("bed", box(x, (y[0] + 0.4 * (y[1] - y[0]), y[1]), z))
    for k, a in enumerate(rows_of(x, [1.0] * columns, 0.0)):
        for b in rows_of(z, rows, 0.0):
            face(alike(m, s.seed), "bed", shrunk(a, 0.002), (y[0], y[0] + 0.4 * (y[1] - y[0])), shrunk(b, 0.002), s.front)
            if s.pull not in ("none", "edge") and columns > 1:
                at = a[1] - 0.06 if k % 2 == 0 else a[0] + 0.06
                pull(alike(m, s.seed + 1), "bed", (at, middle(b)), y[0], s.pull, 0.16, True)
    if columns == 1 and m.chance(0.7):
        m.add(
            "bed",
            tube([(middle(x) + c, y[0] + d, z[1] - 0.3) for c, d in ((-0.3, 0), (-0.3, -0.04), (0.3, -0.04), (0.3, 0))], 0.01),
        )


def _bed_legs(m: Model, x: Span, y: float, top: float, long: float) -> None:
    """Legs that lie on the face of a wall bed and fold out at its top end."""
    at, inner, how = top - m.number(0.12, 0.3), shrunk(x, m.number(0.06, 0.15)), m.pick("bow", "pair", "board")
    c = y - 0.014
    for k, a in enumerate(inner) if how == "pair" else ():
        m.add(f"leg_{k}", box((a - 0.025, a + 0.025), (y - 0.025, y - 0.001), (at - long, at)))
        m.hinge(f"leg_{k}", (a, y - 0.012, at), (-1, 0, 0), 90, "bed")
    if how == "pair":
        return
    if how == "bow":
        m.add("leg", tube([(inner[0], c, at), (inner[0], c, at - long), (inner[1], c, at - long), (inner[1], c, at)], 0.012, 8))
        m.add("bed", *(box((a - 0.03, a + 0.03), (y - 0.006, y), (at - 0.03, at + 0.04)) for a in inner))
    else:
        m.add("leg", box(inner, (y - 0.026, y - 0.001), (at - long, at)))
    m.hinge("leg", (middle(x), c, at), (-1, 0, 0), 90, "bed")


def wall_bed(m: Model) -> None:
    """A bed that folds down from a cabinet, upright or sideways, with folding legs, towers of doors and shelves, a top."""
    upright, s = m.chance(0.65), style(m)
    s = replace(s, front=m.pick(*FLAT), carcass="boards")
    wide, high = (m.number(0.95, 1.75), m.number(2.05, 2.3)) if upright else (m.number(2.0, 2.15), m.number(1.0, 1.5))
    deep, board, t = m.number(0.38, 0.5), m.number(0.018, 0.035), m.number(0.03, 0.045)
    x, y, p = (0.0, wide), (0.0, deep), m.number(0.1, 0.15)
    e = min(m.number(0.2, 0.3), deep - p - 0.03)
    low = m.number(0.05, 0.1) + float(np.hypot(p + t, e)) - e
    m.add(BASE, *(box(a, y, (0, high)) for a in ((0, board), (wide - board, wide))))
    m.add(BASE, box(shrunk(x, board), y, (high - board, high)))
    m.add(BASE, box(shrunk(x, board), (0.03, 0.05), (0, low - float(np.hypot(p + t, e)) + e - 0.005)))
    if m.chance(0.75):
        m.add(BASE, box(x, (deep - 0.006, deep), (0, high)))
    inner, face_y = shrunk(x, board + m.pick(0.002, 0.006)), m.pick(-0.5 * t, 0.002, 0.01)
    _bed_face(m, inner, (face_y, face_y + t), (low, high - board - 0.004), s)
    lying, up = shrunk(inner, 0.03), (low + 0.06, high - board - 0.04)
    m.add("bed", prism(rectangle(inner, (low, high - board - 0.004), 0.025), "y", (face_y + t, face_y + t + 0.07)))
    thick = (face_y + t, face_y + t + m.number(0.14, 0.2))
    mattress = cushion(m, lying, thick, up)
    m.add("bed", mattress)
    if m.chance(0.5):
        m.add("bed", box((lying[0], lying[1]), (thick[1] - 0.01, thick[1] + 0.004), (low + 0.25 * high, low + 0.3 * high)))
    at = low + e
    m.hinge("bed", (middle(x), p, at), (1, 0, 0), 90)
    if m.chance(0.8):
        _bed_legs(m, inner, face_y, high - board, at - p + face_y - 0.014)
    if m.chance(0.4):
        m.add(
            BASE,
            *(rod((a, p, at), (c, p, at), 0.02, 12) for a, c in ((board, inner[0] + 0.004), (inner[1] - 0.004, wide - board))),
        )
    layouts = (
        [("open", 1.0)] * 4,
        [("pair", 2.0), ("open", 1.0), ("open", 1.0)],
        [("drawer", 0.5), ("drawer", 0.5), ("left", 2.0)],
    )
    for k, a in enumerate(m.pick((), ((-0.5, 0.0),), ((wide, wide + 0.45),), ((-0.4, 0.0), (wide, wide + 0.4)))):
        cabinet(m, a, y, (0.0, high), [(1.0, m.pick(*layouts))], s, f"tower_{k}_")
    if not upright:
        clutter(m, x, y, high)
    elif m.chance(0.4):
        m.add(BASE, box(shrunk(x, -0.02), (-0.03, deep), (high, high + 0.06)))


def _leaf_of(m: Model, part: str, x: Span, y: Span, z: Span, how: str) -> None:
    """A leaf of a folding screen."""
    frame = 0.03
    inner = shrunk(x, frame), (z[0] + (0.12 if how == "shoji" else frame), z[1] - frame)
    if how in ("arched", "painted"):
        m.add(part, prism(arch(x, z, 0.12) if how == "arched" else rectangle(x, z), "y", y))
        m.add(part, prism(rectangle(shrunk(x, 0.06), (z[0] + 0.1, z[1] - 0.2), 0.015), "y", shrunk(y, -0.003)))
        return
    if how == "louvre":
        face(m, part, x, y, z, "louvre")
        return
    m.add(part, *(box(a, y, z) for a in ((x[0], inner[0][0]), (inner[0][1], x[1]))))
    m.add(part, *(box(inner[0], y, b) for b in ((z[0], inner[1][0]), (inner[1][1], z[1]))))
    m.add(part, pane(m, inner[0], y, inner[1]))
    thin = shrunk(y, 0.2 * (y[1] - y[0]))
    if how == "shoji":
        m.add(part, *(box(inner[0], thin, (c - 0.006, c + 0.006)) for c in np.linspace(*inner[1], m.pick(5, 7))[1:-1]))
        m.add(part, *(box((c - 0.006, c + 0.006), thin, inner[1]) for c in np.linspace(*inner[0], m.pick(3, 4))[1:-1]))
    elif how == "bands":
        m.add(part, *(box(inner[0], y, (c - 0.015, c + 0.015)) for c in np.linspace(*inner[1], m.pick(3, 4))[1:-1]))


def folding_screen(m: Model) -> None:
    """A screen of 3 to 6 leaves in a chain, drawn flat, in a zigzag or folded together; frames, feet and hinges vary."""
    count, each, high, t = m.pick(3, 3, 4, 4, 5, 6), m.number(0.38, 0.6), m.number(1.4, 2.0), m.number(0.02, 0.035)
    how, low, drawn = (
        m.pick("shoji", "bands", "cloth", "arched", "painted", "louvre"),
        m.pick(0.0, 0.06, 0.1),
        m.pick(0, 1, 1, 2),
    )
    gap, barrels, first, seed = abs(m.gap(each)), m.chance(0.6), m.pick(0, 1), int(m.rng.integers(1 << 30))
    angles = {0: (0.0, 0.0), 1: (m.number(15, 35), m.number(40, 75)), 2: (0.0, 178.0)}[drawn]
    where, names = np.eye(4), [BASE, *(f"leaf_{k}" for k in range(1, count))]
    for k, part in enumerate(names):
        x, y, z, one = (k * each + gap / 2, (k + 1) * each - gap / 2), (0.0, t), (low, high), Model(m.rng)
        to_back = (k + first) % 2
        way, at = 1 - 2 * (1 - to_back), np.array([k * each, t * to_back, low])
        if k:
            bend = angles[1] if drawn != 1 or k > 1 else angles[1] - angles[0]
            axis, origin = np.array([0, 0, way]), (where @ [*at, 1])[:3]
            m.hinge(part, origin, axis if drawn < 2 else -axis, (0, 175) if drawn == 2 else (-bend, 175 - bend), names[k - 1])
            if barrels:
                spans = [(c * high - 0.03, c * high + 0.03) for c in (0.2, 0.5, 0.8)]
                one.add(part, *(rod((*at[:2], a), (*at[:2], b), 0.007, 8) for a, b in spans))
            where = where @ trimesh.transformations.rotation_matrix(np.deg2rad(bend), axis, at)
        _leaf_of(alike(one, seed), part, x, y, z, how)
        if low:
            one.add(part, *(box((a - 0.02, a + 0.02), y, (0, low)) for a in shrunk(x, 0.03)))
        for _, solid in one.pieces:
            solid.apply_transform(where)
        m.pieces += one.pieces
