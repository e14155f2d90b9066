"""Tape decks and film projectors."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Dot
from trimesh import Trimesh

from training.kinds.electronics.boombox import cassette_door
from training.kinds.electronics.controls import knob
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import button, cable
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, box, cut, join, prism, rectangle, rod, rounded, tube, turned, vec
from training.kinds.wheels import beam, lathe, upright


def tape_deck(m: Model) -> None:
    """A deck of a stereo with one or two wells, a flat recorder with keys at its front, or one with two large reels."""
    {"stereo": _stereo_deck, "flat": _flat_recorder, "reels": _reel_deck}[m.pick("stereo", "stereo", "flat", "reels")](m)


def _stereo_deck(m: Model) -> None:
    """A wide box with a front panel that overlaps it."""
    wide, deep, high, foot = m.number(0.38, 0.45), m.number(0.22, 0.32), m.number(0.11, 0.16), m.pick(0.006, 0.014)
    x, z, wells = (0.0, wide), (foot, foot + high), m.pick(1, 1, 2, 2)
    low, places, holes = z[0] + 0.02, {1: m.pick((0.02,), (wide / 2 - 0.06,)), 2: m.pick((0.02, wide - 0.14), (0.06, 0.2))}, []
    for k, a in enumerate(places[wells]):
        holes.append(cassette_door(m, f"door_{k}", (a, a + 0.12), 0.0, (low, low + 0.078), m.number(0.003, 0.007)))
    m.add(BASE, cut(box(x, (0, 0.02), z), *holes))
    m.add(BASE, box(shrunk(x, m.pick(0.0, 0.006)), (0.02, deep), (z[0] + 0.003, z[1] - 0.003)))
    m.add(BASE, *(rod((a, b, 0), (a, b, foot + 0.004), 0.018, 12) for a in shrunk(x, 0.05) for b in (0.04, deep - 0.04)))
    free = [
        (a, b) for a, b in zip((0.0, *(p + 0.12 for p in places[wells])), (*places[wells], wide), strict=True) if b - a > 0.06
    ]
    k = 0
    for a, b in free:
        n = int(min(m.pick(2, 3, 5), (b - a) / 0.022))
        for c in np.linspace(a + 0.02, b - 0.02, n):
            if m.chance(0.4):
                knob(m, f"knob_{k}", (c, 0, z[0] + 0.03), (0, -1, 0), m.number(0.007, 0.011))
            else:
                button(m, f"button_{k}", (c, 0, z[0] + 0.03), (0, -1, 0), 0.012)
            k += 1
        m.add(BASE, box((a + 0.012, b - 0.012), (-0.001, 0), (z[0] + 0.055, z[1] - 0.02)))
        if m.chance(0.4):
            m.add(
                BASE,
                *(box((c, c + 0.002), (-0.002, 0), (z[0] + 0.06, z[1] - 0.03)) for c in np.linspace(a + 0.02, b - 0.02, 6)),
            )
    if m.chance(0.4):
        button(m, "power", (0.012, 0, z[1] - 0.01), (0, -1, 0), 0.01)


def _flat_recorder(m: Model) -> None:
    """A recorder that lies on a table: its lid opens at the rear, keys in a row, a loudspeaker, a handle."""
    wide, deep, high = m.number(0.13, 0.18), m.number(0.24, 0.29), m.number(0.045, 0.06)
    x, y = (0.0, wide), (0.0, deep)
    well = ((wide - 0.11) / 2, (wide + 0.11) / 2), (0.045, 0.12)
    body = cut(prism(rounded(x, y, m.pick(0.004, 0.015)), "z", (0, high)), box(*well, (high - 0.02, 1)))
    gap = 0.001
    lid = prism(rectangle(*(shrunk(w, gap) for w in well), 0.018), "z", (high - 0.003, high + 0.003))
    m.add("lid", lid, box(shrunk(well[0], 0.017), shrunk(well[1], 0.017), (high - 0.001, high + 0.001)))
    m.hinge("lid", (wide / 2, well[1][1] - gap, high), (-1, 0, 0), m.number(40, 70))
    n, keyed = m.pick(5, 6), (0.0, 0.03)
    m.add(BASE, cut(body, box(shrunk(x, 0.012), (-1, keyed[1]), (high - 0.02, 1))))
    for k in range(n):
        a, b = (0.014 + (wide - 0.028) * (k + c) / n for c in (0.03, 0.97))
        m.add(f"key_{k}", box((a, b), (-0.003, keyed[1] - 0.001), (high - 0.014, high - 0.004)))
        m.hinge(f"key_{k}", (wide / 2, keyed[1], high - 0.009), (1, 0, 0), m.number(12, 18))
    m.add(BASE, *(box((0.02, wide - 0.02), (c, c + 0.003), (high, high + 0.0015)) for c in np.linspace(0.14, deep - 0.03, 9)))
    if m.chance(0.7):
        c, reach = 0.012, m.number(0.04, 0.06)
        path = [(c, deep - 0.01, 0.5 * high), (c, deep + 0.012, 0.5 * high), (wide - c, deep + 0.012, 0.5 * high),
                (wide - c, deep - 0.01, 0.5 * high)]  # fmt: skip
        m.add("handle", tube(path, 0.005, 8))
        m.slide("handle", (0, 1, 0), reach)
    if m.chance(0.6):
        knob(m, "volume", (wide, 0.7 * deep, 0.6 * high), (1, 0, 0), 0.01)


def _reel_deck(m: Model) -> None:
    """A standing or leaning plate with two reels, heads under a cover, levers and knobs."""
    r, deep = m.number(0.08, 0.1), m.number(0.15, 0.22)
    wide, high = 4 * r + m.number(0.035, 0.07), m.number(0.4, 0.5)
    x, top, n = (0.0, wide), high - r - 0.02, m.pick(24, 32)
    m.add(BASE, box(x, (0, 0.01), (0, high)), box(shrunk(x, 0.01), (0.01, deep), (0.01, high - 0.01)))
    for k, a in enumerate((r + 0.012, wide - r - 0.012)):
        holes = [Dot(0.6 * r * np.cos(t), 0.6 * r * np.sin(t)).buffer(0.24 * r) for t in np.linspace(0, 2 * np.pi, 4)[:3] + 0.3]
        flange = Dot(0, 0).buffer(r, quad_segs=n // 4)
        for hole in holes if m.chance(0.8) else []:
            flange = flange.difference(hole)
        solids = [prism(flange, "z", span) for span in ((0.006, 0.008), (0.016, 0.018))]
        solids += [rod((0, 0, 0.001), (0, 0, 0.024), 0.2 * r, n), rod((0, 0, 0.008), (0, 0, 0.016), (0.9, 0.5)[k] * r, n)]
        m.add(f"reel_{k}", *upright(solids, (0, -1, 0), (a, 0, top)))
        m.spin(f"reel_{k}", (a, 0, top), (0, -1, 0))
    z, c = top - r - 0.05, wide / 2
    m.add("head_cover", prism(rounded((c - 0.07, c + 0.07), (z - 0.03, z + 0.025), 0.005), "y", (-0.035, -0.001)))
    m.hinge("head_cover", (c, 0, z - 0.03), (1, 0, 0), m.number(60, 90))
    for s in (-1, 1):
        m.add(BASE, rod((c + s * 0.12, 0, z + 0.03), (c + s * 0.12, -0.025, z + 0.03), 0.012, n))
        at = vec(c + s * 0.15, 0, z - 0.02)
        bar = box((at[0] - 0.004, at[0] + 0.004), (-0.014, -0.008), (at[2], at[2] + 0.04))
        m.add(f"arm_{s}", turned(join(rod(at, at - vec(0, 0.016, 0), 0.008, 12), bar), (0, 1, 0), -s * 20, at))
        m.hinge(f"arm_{s}", at, (0, s, 0), 35)
    m.add(BASE, *(box((c + s * 0.06 - 0.035, c + s * 0.06 + 0.035), (-0.002, 0), (0.055, 0.095)) for s in (-1, 1)))
    for k in range(m.pick(2, 3, 4)):
        knob(m, f"knob_{k}", (c + (k % 2 * 2 - 1) * (0.13 + 0.04 * (k // 2)), 0, 0.05), (0, -1, 0), 0.014)
    for k in range(m.pick(3, 5)):
        button(m, f"button_{k}", (c - 0.06 + 0.03 * k, 0, 0.025), (0, -1, 0), 0.014)


def _film_reel(m: Model, part: str, at: Point, radius: float, full: float, parent: str) -> None:
    """A reel of film that turns about x: two flanges with holes, a hub, the film."""
    holes, flange = m.pick(0, 3, 4, 5), Dot(0, 0).buffer(radius, quad_segs=m.pick(4, 6, 8))
    for t in np.linspace(0, 2 * np.pi, holes, endpoint=False):
        flange = flange.difference(Dot(0.6 * radius * np.cos(t), 0.6 * radius * np.sin(t)).buffer(0.22 * radius))
    solids: list[Trimesh] = [prism(flange, "z", span) for span in ((-0.011, -0.009), (0.009, 0.011))]
    solids += [rod((0, 0, -0.013), (0, 0, 0.02), 0.12 * radius, 12), rod((0, 0, -0.009), (0, 0, 0.009), full * radius, 20)]
    m.add(part, *upright(solids, (1, 0, 0), at))
    m.spin(part, at, (1, 0, 0), parent)


def _lens(m: Model, a: float, y: float, z: float) -> None:
    """A lens that slides in its holder, or turns in it to focus."""
    r, long = m.number(0.016, 0.024), m.number(0.05, 0.09)
    m.add(BASE, rod((a, y + 0.01, z), (a, y - 0.03, z), 1.35 * r, 16))
    profile = [(0, 0), (r, 0), (r, 0.5 * long), (1.2 * r, 0.55 * long), (1.2 * r, long), (0.9 * r, long), (0.9 * r, 0.9 * long)]
    m.add("lens", *upright([lathe([*profile, (0, 0.9 * long)], m.pick(12, 16, 24))], (0, -1, 0), (a, y - 0.03, z)))
    if m.chance(0.5):
        m.slide("lens", (0, -1, 0), m.number(0.015, 0.03))
    else:
        m.spin("lens", (a, y, z), (0, -1, 0))


def film_projector(m: Model) -> None:
    """A projector for cine film: two reels on arms that fold or stand, a lens, a lamp house with a door, knobs, a foot."""
    wide, deep, high = m.number(0.13, 0.19), m.number(0.24, 0.36), m.number(0.24, 0.34)
    x, foot, style = (0.0, wide), 0.03, m.pick("box", "curved", "stepped")
    line = {
        "box": rectangle((0, deep), (foot, high)),
        "curved": rounded((0, deep), (foot, high), 0.06, 6),
        "stepped": [(0.06, foot), (deep, foot), (deep, high - 0.05), (0.7 * deep, high), (0.03, high), (0.03, 0.5 * high)],
    }[style]
    m.add(BASE, prism(line, "x", x))
    m.add(BASE, box((-0.005, wide + 0.04), (0.02 if style != "stepped" else 0.05, deep - 0.01), (0.012, foot)))
    m.add(BASE, *(rod((a, deep - 0.04, 0), (a, deep - 0.04, 0.013), 0.012, 10) for a in (0.02, wide)))
    front = vec(wide / 2, 0.08, 0)
    m.add("foot", rod(front + vec(0, 0, 0.011), front, 0.018, 12), rod(front, front + vec(0, 0, 0.0119), 0.006, 8))
    m.slide("foot", (0, 0, -1), m.number(0.015, 0.03))
    face, z = (0.0 if style != "stepped" else 0.04), m.number(0.5, 0.62) * high
    _lens(m, wide + 0.018, face + 0.03, z)
    m.add(BASE, box((wide, wide + 0.034), (face + 0.03, face + 0.13), (z - 0.05, z + 0.06)))  # the gate
    m.add(BASE, *(rod((wide, b, c), (wide + 0.022, b, c), 0.012, 12) for b, c in ((0.16, z + 0.08), (0.17, z - 0.07))))
    r, arm, a = m.number(0.09, 0.14), m.number(0.1, 0.16), wide + 0.022
    for k, (pivot, tip) in enumerate((
        (vec(wide, 0.07, high - 0.03), vec(0, -0.5, 0.87)), (vec(wide, deep - 0.05, high - 0.04), vec(0, 0.65, 0.75)),
    )):  # fmt: skip
        end = pivot + (arm + r * 0.45) * tip
        part = f"arm_{k}" if m.chance(0.65) else BASE
        m.add(
            part,
            beam(pivot + vec(0.004, 0, 0), end + vec(0.004, 0, 0), 0.008, 0.024),
            rod(pivot, pivot + vec(0.012, 0, 0), 0.018, 12),
        )
        m.add(part, rod(end, end + vec(0.03, 0, 0), 0.005, 8))
        if part != BASE:
            m.hinge(part, pivot, (1 - 2 * k, 0, 0), m.number(60, 110) if k else m.number(30, 45))
        _film_reel(m, f"reel_{k}", (a, end[1], end[2]), r, m.number(0.3, 0.9), part)
    _projector_side(m, wide, deep, high, z)
    if m.chance(0.6):
        m.add("handle", tube([(wide / 2, c, high - 0.004 + d) for c, d in (
            (0.3 * deep, 0), (0.3 * deep, 0.025), (0.62 * deep, 0.025), (0.62 * deep, 0))], 0.006, 8))  # fmt: skip
        m.hinge("handle", (wide / 2, deep / 2, high), (0, -1, 0), m.pick(80, (-80, 80)))


def _projector_side(m: Model, wide: float, deep: float, high: float, z: float) -> None:
    """The left side with the door of the lamp house and vents; knobs at the right and the rear."""
    y, span = (0.3 * deep, 0.75 * deep), (0.3 * high, 0.85 * high)
    m.add("lamp_door", box((-0.006, -0.0003), y, span))
    m.add(
        "lamp_door",
        *(
            box((-0.008, -0.006), (y[0] + 0.015, y[1] - 0.02), (c, c + 0.004))
            for c in np.linspace(span[0] + 0.02, span[1] - 0.02, 6)
        ),
    )
    if m.chance(0.6):
        m.hinge("lamp_door", (-0.006, y[1], high / 2), (0, 0, -1), m.number(90, 130))
    else:
        m.hinge("lamp_door", (-0.006, deep / 2, span[0]), (0, -1, 0), m.number(80, 110))
    m.add("lamp_door", rod((-0.006, y[0] + 0.012, high / 2), (-0.014, y[0] + 0.012, high / 2), 0.006, 10))
    for k in range(m.pick(1, 2, 3)):
        knob(m, f"knob_{k}", (wide, 0.6 * deep + 0.035 * k, 0.3 * high), (1, 0, 0), 0.014)
    m.add(BASE, *(box((wide, wide + 0.002), (0.55 * deep, 0.9 * deep), (c, c + 0.003)) for c in np.linspace(z, high - 0.08, 5)))
    if m.chance(0.4):
        cable(m, (wide / 2, deep, 0.25 * high), 0.2)
