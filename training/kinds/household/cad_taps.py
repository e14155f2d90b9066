"""Taps of basins and sinks as several artists model them: one hole, three holes, on the wall, with levers and crosses."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import aimed, baluster, band, bar, bolt, convention, lathed, rounds, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Point, ball, box, cut, loft, ring, rod, turned, vec

HANDLES = ("cross", "lever", "lever", "wheel", "knob")


def hose(path: Sequence[Point], radii: Sequence[float], n: int, caps: bool = True) -> Trimesh:
    """A round bar of changing radius along a path in a plane x = constant; n = 4: a square one."""
    points = np.array(path, float)
    along = np.gradient(points, axis=0)
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    up = np.cross(along, (1.0, 0, 0))
    turn = np.linspace(0, 2 * np.pi, n, endpoint=False) + np.pi / n
    rings = [
        p + r * (np.cos(turn)[:, None] * vec(1, 0, 0) + np.sin(turn)[:, None] * u)
        for p, r, u in zip(
            points, np.interp(np.linspace(0, 1, len(points)), np.linspace(0, 1, len(radii)), radii), up, strict=True
        )
    ]
    return loft(np.array(rings), caps)


def _arc(z: float, reach: float, rise: float, drop: float, count: int) -> list[Point]:
    """From (0, 0, z) up, over to the front and down."""
    t = np.linspace(0, np.pi, count)
    bow = [vec(0, -reach / 2 * (1 - np.cos(a)), z + rise + reach / 2 * np.sin(a)) for a in t]
    return [vec(0, 0, z), *bow, bow[-1] - vec(0, 0, drop)]


def spout(m: Model, style: str, part: str, z: float, r: float, tall: bool, n: int, lift: float = 0.05) -> tuple[Point, Point]:
    """A spout from (0, 0, z) to the front; returns where it ends and the way the water goes."""
    reach = m.number(0.1, 0.2)
    sides = 4 if style == "hollow" or (style == "prop" and m.chance(0.4)) else n
    if tall:
        path = _arc(z, reach, m.number(0.08, 0.2), m.number(0.01, 0.06), 5 if n < 12 else 13)
    else:
        lift, fall = m.number(0.0, lift), m.number(0.005, 0.03)
        points = [(0, 0), (0.25, 0.8), (0.6, 1.0), (0.9, 0.8), (1.0, 0.6)]
        path = [vec(0, -a * reach, z + b * lift - fall * (a > 0.95)) for a, b in points]
    shape = (r, 0.8 * r, 0.75 * r) if tall else (r, 0.9 * r, 0.7 * r)
    m.add(part, hose(path, shape, sides, style != "sheet"))
    end, way = path[-1], (path[-1] - path[-2]) / np.linalg.norm(path[-1] - path[-2])
    if style in ("assembly", "product"):
        m.add(part, aimed(band(0.5 * r, 0.85 * r, (-0.006, 0.006), n), way, end))
    if style == "antique":
        m.add(part, ball(path[len(path) // 2], (1.3 * r, 1.3 * r, 1.3 * r), n), ring(end, way, 0.8 * r, 0.3 * r, n))
    return end, way


def tap_handle(m: Model, style: str, name: str, at: Point, axis: Point, r: float, n: int, form: str, side: int = 1) -> None:
    """A cross, a wheel, a knob or a quarter turn lever on a stem standing on a point."""
    p = np.asarray(at, float)
    tall = m.number(1.6, 2.6) * r
    solids = [lathed([(0, -0.002), (1.0 * r, -0.002), (0.8 * r, 0.5 * tall), (0.6 * r, tall), (0, tall)], n)]
    long = m.number(2.2, 3.5) * r
    if form == "cross":
        arms = m.pick(3, 4, 4, 5)
        for k in range(arms):
            d = vec(np.cos(2 * np.pi * k / arms), np.sin(2 * np.pi * k / arms), 0)
            c = vec(0, 0, 0.85 * tall)
            solids.append(rod(c, c + long * d, 0.28 * r, 6 if n < 12 else 10))
            if style in ("antique", "product"):
                solids.append(ball(c + long * d, (0.42 * r, 0.42 * r, 0.42 * r), 8))
        solids.append(ball((0, 0, tall), (0.7 * r, 0.7 * r, 0.4 * r), n))
    elif form == "lever":
        begin, end = vec(0, 0, 0.9 * tall), vec(side * 2.2 * long, 0, (0.9 + m.number(0, 0.4)) * tall)
        bars = {
            "antique": hose(
                [(0, -t * 2.0 * long, 0.9 * tall) for t in (0, 0.3, 0.6, 1)], (0.3 * r, 0.5 * r, 0.3 * r, 0.6 * r), 8
            )
        }
        lever = bars.get(style) or bar(begin, end, 0.9 * r, 0.4 * r, (0, 1, 0))
        solids += [turned(lever, (0, 0, 1), side * 90, (0, 0, 0)) if style == "antique" else lever]
    elif form == "wheel":
        solids += [ring((0, 0, 0.9 * tall), (0, 0, 1), 0.7 * long, 0.22 * r, max(n, 12))]
        solids += [bar((-0.7 * long, 0, 0.9 * tall), (0.7 * long, 0, 0.9 * tall), 0.3 * r, 0.25 * r, (0, 1, 0))]
        solids += [bar((0, -0.7 * long, 0.9 * tall), (0, 0.7 * long, 0.9 * tall), 0.3 * r, 0.25 * r)]
    else:
        solids += [rod((0, 0, 0.4 * tall), (0, 0, 1.05 * tall), 1.35 * r, 6 if style in ("prop", "sheet") else n)]
        solids += [box((-0.1 * r, 0.1 * r), (0, 1.3 * r), (1.0 * tall, 1.1 * tall))]
    m.add(name, *(aimed(s, axis, p) for s in solids))
    if style == "assembly":
        m.add(name, *bolt(p + 1.02 * tall * np.asarray(axis, float), axis, 0.3 * r))
    if form == "lever":
        m.hinge(name, p, tuple(-side * v for v in axis), 90)
    else:
        m.spin(name, p, axis)


def deck_plate(m: Model, style: str, wide: float, deep: float, n: int) -> float:
    """What stands on the basin: a rosette, a deck plate, or the basin's own board; returns its height."""
    if wide < 1.5 * deep:
        m.add(BASE, lathed([(0, 0), (deep, 0), (deep, 0.004), (0.75 * deep, 0.012), (0, 0.012)], n))
        return 0.011
    m.add(BASE, slab(style, (-wide, wide), (-deep, deep), (0, 0.014)))
    return 0.013


