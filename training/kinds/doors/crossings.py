"""Gates on ways: of canal locks and level crossings."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import dial
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, box, rod, vec
from training.kinds.wheels import beam


def lock_gate(m: Model) -> None:
    """A canal's chamber with a pair of mitred gates, one gate, or one that is lifted in a frame; beams, racks, planks."""
    half, high, wall = m.number(1.1, 3.0), m.number(2.2, 4.0), m.number(0.8, 1.6)
    ahead, behind, t = m.number(0.8, 2.0), half * 2 + m.number(0.5, 1.5), m.number(0.2, 0.35)
    style = m.pick("pair", "pair", "single", "lifted") if half > 1.6 else m.pick("pair", "single", "lifted")
    stone, hand = m.chance(0.6), m.pick(-1, 1)
    for s in (-1, 1):
        recess = 0.0 if style == "lifted" or (style == "single" and s != hand) else t + 0.12
        m.add(BASE, box((s * (half + recess), s * (half + wall)), (-behind, ahead), (0, high)))
        if recess:
            m.add(BASE, box((s * half, s * (half + recess)), (0.32, ahead), (0, high)))
            m.add(BASE, box((s * half, s * (half + recess)), (-behind, -behind + 0.3), (0, high)))
        if stone:
            m.add(BASE, box((s * (half - 0.02 + recess), s * (half + wall + 0.03)), (-behind, ahead), (high, high + 0.15)))
    m.add(BASE, box((-half - wall, half + wall), (-behind, ahead), (-0.3, 0)))
    top = high + (0.15 if stone else 0.0)
    if style == "lifted":
        _lifted_gate(m, half, top, t)
        return
    tilt = np.deg2rad(m.number(14, 22)) if style == "pair" else 0.0
    for s in (-1, 1) if style == "pair" else (hand,):
        _swung_gate(m, (half, top, t), s, tilt, style == "pair")


def _swung_gate(m: Model, size: tuple[float, float, float], s: int, tilt: float, pair: bool) -> None:
    """One leaf from its heel post at the wall, closed against its fellow or the other wall; it opens to -Y into the wall."""
    half, top, t = size
    part = f"gate_{'left' if s < 0 else 'right'}"
    heel = vec(s * (half + 0.04), 0.12, 0)
    along = vec(-s * np.cos(tilt), np.sin(tilt) * -1.0, 0) if pair else vec(-s, 0, 0)
    long = (half + 0.04) / np.cos(tilt) - 0.02 if pair else 2 * half + 0.02
    tip, high, side = heel + long * along, top - m.number(0.1, 0.3), np.cross(along, (0, 0, 1))
    m.add(part, rod(heel + vec(0, 0, 0.03), heel + vec(0, 0, top + 0.2), 0.5 * t, 16))
    m.add(part, beam(tip + vec(0, 0, 0.03) - 0.5 * t * along, tip + vec(0, 0, high) - 0.5 * t * along, t, t, along))
    for c in np.linspace(0.08, 0.97, m.pick(3, 5, 6)) * high:
        m.add(part, beam(heel + vec(0, 0, c), tip + vec(0, 0, c) - 0.2 * t * along, 0.18, 0.8 * t, (0, 0, 1)))
    plank = 0.25 * t * side
    m.add(
        part,
        beam(
            heel + vec(0, 0, 0.5 * high) + plank,
            tip + vec(0, 0, 0.5 * high) + plank - 0.2 * t * along,
            0.96 * high,
            0.2 * t,
            (0, 0, 1),
        ),
    )
    up = vec(0, 0, top + 0.15)
    if m.chance(0.75):
        m.add(
            part,
            beam(
                heel + up - m.number(1.0, 1.3) * long * along, heel + up + long * along, 0.25, 0.25, (0, 0, 1), m.pick(0.7, 1.0)
            ),
        )
    if m.chance(0.6):
        _gate_walk(m, part, side, heel, tip, high)
    m.hinge(part, heel, np.cross(along, (0, -1, 0)), 90 - np.rad2deg(tilt) - m.number(0, 6) if pair else m.number(80, 88))
    if m.chance(0.7):
        at = heel + 0.6 * long * along + 0.48 * t * side
        m.add(
            f"paddle_{part[5:]}",
            beam(at + vec(0, 0, 0.2), at + vec(0, 0, high + 0.8), 0.08, 0.05, along),
            beam(at + vec(0, 0, 0.15), at + vec(0, 0, 0.75), 0.55, 0.05, along),
        )
        m.slide(f"paddle_{part[5:]}", (0, 0, 1), 0.5, part)


