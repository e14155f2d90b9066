"""Printers that build solid things, open or enclosed."""

from __future__ import annotations

import numpy as np
from trimesh.creation import annulus

from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import dial, feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, handle, hang, middle
from training.kinds.solids import Span, box, cut, prism, ring, rod, rounded, vec
from training.kinds.wheels import upright


def _spool(m: Model, at: np.ndarray, axis: np.ndarray, r: float) -> None:
    """A spool that turns on its pin."""
    n, wide = m.sections() + 4, m.number(0.05, 0.07)
    m.add(BASE, rod(at - axis * 0.55 * wide, at + axis * 0.6 * wide, 0.012, 10))
    flanges = [annulus(0.016, r, 0.004, sections=n).apply_translation((0, 0, c * wide / 2)) for c in (-1, 1)]
    core = annulus(0.016, m.number(0.5, 0.9) * r, wide, sections=n)
    m.add("spool", *upright([*flanges, core], axis, at))
    m.spin("spool", at, axis)


def _head(m: Model, parent: str, at: np.ndarray, room: Span, travel: Span, below: float) -> None:
    """A print head that runs along its beam at a point, its nozzle reaching down; room: half widths along y."""
    w = m.number(0.02, 0.035)
    m.add("head", box((at[0] - w, at[0] + w), (at[1] - room[0], at[1] + room[1]), (at[2] - 0.03, at[2] + 0.035)))
    y = at[1] - room[0] / 2
    m.add("head", rod((at[0], y, at[2] - 0.03), (at[0], y, at[2] - below), 0.006, 8))
    if m.chance(0.6):
        m.add("head", rod((at[0], at[1] - room[0] - 0.012, at[2]), (at[0], at[1] - room[0], at[2]), 0.8 * w, 12))
    m.slide("head", (1, 0, 0), (travel[0] - at[0], travel[1] - at[0]), parent)


def _cube(m: Model) -> None:
    """A case with a door and a lid, a gantry above a bed that sinks."""
    wide, deep, high, post = m.number(0.35, 0.55), m.number(0.35, 0.55), m.number(0.38, 0.65), m.number(0.025, 0.04)
    low = m.number(0.015, 0.04)
    x, y, z = (-wide / 2, wide / 2), (0.0, deep), (low, low + high)
    feet(m, x, y, low)
    solid = m.chance(0.5)
    if not solid:
        m.add(
            BASE, *(box(a, b, z) for a in ((x[0], x[0] + post), (x[1] - post, x[1])) for b in ((0, post), (deep - post, deep)))
        )
        for c in (z[0], z[1] - post):
            m.add(BASE, *(box(shrunk(x, post), b, (c, c + post)) for b in ((0, post), (deep - post, deep))))
            m.add(BASE, *(box(a, shrunk(y, post), (c, c + post)) for a in ((x[0], x[0] + post), (x[1] - post, x[1]))))
        m.add(BASE, box(shrunk(x, 0.004), shrunk(y, 0.004), (z[0] + 0.002, z[0] + 0.01)))
        m.add(
            BASE, *(box((a, a + 0.004), shrunk(y, post), shrunk(z, post)) for a in (x[0] + 0.01, x[1] - 0.014) if m.chance(0.8))
        )
        m.add(BASE, box(shrunk(x, post), (deep - 0.014, deep - 0.01), shrunk(z, post)))
    else:
        shell = cut(prism(rounded(x, z, 0.02), "y", y), box(shrunk(x, post), (-1, deep - 0.02), (z[0] + 0.09, z[1] - post)))
        m.add(BASE, cut(shell, box(shrunk(x, post), shrunk(y, post), (z[1] - 2 * post, z[1] + 1))))
        m.add(BASE, box((0.05, 0.14), (-0.004, 0.0), (z[0] + 0.02, z[0] + 0.07)))
        dial(m, "knob", (-0.06, 0, z[0] + 0.045), (0, -1, 0), 0.014) if m.chance(0.5) else None
    _cube_doors(m, x, post, z, solid, y, deep, wide, high)


