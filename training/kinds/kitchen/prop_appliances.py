"""Appliances by another artist: dishwashers and coffee makers."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.prop_fronts import tray
from training.kinds.prop_style import Style, bar, block, draw_style, sheet
from training.kinds.solids import Span, box, cut, rod, tube, vec


def integrated_dishwasher(m: Model) -> None:
    """A tub with a door that falls forwards, or one or two tub drawers; racks, spray arms, controls on the strip or door."""
    s = draw_style(m, "low", "sheet", "cad", "round", "sunk")
    wide, deep, high = m.pick(0.45, 0.6, 0.6) * m.number(0.95, 1.05), m.number(0.52, 0.6), m.number(0.78, 0.88)
    kick, strip, t = m.pick(0.0, 0.08, 0.12), m.pick(0.0, 0.07, 0.11), m.number(0.02, 0.05)
    x, y, z, w = (0.0, wide), (0.0, deep), (kick, high), 0.03
    room = ((w, wide - w), (kick + w, high - strip - 0.01))
    if s.way == "sheet":
        m.add(BASE, sheet(x, y, z, "f"))
    elif s.inside or s.way in ("cad", "sunk"):
        m.add(BASE, cut(block(s, x, y, z), box(room[0], (-1, deep - w), room[1])))
    else:
        m.add(BASE, block(s, x, y, z))
    if kick:
        m.add(BASE, block(s, (0.02, wide - 0.02), (0.05, deep - 0.05), (0, kick + 0.001), ""))
    if strip:
        m.add(BASE, block(s, x, (-t, 0), (high - strip, high), "b"))
        _controls(s, BASE, x, -t, high - strip / 2)
    if m.chance(0.4):
        m.add(BASE, block(s, (-0.01, wide + 0.01), (-t, deep), (high - 0.0005, high + m.number(0.015, 0.03)), ""))
    front = (kick + 0.003, high - strip - m.pick(0.002, 0.004))
    if m.chance(0.2):
        _tub_drawers(s, x, (-t, deep), front)
        return
    s.put("door", *_front(s, x, (-t, -0.0005), front))
    if s.grip != "none":
        s.put("door", *bar(s, (wide / 2, -t, front[1] - 0.05), m.number(0.5, 0.8) * wide, False))
    if not strip and m.chance(0.6):
        _controls(s, "door", x, -t, front[1] - 0.1)
    m.hinge("door", (wide / 2, -t, front[0]), (1, 0, 0), m.pick(85, 90))
    if s.inside or s.way in ("cad", "sunk"):
        _inside(s, room[0], deep - w, room[1])


def _front(s: Style, x: Span, y: Span, z: Span) -> list[Trimesh]:
    """A door panel: plain, with a sunk grip, or a frame around a panel."""
    sort = s.m.pick("plain", "recess", "seam")
    x = (x[0] + 0.002, x[1] - 0.002)
    if s.way == "sheet":
        return [sheet(x, y, z, "b")]
    if sort == "recess":
        middle = (x[0] + x[1]) / 2
        hollow = box((middle - 0.12, middle + 0.12), (y[0] - 1, y[0] + 0.6 * (y[1] - y[0])), (z[1] - 0.06, z[1] - 0.025))
        return [cut(block(s, x, y, z), hollow)]
    if sort == "seam":
        at = z[1] - s.m.number(0.08, 0.13)
        return [
            block(s, x, y, (z[0], at - 0.002)),
            block(s, x, y, (at + 0.002, z[1])),
            box(x, (y[0] + 0.006, y[1]), (z[0] + 0.02, z[1] - 0.02)),
        ]
    return [block(s, x, y, z)]


def _controls(s: Style, parent: str, x: Span, y: float, z: float) -> None:
    """A display, buttons that are pressed, a dial that turns."""
    m, wide = s.m, x[1] - x[0]
    if m.chance(0.6):
        m.add(parent, box((x[0] + 0.42 * wide, x[0] + 0.58 * wide), (y - 0.001, y + 0.002), (z - 0.012, z + 0.012)))
    for k in range(m.pick(0, 3, 5)):
        name, at = s.name("button"), x[0] + (0.66 + 0.06 * k) * wide
        half = min(0.009, 0.02 * wide)
        m.add(
            name,
            rod((at, y + 0.001, z), (at, y - 0.004, z), half, s.n)
            if s.n > 12
            else box((at - half, at + half), (y - 0.004, y + 0.001), (z - half, z + half)),
        )
        m.slide(name, (0, 1, 0), 0.003, parent)
    if m.chance(0.5):
        at = vec(x[0] + 0.2 * wide, y, z)
        m.add(
            "dial",
            rod(at + vec(0, 0.001, 0), at - vec(0, 0.014, 0), 0.02, max(12, s.n)),
            box((at[0] - 0.002, at[0] + 0.002), (y - 0.016, y - 0.013), (z, z + 0.019)),
        )
        m.spin("dial", at, (0, -1, 0), parent)


def _tub_drawers(s: Style, x: Span, y: Span, z: Span) -> None:
    m, count = s.m, s.m.pick(1, 2, 2)
    for k in range(count):
        part, low = f"tub_{k}", z[0] + (z[1] - z[0]) * k / count
        high = z[0] + (z[1] - z[0]) * (k + 1) / count - 0.003
        s.put(part, *_front(s, x, (y[0], -0.0005), (low, high)))
        s.put(part, *bar(s, ((x[0] + x[1]) / 2, y[0], high - 0.05), 0.6 * (x[1] - x[0]), False))
        if s.inside or s.way in ("cad", "sunk", "sheet"):
            s.put(part, *tray(s, (x[0] + 0.035, x[1] - 0.035), (-0.001, 0.85 * y[1]), (low + 0.04, high - 0.05)))
        m.slide(part, (0, -1, 0), m.number(0.6, 0.8) * y[1])


def _inside(s: Style, x: Span, back: float, z: Span) -> None:
    """Racks on rails, spray arms on posts, a dispenser flap on the door."""
    m, high = s.m, z[1] - z[0]
    levels = [0.12, 0.55, 0.85][: m.pick(1, 2, 3)]
    for k, share in enumerate(levels):
        low, part = z[0] + share * high, f"rack_{k}"
        tall = 0.04 if k == 2 else 0.16
        for side in ((x[0] - 0.001, x[0] + 0.012), (x[1] - 0.012, x[1] + 0.001)):
            m.add(BASE, box(side, (0.03, back - 0.02), (low - 0.012, low)))
        m.add(part, *_rack(s, (x[0] + 0.004, x[1] - 0.004), (0.03, back - 0.03), (low, low + tall)))
        m.slide(part, (0, -1, 0), m.number(0.6, 0.85) * back)
    middle = vec((x[0] + x[1]) / 2, back / 2, 0)
    for k, level in enumerate((z[0], z[0] + 0.5 * high)[: min(len(levels), m.pick(0, 1, 2))]):
        at = middle + vec(0, 0, level + (0.028 if k == 0 else 0.0))
        m.add(f"spray_{k}", box((at[0] - 0.18, at[0] + 0.18), (at[1] - 0.02, at[1] + 0.02), (at[2], at[2] + 0.012)))
        m.spin(f"spray_{k}", at, (0, 0, 1))
        m.add(
            BASE,
            rod((at[0], at[1], z[0] - 0.002), at, 0.014, 8)
            if k == 0
            else tube([vec(at[0], back + 0.002, at[2] - 0.012), at - vec(0, 0, 0.012), at], 0.01, 6),
        )
    if m.chance(0.5):
        flap = (middle[0] - 0.1, middle[0] - 0.02)
        m.add("dispenser", box(flap, (-0.001, 0.008), (z[0] + 0.35 * high, z[0] + 0.35 * high + 0.06)))
        m.hinge("dispenser", (middle[0], 0.008, z[0] + 0.35 * high), (-1, 0, 0), 100, "door")


def _rack(s: Style, x: Span, y: Span, z: Span) -> list[Trimesh]:
    if s.way == "sheet":
        return [sheet(x, y, z, "u")]
    if s.way in ("low", "sunk"):
        return tray(s, x, y, z)
    r, wires = 0.0025, []
    for level in (z[0] + r, z[1]):
        loop = [vec(x[0] + r, y[0], level), vec(x[1] - r, y[0], level), vec(x[1] - r, y[1], level), vec(x[0] + r, y[1], level)]
        wires += [rod(a, b, r, 6) for a, b in zip(loop, loop[1:] + loop[:1], strict=True)]
    for v in np.linspace(x[0] + 0.03, x[1] - 0.03, 8):
        wires.append(tube([vec(v, y[0], z[1]), vec(v, y[0], z[0] + r), vec(v, y[1], z[0] + r), vec(v, y[1], z[1])], r, 6))
    for v in np.linspace(y[0] + 0.05, y[1] - 0.05, 5):
        wires.append(
            tube([vec(x[0] + r, v, z[1]), vec(x[0] + r, v, z[0] + r), vec(x[1] - r, v, z[0] + r), vec(x[1] - r, v, z[1])], r, 6)
        )
    return wires