def _gate_walk(m: Model, part: str, side: np.ndarray, heel: np.ndarray, tip: np.ndarray, high: float) -> None:
    """A plank with a rail along the top of a gate."""
    m.add(
        part,
        beam(
            heel + vec(0, 0, high + 0.02) - 0.35 * side,
            tip + vec(0, 0, high + 0.02) - 0.35 * side,
            0.3,
            0.05,
            side,
        ),
    )
    m.add(
        part,
        *(
            beam(
                heel + c * (tip - heel) - 0.48 * side + vec(0, 0, high),
                heel + c * (tip - heel) - 0.48 * side + vec(0, 0, high + 1.0),
                0.04,
                0.04,
            )
            for c in (0.25, 0.6, 0.95)
        ),
    )
    m.add(
        part,
        beam(
            heel + 0.2 * (tip - heel) - 0.48 * side + vec(0, 0, high + 1.0),
            tip - 0.48 * side + vec(0, 0, high + 1.0),
            0.05,
            0.05,
            (0, 0, 1),
        ),
    )


def _lifted_gate(m: Model, half: float, top: float, t: float) -> None:
    """A plate in grooves under a frame with a winding gear."""
    high, w = top + m.number(0.95, 1.15) * top, m.number(0.15, 0.3)
    for s in (-1, 1):
        m.add(
            BASE, *(box((s * (half - 0.12), s * half), (d - 0.05, d + 0.05), (0, top)) for d in (-t / 2 - 0.07, t / 2 + 0.07))
        )
        m.add(
            BASE,
            *(
                box((s * (half - 0.12), s * (half - 0.12 + w)), (d - 0.05, d + 0.05), (top, high))
                for d in (-t / 2 - 0.07, t / 2 + 0.07)
            ),
        )
    m.add(BASE, box((-half - w, half + w), (-t / 2 - 0.2, t / 2 + 0.2), (high, high + 0.3)))
    m.add("gate", box((-half + 0.01, half - 0.01), (-0.12 * t, 0.12 * t), (0.01, top - 0.1)))
    for c in np.linspace(0.1, top - 0.2, m.pick(3, 5)):
        m.add("gate", box((-half + 0.14, half - 0.14), (-t / 2, t / 2), (c - 0.07, c + 0.07)))
    m.add("gate", *(box((s * (half - 0.3), s * (half - 0.14)), (-t / 2, t / 2), (0.01, top - 0.1)) for s in (-1, 1)))
    m.slide("gate", (0, 0, 1), 0.85 * top)
    m.add(BASE, box((-0.3, 0.3), (-t / 2 - 0.5, -t / 2 - 0.2), (high - 0.1, high + 0.35)))
    if m.chance(0.6):
        dial(m, "crank", (0, -t / 2 - 0.5, high + 0.1), (0, -1, 0), 0.3, BASE, "bar")
    m.add(BASE, *(rod((s * 0.6 * half, 0, high + 0.3), (s * 0.6 * half, 0, high + 0.55), 0.15, 12) for s in (-1, 1)))


def level_crossing(m: Model) -> None:
    """A road over one or two tracks with booms or swung gates, posts with lamps and crosses, a hut, a wicket in some."""
    tracks, half, reach = m.pick(1, 1, 2), m.number(2.2, 3.6), m.number(0.8, 1.4)
    edge = 1.1 + 1.7 * (tracks - 1) + m.number(0.8, 1.4)
    m.add(BASE, box((-half - reach - 2, half + reach + 2), (-edge - 1.5, edge + 1.5), (-0.4, -0.08)))
    for c in (0.0,) if tracks == 1 else (-1.7, 1.7):
        m.add(
            BASE,
            *(box((-half - reach - 2, half + reach + 2), (c + d - 0.035, c + d + 0.035), (-0.02, 0.12)) for d in (-0.72, 0.72)),
        )
        xs = np.arange(-half - reach - 1.8, half + reach + 2, 0.65)
        m.add(BASE, *(box((a - 0.12, a + 0.12), (c - 1.2, c + 1.2), (-0.1, -0.01)) for a in xs))
    m.add(BASE, box((-half, half), (-edge - 1.5, edge + 1.5), (-0.08, 0.06)))
    style = m.pick("half", "half", "full", "gates")
    places = {
        "half": [(-1, -1), (1, 1)],
        "full": [(-1, -1), (1, 1), (1, -1), (-1, 1)],
        "gates": [(-1, -1), (1, 1), (1, -1), (-1, 1)],
    }[style]
    if style != "gates" and m.chance(0.25):
        places = places[:1]
    whole = style == "half" and m.chance(0.4)
    build = {"skirt": m.chance(0.3), "cross": m.chance(0.7), "lamps": m.pick(0, 2, 3), "round": m.chance(0.3)}
    for k, (s, f) in enumerate(places):
        at = vec(s * (half + m.number(0.35, 0.6)), f * (edge + 0.1), 0)
        if style == "gates":
            _field_gate(m, f"gate_{k}", at, s, f, abs(at[0]) - 0.04)
        else:
            _crossing_boom(m, f"boom_{k}", at, (s, f), (2 * half + 0.3 if whole else abs(at[0]) - 0.04), build)
    if m.chance(0.4):
        x, y = half + 1.45, edge + 0.2
        m.add(BASE, box((x, x + 1.05), (y, y + 1.2), (-0.1, 2.2)), box((x - 0.1, x + 1.15), (y - 0.15, y + 1.35), (2.2, 2.35)))
        m.add(BASE, box((x + 0.15, x + 0.85), (y - 0.02, y), (0.0, 1.9)))