def _cube_doors(m: Model, x: Span, post: float, z: Span, solid: bool, y: Span, deep: float, wide: float, high: float) -> None:
    """Doors, lid, gantry, bed and spool of a case."""
    inner, top = shrunk(x, post + 0.012), z[1] - post - 0.05
    thick = (-0.008 - max(m.gap(0.2), 0), -max(m.gap(0.2), 0))
    if m.chance(0.85):
        room, span = shrunk(x, 0.3 * post), (z[0] + (0.08 if solid else m.pick(0.5 * post, 0.08)), z[1] - 0.3 * post)
        leaves = {m.pick("left", "right"): room}
        if m.chance(0.2):
            leaves = {"left": (room[0], -0.001), "right": (0.001, room[1])}
        framed = m.chance(0.5)
        for side, a in leaves.items():
            part = f"door_{side}"
            glazed(m, part, a, thick, span, 0.025) if framed else m.add(part, box(a, thick, span))
            e = a[1] - 0.02 if side == "left" else a[0] + 0.02
            handle(m, part, (e, middle(span)), thick, -1 if side == "left" else 1, "front", 0.05)
            hang(m, part, a, thick, span, side, OUT, m.number(100, 180))
    if m.chance(0.6):
        tall = m.pick(0.006, 0.01, 0.08, 0.12)
        lid = box(shrunk(x, 0.002), shrunk(y, 0.002), (z[1] + 0.001, z[1] + tall))
        m.add("lid", cut(lid, box(shrunk(x, 0.006), shrunk(y, 0.006), (z[1] - 1, z[1] + tall - 0.004))) if tall > 0.05 else lid)
        m.add("lid", box((-0.04, 0.04), (-0.012, 0.004), (z[1] + 0.2 * tall, z[1] + 0.8 * tall)))
        m.hinge("lid", (0, deep - 0.003, z[1] + 0.001), (-1, 0, 0), m.number(75, 110))
    for a in inner:
        m.add(BASE, rod((a, post * 0.5, top), (a, deep - 0.016, top), 0.005, 8))
    c = m.number(0.45, 0.7) * deep
    m.add("gantry", *(box((a - 0.014, a + 0.014), (c - 0.02, c + 0.02), (top - 0.014, top + 0.014)) for a in inner))
    m.add("gantry", *(rod((inner[0], b, top), (inner[1], b, top), 0.005, 8) for b in (c - 0.01, c + 0.01)))
    m.slide("gantry", (0, -1, 0), (c - deep + 0.07, c - post - 0.05))
    at = vec(m.number(-0.1, 0.1) * wide, c, top)
    _head(m, "gantry", at, (0.03, 0.02), (inner[0] + 0.055, inner[1] - 0.055), 0.055)
    _bed(m, inner, deep, post, (z[0] + 0.1, top - 0.06))
    if m.chance(0.6):
        side = m.chance(0.5)
        p = vec(x[1] + 0.042, 0.5 * deep, z[0] + 0.6 * high) if side else vec(0, deep + 0.042, z[0] + 0.6 * high)
        _spool(m, p, vec(1, 0, 0) if side else vec(0, 1, 0), m.number(0.07, 0.1))


def _bed(m: Model, inner: Span, deep: float, post: float, z: Span) -> None:
    """A bed on arms that sinks along rods at the back."""
    half, top = 0.5 * (inner[1] - inner[0]) - m.number(0.02, 0.04), z[1] - m.pick(0.002, 0.03, 0.1)
    b = deep - 0.05
    m.add("bed", box((-half, half), (post + 0.02, b - 0.02), (top - 0.008, top)))
    m.add(
        "bed",
        *(
            box((s * 0.6 * half - 0.01, s * 0.6 * half + 0.01), (post + 0.05, b + 0.012), (top - 0.024, top - 0.008))
            for s in (-1, 1)
        ),
    )
    m.add("bed", box((-0.7 * half, 0.7 * half), (b - 0.012, b + 0.012), (top - 0.03, top - 0.008)))
    m.add(BASE, *(rod((s * 0.45 * half, b, z[0] - 0.1), (s * 0.45 * half, b, z[1] + 0.03), 0.005, 8) for s in (-1, 0, 1)))
    if m.chance(0.4):
        m.add("bed", rod((0, 0.5 * deep, top), (0, 0.5 * deep, top + 0.02), 0.03, 10)) if top < z[1] - 0.025 else None
    m.slide("bed", (0, 0, -1), 0.9 * (top - 0.03 - z[0]))


