"""Hobs and hoods, by one artist: a hob with knobs, a cupboard with a cooker hood under it."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, faces, lathe
from training.kinds.solids import Span, around, ball, box, moved, prism, rod, rounded, vec


def hob_with_knobs(m: Model) -> None:
    """A hob in a worktop or on feet: burners or rings, knobs at the side or in front; perhaps a glass lid."""
    look = Look.of(m)
    burners = m.pick(1, 2, 2, 4, 4, 5)
    wide, deep = {1: (0.3, 0.36), 2: (0.32, 0.52), 4: (0.6, 0.52), 5: (0.75, 0.52)}[burners]
    if burners == 2 and m.chance(0.5):
        wide, deep = 0.6, 0.36
    wide, deep, tall = wide * m.number(0.9, 1.1), deep * m.number(0.9, 1.1), m.pick(0.012, 0.05, 0.09)
    m.add(BASE, look.block((0, wide), (0, deep), (0, tall)))
    if tall < 0.02 and m.chance(0.5):
        m.add(BASE, box((0.02, wide - 0.02), (0.02, deep - 0.02), (-0.05, 0.002)))
    upright = tall > 0.04 and m.chance(0.6)
    side = not upright and burners > 1 and wide > 0.45 and m.chance(0.5)
    field = ((0.03, wide - (0.1 if side else 0.03)), (0.03 if upright or side else 0.1, deep - 0.03))
    spots = {1: [(0.5, 0.5)], 2: [(0.5, 0.25), (0.5, 0.75)], 4: [(a, b) for a in (0.25, 0.75) for b in (0.25, 0.75)]}
    rows = spots.get(burners, [*((a, b) for a in (0.17, 0.83) for b in (0.25, 0.75)), (0.5, 0.5)])
    if burners == 2 and wide > deep:
        rows = [(b, a) for a, b in rows]
    design, r = m.pick("gas", "gas", "plate", "glass"), 0.17 * min(field[0][1] - field[0][0], field[1][1] - field[1][0])
    for a, b in rows:
        at = vec(*(lo + s * (hi - lo) for (lo, hi), s in zip(field, (a, b), strict=True)), tall)
        _burner(look, design, at, max(0.04, min(r * m.number(0.8, 1.3), 0.1)) if burners > 1 else 0.09)
    size, count = m.number(0.015, 0.022), burners + int(m.chance(0.2))
    step = 2.6 * size
    for k in range(count):
        offset = (k - (count - 1) / 2) * step
        if upright:
            look.dial(f"knob_{k}", (wide / 2 + offset * 1.1, 0, tall / 2), FRONT, min(size, 0.4 * tall), m.number(0.018, 0.03))
        else:
            at = (wide - 0.05, deep / 2 + offset, tall) if side else (wide / 2 + offset, 0.05, tall)
            look.dial(f"knob_{k}", at, UP, size, m.number(0.015, 0.028))
    if m.chance(0.3):
        y, z = deep - 0.01, tall + 0.055
        m.add(BASE, *(box((a - 0.012, a + 0.012), (y - 0.004, y + 0.012), (0.6 * tall, z)) for a in (0.12 * wide, 0.88 * wide)))
        m.add("lid", prism(rounded((0.004, wide - 0.004), (y - deep + 0.012, y), 0.015), "z", (z, z + 0.006)))
        m.hinge("lid", (wide / 2, y, z), (-1, 0, 0), m.pick(85, 90, 95))
    elif m.chance(0.3):
        m.add(BASE, *(ball((0.02, a, tall), (0.006, 0.006, 0.002), 8) for a in np.linspace(0.03, 0.1, 3)))


def _burner(look: Look, design: str, at: np.ndarray, r: float) -> None:
    """A gas burner under its grate, a cast plate or a ring printed on glass."""
    m, n = look.m, max(look.n, 12)
    if design == "glass":
        m.add(BASE, lathe([(r, 0), (r, 0.0008), (0.93 * r, 0.0008), (0.93 * r, 0)], n, at) if look.style != "sheet" else moved(
            faces(*([(r * np.cos(t), r * np.sin(t), 0.001), (r * np.cos(u), r * np.sin(u), 0.001), (0, 0, 0.001), (0, 0, 0.001)]
                    for t, u in zip(np.linspace(0, 6, n), np.linspace(0, 6, n) + 6 / n, strict=True))), at))  # fmt: skip
        return
    if design == "plate":
        m.add(
            BASE, lathe([(1.05 * r, 0), (1.05 * r, 0.004), (r, 0.004), (r, 0.012), (0.3 * r, 0.012), (0.25 * r, 0.01)], n, at)
        )
        return
    m.add(
        BASE,
        lathe([(0.5 * r, 0), (0.45 * r, 0.012), (0.4 * r, 0.014)], n, at),
        lathe([(0.4 * r, 0), (0.42 * r, 0.004), (0.3 * r, 0.008)], n, at + vec(0, 0, 0.014)),
    )
    arm = box((0.25 * r, 1.25 * r), (-0.004, 0.004), (0.026, 0.034))
    foot = box((1.15 * r, 1.25 * r), (-0.004, 0.004), (-0.001, 0.03))
    m.add(BASE, *(moved(s, at) for piece in (arm, foot) for s in around(piece, 4, m.pick(0, 45))))


def cooker_hood_cupboard(m: Model) -> None:
    """A wall cupboard over a hood: a visor that pulls out, a flap that drops or a canopy; doors that swing or lift."""
    look = Look.of(m)
    wide, deep, high = m.number(0.5, 0.9), m.number(0.28, 0.36), m.number(0.4, 0.75)
    low, wall, thick = m.number(0.05, 0.09), m.number(0.014, 0.02), look.depth(m.number(0.016, 0.022))
    x, y, z = (-wide / 2, wide / 2), (0.0, deep), (low, low + high)
    m.add(BASE, *look.shell(x, y, z, (wall, wall, wall, wall, 0.008)))
    if m.chance(0.6):
        m.add(BASE, *(box((x[0] + wall, x[1] - wall), (0.02, deep - 0.008), (h, h + wall)) for h in (z[0] + 0.45 * high,)))
    if m.chance(0.6):
        m.add(BASE, rod((0, 0.6 * deep, z[0]), (0, 0.6 * deep, z[1]), m.number(0.055, 0.075), look.n))
    design = m.pick("visor", "visor", "flap", "canopy")
    bottom = z[0] if design != "flap" or m.chance(0.5) else 0.35 * low
    lifts = m.chance(0.35)
    _cupboard_doors(look, x, (bottom + 0.002, z[1] - 0.002), thick, lifts)
    if m.chance(0.35) and not lifts:
        m.add(BASE, box((x[0] - 0.02, x[1] + 0.02), (-0.04, deep), (z[1], z[1] + 0.03)))
    body = ((x[0] + 0.01, x[1] - 0.01), (0.0, deep - 0.005), (0.3 * low if design == "visor" else 0.0, low))
    if design == "canopy":
        out = m.number(0.08, 0.18)
        slope = [(deep, 0.0), (-out, 0.0), (-out, 0.03), (-0.5 * out, 0.6 * low), (0.0, low), (deep, low)]
        m.add(BASE, prism(slope, "x", x))
        face = (-out, 0.015)
    else:
        m.add(BASE, look.block(*body, leave="z"))
        face = (body[1][0], (body[2][0] + low) / 2)
    if design == "visor":
        under = (0.004, body[2][0] - 0.0005)
        m.add("visor", box((x[0] + 0.012, x[1] - 0.012), (0.0, 0.75 * deep), under))
        m.add("visor", look.block((x[0], x[1]), (-0.02, 0.001), (0.0, 0.8 * low), leave="y"))
        m.slide("visor", FRONT, m.number(0.35, 0.6) * deep)
        face = (-0.02, 0.4 * low)
    elif design == "flap" and bottom == z[0]:
        look.front("flap", x, (0.002, low - 0.002), 0.0, 0.8 * thick)
        m.hinge("flap", (0, 0.0, low - 0.002), (-1, 0, 0), m.pick(30, 45))
    if design != "flap":
        _hood_keys(look, face, wide, 0.4 * low, "visor" if design == "visor" else BASE)
    if design != "visor" and m.chance(0.7):
        _hood_filters(look, (x[0] + 0.05, x[1] - 0.05), (0.05, deep - 0.04))


def _cupboard_doors(look: Look, x: Span, z: Span, thick: float, lifts: bool) -> None:
    """One door or two that swing, or one that lifts."""
    m, gap = look.m, max(0.0005, min(look.m.gap(0.4), 0.004))
    spans = [x] if lifts or m.chance(0.35) else [(x[0], -0.001), (0.001, x[1])]
    frame = m.pick(0.0, 0.0, 0.05)
    left_first = m.chance(0.5)
    held = m.chance(0.8)
    for k, span in enumerate(spans):
        part = "door" if len(spans) == 1 else f"door_{k}"
        look.front(part, span, z, -gap, thick, frame)
        left = k == 0 if len(spans) == 2 else left_first
        if lifts:
            m.hinge(part, (0, -gap, z[1]), (-1, 0, 0), m.pick(75, 90, 110))
        else:
            m.hinge(part, (span[0] if left else span[1], -gap, z[0]), (0, 0, -1 if left else 1), m.pick(95, 110))
        if held:
            at = (
                0.0 if lifts else (span[1] - 0.03 if left else span[0] + 0.03),
                -gap - thick,
                z[0] + (0.03 if lifts else 0.09),
            )
            long = m.number(0.1, 0.2) if look.style not in ("old", "soft") else 0.08
            look.grip(part, at, (1, 0, 0) if lifts else UP, long, m.number(0.02, 0.03))


def _hood_keys(look: Look, face: tuple[float, float], wide: float, tall: float, parent: str) -> None:
    """A row of keys or a slider on the face of a hood."""
    m, count = look.m, look.m.pick(2, 3, 4, 5)
    size, side = min(0.014, 0.6 * tall), m.pick(0.0, 0.3 * wide)
    if m.chance(0.25):
        m.add(parent, box((side - 0.03, side + 0.03), (face[0] - 0.001, face[0] + 0.002), (face[1] - 0.003, face[1] + 0.003)))
        m.add("slider", box((side - 0.026, side - 0.014), (face[0] - 0.007, face[0]), (face[1] - 0.004, face[1] + 0.004)))
        m.slide("slider", (1, 0, 0), 0.04, parent)
        return
    for k in range(count):
        at = (side + (k - (count - 1) / 2) * 1.6 * size, face[0], face[1])
        look.key(f"key_{k}", at, FRONT, (size, size, 0.003), parent)


def _hood_filters(look: Look, x: Span, y: Span) -> None:
    """Grease filters under a hood that hang down at their back edge, and lamps."""
    m, count = look.m, look.m.pick(1, 2, 3)
    edges = np.linspace(*x, count + 1)
    for k in range(count):
        part, span = f"filter_{k}", (edges[k] + 0.003, edges[k + 1] - 0.003)
        m.add(part, look.block(span, y, (-0.008, -0.0005), leave=""))
        m.add(part, box((span[0] + 0.03, span[1] - 0.03), (y[0] + 0.004, y[0] + 0.014), (-0.011, -0.007)))
        m.hinge(part, (0, y[1], -0.0005), (1, 0, 0), m.pick(60, 80))
    m.add(BASE, *(rod((a, y[0] - 0.022, -0.003), (a, y[0] - 0.022, 0.001), 0.018, look.n) for a in (0.7 * x[0], 0.7 * x[1])))