def _crossing_boom(m: Model, part: str, at: Point, way: tuple[int, int], long: float, build: dict) -> None:
    """A drive with a boom over the road, its counterweights, and the signal post beside it."""
    (s, f), (x, y, _) = way, at
    pivot, r = vec(x, y, m.number(0.9, 1.1)), m.number(0.04, 0.06)
    m.add(
        BASE,
        box((x - 0.2, x + 0.2), (y - 0.17, y + 0.17), (-0.08, pivot[2] + 0.2)),
        box((x - 0.3, x + 0.3), (y - 0.3, y + 0.3), (-0.1, 0.0)),
    )
    c = y + f * 0.28
    m.add(part, rod((x, y + f * 0.17, pivot[2]), (x, c + f * 0.06, pivot[2]), 0.09, 12))
    tip = vec(x - s * long, c, pivot[2])
    m.add(
        part,
        beam(vec(x + s * 0.3, c, pivot[2]), tip, 0.07, 0.14, (0, 1, 0), 0.6)
        if not build["round"]
        else rod((x + s * 0.3, c, pivot[2]), tip, r, 12),
    )
    m.add(
        part,
        *(
            box((x + s * 0.3, x + s * 0.75), (c + d - 0.03, c + d + 0.03), (pivot[2] - 0.14, pivot[2] + 0.14))
            for d in (-0.06, 0.06)
        ),
    )
    for q in np.arange(0.5, long - 0.15, m.pick(0.25, 0.5)) if build["skirt"] else ():
        m.add(part, rod((x - s * q, c, pivot[2] - 0.03), (x - s * q, c, 0.25), 0.012, 6))
    if build["skirt"]:
        m.add(part, rod((x - s * 0.5, c, 0.25), (x - s * (long - 0.15), c, 0.25), 0.015, 6))
    elif m.chance(0.5):
        m.add(
            part,
            *(
                rod((x - s * q, c, pivot[2] + 0.03), (x - s * q, c, pivot[2] + 0.14), 0.04, 8)
                for q in (0.4 * long, 0.95 * long)
            ),
        )
    m.hinge(part, pivot, (0, s, 0), m.number(78, 88))
    if not (build["cross"] or build["lamps"]):
        return
    post, face = vec(x + s * 0.1, y + f * m.number(0.75, 1.1), 0), f
    m.add(BASE, rod(post, post + vec(0, 0, 3.0), 0.05, 12), rod(post - vec(0, 0, 0.1), post + vec(0, 0, 0.1), 0.15, 12))
    for k in range(build["lamps"]):
        lamp = post + vec((k - (build["lamps"] - 1) / 2) * 0.34, face * 0.07, 1.9)
        m.add(BASE, rod(lamp, lamp + vec(0, face * 0.05, 0), 0.15, 16), rod(lamp, lamp + vec(0, face * 0.16, 0), 0.09, 12))
    if build["lamps"]:
        m.add(BASE, box((post[0] - 0.35, post[0] + 0.35), (post[1] + face * 0.04, post[1] + face * 0.08), (1.86, 1.94)))
    for d in (-1, 1) if build["cross"] else ():
        top = post + vec(0, face * 0.07, 2.65)
        m.add(BASE, beam(top - vec(0.45, 0, d * 0.25), top + vec(0.45, 0, d * 0.25), 0.02, 0.14, (0, 1, 0)))


def _field_gate(m: Model, part: str, at: Point, s: int, f: int, long: float) -> None:
    """A gate of the old manner that closes the road and swings away from the line."""
    x, y, _ = at
    high, far = m.number(1.2, 1.5), x - s * long
    m.add(BASE, box((x - 0.12, x + 0.12), (y - 0.12, y + 0.12), (-0.1, high + 0.35)))
    near = x - s * 0.14
    m.add(part, *(beam((near, y, c), (far, y, c), 0.08, 0.1, (0, 1, 0)) for c in np.linspace(0.2, high, m.pick(3, 4, 5))))
    m.add(
        part,
        *(box((a - 0.05, a + 0.05), (y - 0.045, y + 0.045), (0.16, high + 0.05)) for a in (near - s * 0.05, far + s * 0.05)),
    )
    if m.chance(0.7):
        m.add(part, beam((near - s * 0.05, y + f * 0.05, high), (far + s * 0.05, y + f * 0.05, 0.2), 0.04, 0.09, (0, 1, 0)))
    if m.chance(0.6):
        m.add(part, rod(((near + far) / 2, y + f * 0.05, 0.75), ((near + far) / 2, y + f * 0.08, 0.75), 0.28, 20))
    m.hinge(part, (x - s * 0.13, y, 0), np.cross((-s, 0, 0), (0, f, 0)), m.number(80, 95))