def _portal(m: Model) -> None:
    """A portal over a bed that runs forward and back; a beam climbs the posts."""
    wide, deep, high = m.number(0.36, 0.5), m.number(0.36, 0.48), m.number(0.38, 0.55)
    w, foot, top = 0.02, m.number(0.03, 0.06), m.number(0.05, 0.09)
    x = (-wide / 2, wide / 2)
    solid = m.chance(0.5)
    if solid:
        m.add(BASE, box((x[0] + 0.02, x[1] - 0.02), (0.05, deep - 0.05), (0.0, foot)))
        m.add(BASE, box((-0.03, 0.03), (0.0, deep), (foot - 0.02, foot)))
    else:
        m.add(
            BASE,
            *(box(x, (b - w, b + w), (0.005, foot)) for b in (0.06, deep - 0.06)),
            box((-w, w), (0, deep), (foot - 0.03, foot)),
        )
    c = 0.55 * deep
    m.add(
        BASE,
        *(box((a - w, a + w), (c - w, c + w), (0.0, high)) for a in x),
        box((x[0] - w, x[1] + w), (c - w, c + w), (high, high + 2 * w)),
    )
    m.add(BASE, *(rod((a * 0.86, c + 0.01, foot), (a * 0.86, c + 0.01, high), 0.004, 8) for a in x[: m.pick(1, 2)]))
    m.add(BASE, *(box((a * 0.86 - 0.02, a * 0.86 + 0.02), (c - 0.01, c + 0.03), (0.0, 0.045)) for a in x))
    half = 0.36 * wide
    m.add(
        "bed",
        box((-half, half), (c - half, c + half), (top, top + 0.006)),
        box((-0.05, 0.05), (c - 0.6 * half, c + 0.6 * half), (foot, top)),
    )
    if m.chance(0.6):
        m.add(
            "bed",
            *(
                rod((s * 0.8 * half, c + t * 0.8 * half, top - 0.016), (s * 0.8 * half, c + t * 0.8 * half, top), 0.015, 12)
                for s in (-1, 1)
                for t in (-1, 1)
            ),
        )
    m.slide("bed", (0, -1, 0), (-0.7 * half, 0.7 * half))
    _portal_beam(m, top, high, c, w, x, wide, solid, foot)


def _portal_beam(m: Model, top: float, high: float, c: float, w: float, x: Span, wide: float, solid: bool, foot: float) -> None:
    """The beam that climbs, its head, the spool and a knob."""
    z = top + m.number(0.06, 0.35) * high
    front = c - w - 0.012
    m.add("gantry", box((x[0] - 0.02, x[1] + 0.02), (front - 0.012, front + 0.011), (z - 0.012, z + 0.012)))
    m.add("gantry", *(box((a - 0.03, a + 0.03), (front - 0.014, front + 0.011), (z - 0.03, z + 0.03)) for a in x))
    m.slide("gantry", (0, 0, 1), (min(top + 0.05 - z, 0.0), high - 0.05 - z))
    at = vec(m.number(-0.2, 0.2) * wide, front - 0.012, z)
    _head(m, "gantry", at, (0.045, 0.0), (x[0] + 0.07, x[1] - 0.07), z - top - 0.01 if z - top < 0.065 else 0.05)
    if m.chance(0.6):
        m.add(BASE, rod((0, c, high + 2 * w - 0.005), (0, c, high + 2 * w + 0.1), 0.008, 8))
        _spool(m, vec(0, c, high + 2 * w + 0.1), vec(1, 0, 0) if m.chance(0.5) else vec(0, 1, 0), 0.08)
    if m.chance(0.4):
        m.add(BASE, box((x[1] + w, x[1] + 0.13), (c - w, c - w + 0.015), (0.02, 0.1)))
    else:
        dial(m, "knob", (0.1, 0.05 if solid else 0.06 - w, foot - 0.018), (0, -1, 0), 0.012)