def post(m: Model, style: str, part: str, z: tuple[float, float], r: float, n: int, at: Point = (0, 0, 0)) -> None:
    """A post between two heights."""
    x, y, _ = at
    if style == "antique":
        m.add(part, baluster(*z, 1.25 * r, n, at))
    elif style == "hollow":
        m.add(part, slab("prop", (x - r, x + r), (y - r, y + r), z))
    elif style == "sheet":
        m.add(part, lathed([(r, z[0]), (r, z[1]), (0, z[1])], n, at))
    else:
        m.add(part, lathed([(0, z[0]), (1.1 * r, z[0]), (r, z[0] + 0.15 * (z[1] - z[0])), (r, z[1]), (0, z[1])], n, at))


def _stopper(m: Model, y: float, z: float) -> None:
    """The rod of the waste behind the spout, pulled up."""
    if m.chance(0.35):
        m.add(
            "stopper_rod",
            rod((0, y, z - 0.004), (0, y, z + 0.05), 0.0025, 8),
            ball((0, y, z + 0.053), (0.006, 0.006, 0.006), 8),
        )
        m.slide("stopper_rod", (0, 0, 1), 0.025)


def _wall(m: Model, style: str, r: float, n: int, shape: str) -> None:
    """A spout between two handles on a plate on the wall."""
    spread = m.number(0.07, 0.12)
    depth = m.number(0.004, 0.012)
    m.add(BASE, slab(style, (-spread - 0.045, spread + 0.045), (0, depth), (-0.04, 0.04), "+y"))
    end = -m.number(0.1, 0.2)
    down = m.number(0.01, 0.05)
    path = [
        vec(0, depth, 0),
        vec(0, 0.4 * end, 0.0),
        vec(0, 0.85 * end, 0),
        vec(0, end, -0.3 * down),
        vec(0, end - 0.004, -down),
    ]
    m.add(BASE, hose(path, (1.1 * r, 0.9 * r, 0.8 * r), 4 if style == "hollow" else n, style != "sheet"))
    for s, name in ((-1, "left"), (1, "right")):
        tap_handle(m, style, f"handle_{name}", (s * spread, 0.001, 0), (0, -1, 0), r, n, shape, s)