def _resin(m: Model) -> None:
    """A resin printer: a plate that climbs a column above a vat, under a cover that tips back or lifts off."""
    wide, deep, foot, high = m.number(0.2, 0.32), m.number(0.2, 0.32), m.number(0.12, 0.18), m.number(0.22, 0.4)
    x, y = (-wide / 2, wide / 2), (0.0, deep)
    m.add(BASE, prism(rounded(x, y, 0.02), "z", (0.008, foot)) if m.chance(0.5) else box(x, y, (0.008, foot)))
    m.add(BASE, *(rod((a * 0.8, b, 0), (a * 0.8, b, 0.01), 0.012, 10) for a in x for b in (0.03, deep - 0.03)))
    m.add(BASE, box((-0.045, 0.045), (-0.003, 0.0), (0.35 * foot, 0.8 * foot)))
    col, top = (deep - 0.065, deep - 0.035), foot + 0.9 * high
    m.add(BASE, box((-0.03, 0.03), col, (foot, top)), rod((0, col[0] - 0.01, foot), (0, col[0] - 0.01, top), 0.005, 8))
    c, half = 0.42 * deep, 0.3 * wide
    vat = (-half - 0.02, half + 0.02), (c - 0.26 * deep, c + 0.24 * deep)
    m.add(BASE, cut(box(*vat, (foot, foot + 0.035)), box(shrunk(vat[0], 0.012), shrunk(vat[1], 0.012), (foot + 0.005, 1))))
    z = foot + m.pick(0.008, 0.05, 0.1)
    m.add(
        "plate",
        box((-half + 0.006, half - 0.006), shrunk(vat[1], 0.02), (z, z + 0.014)),
        box((-0.025, 0.025), (c - 0.02, c + 0.02), (z + 0.014, z + 0.06)),
    )
    m.add(
        "plate",
        box((-0.022, 0.022), (c - 0.02, col[0]), (z + 0.05, z + 0.07)),
        rod((0, c, z + 0.06), (0, c, z + 0.085), 0.016, 12),
    )
    m.slide("plate", (0, 0, 1), top - z - 0.09)
    hood = shrunk(x, 0.004), shrunk(y, 0.004)
    deep_in = shrunk(hood[0], 0.004), shrunk(hood[1], 0.004)
    m.add("cover", cut(box(*hood, (foot + 0.001, foot + high)), box(*deep_in, (foot - 1, foot + high - 0.004))))
    style = m.pick("tips", "lifts", "door")
    if style == "tips":
        m.add(
            BASE,
            *(rod((a - 0.02, deep, foot + 0.002), (a + 0.02, deep, foot + 0.002), 0.008, 8) for a in (0.7 * x[0], 0.7 * x[1])),
        )
        m.hinge("cover", (0, deep, foot + 0.001), (-1, 0, 0), m.number(80, 105))
    else:
        m.add(
            "cover", box((-0.05, 0.05), (0.3 * deep, 0.4 * deep), (foot + high, foot + high + 0.015))
        ) if style == "lifts" else None
        m.slide("cover", (0, 0, 1), m.number(0.9, 1.1) * high)
    m.add(BASE, ring((x[1] * 0.7, -0.001, 0.2 * foot + 0.012), (0, 1, 0), 0.009, 0.002, 12)) if m.chance(0.4) else None


def printer_3d(m: Model) -> None:
    """A printer of solid things: an enclosed case, an open portal, or a resin printer under a cover."""
    m.pick(_cube, _cube, _portal, _resin)(m)