def _pillar(m: Model, style: str, r: float, n: int, shape: str) -> None:
    """A post with a short spout and a handle on top."""
    low = deck_plate(m, style, 0, 2 * r, n)
    top = m.number(0.07, 0.13)
    post(m, style, BASE, (low, top), 1.2 * r, n)
    spout(m, style, BASE, m.number(0.5, 0.7) * top, 0.9 * r, False, n, 0.15 * top)
    tap_handle(m, style, "handle", (0, 0, top), (0, 0, 1), r, n, shape)


def _block(m: Model, style: str, r: float, *_: object) -> None:
    """A square post with a trough or a beam, and a flat lever that lifts."""
    w, top = 1.6 * r, m.number(0.1, 0.22)
    body = slab("product" if style == "product" else "prop", (-w, w), (-0.16, w), (0.78 * top, top))
    trough = box((-0.7 * w, 0.7 * w), (-0.2, -0.4 * w), (0.9 * top, top + 0.01))
    m.add(BASE, slab(style, (-w, w), (-w, w), (0, 0.8 * top)), cut(body, trough) if m.chance(0.6) else body)
    m.add("lever", slab(style, (-0.9 * w, 0.9 * w), (-0.8 * w, 0.9 * w), (top, top + 0.014)))
    m.add("lever", bar((0, 0.5 * w, top + 0.008), (0, -0.06, top + 0.022), 0.8 * w, 0.006))
    m.hinge("lever", (0, 0.8 * w, top + 0.003), (-1, 0, 0), 25)
    _stopper(m, w + 0.0015, 0.6 * top)


def _pair(m: Model, style: str, r: float, n: int, shape: str) -> None:
    """A spout between two handles, on one plate or each on its own rosette."""
    joined = m.chance(0.5)
    spread = m.number(0.06, 0.12)
    low = deck_plate(m, style, spread + 0.03 if joined else 0, 0.028, n)
    tall, top = m.chance(0.5), m.number(0.03, 0.06)
    part = "spout" if tall and m.chance(0.7) else BASE
    post(m, style, BASE, (low - 0.001, top), 1.3 * r, n)
    if part == "spout":
        m.add(part, rod((0, 0, top + 0.001), (0, 0, top + 0.014), 1.15 * r, n))
        m.hinge(part, (0, 0, top), (0, 0, 1), (-60, 60))
    spout(m, style, part, top + (0.01 if tall else -0.012), 0.9 * r, tall, n)
    for s, name in ((-1, "left"), (1, "right")):
        if not joined:
            m.add(BASE, lathed([(0, 0), (1.8 * r, 0), (1.6 * r, 0.01), (0, 0.01)], n, (s * spread, 0, 0)))
        post(m, style, BASE, (low - 0.002, 0.6 * top), 1.1 * r, n, (s * spread, 0, 0))
        tap_handle(m, style, f"handle_{name}", (s * spread, 0, 0.6 * top), (0, 0, 1), r, n, shape, s)
    _stopper(m, 1.3 * r + 0.002, low)
    if not joined:
        _basin(m, style)


def _basin(m: Model, style: str) -> None:
    wide, deep = m.number(0.16, 0.28), m.number(0.05, 0.09)
    m.add(BASE, slab(style, (-wide, wide), (-deep, deep), (-0.02, 0.001)))


def basin_faucet(m: Model) -> None:
    """A pillar tap, a spout between two handles, or both on a wall; a rod for the waste in some."""
    style, r = convention(m), m.number(0.011, 0.018)
    form = m.pick(_wall, _pillar, _block, _pair, _pair)
    form(m, style, r, rounds(m, style), m.pick(*HANDLES))
    if form in (_pillar, _block) and m.chance(0.3):
        _basin(m, style)
