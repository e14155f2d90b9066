"""Travel suitcases by another hand: upright ones on wheels, a lying one with latches."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.maker_fronts import button
from training.kinds.maker_style import Maker, cuboid, maker, soft, without
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube, turned, vec


def travel_suitcase(m: Model) -> None:
    """An upright shell on two or four wheels with a handle that pulls out, or a lying case with latches and a handle."""
    k = maker(m)
    if k.way == "old" or m.chance(0.3):
        _lying_case(k, m.number(0.4, 0.75), m.number(0.28, 0.48), m.number(0.12, 0.24))
    else:
        _upright_case(k, m.number(0.34, 0.5), m.number(0.2, 0.3), m.number(0.46, 0.75))


def _half_shell(k: Maker, x: Span, y: Span, z: Span, open_to: int, axis: int, wall: float) -> list[Trimesh]:
    """Half of a case that is open to a side along an axis; solid where the inside is not modelled."""
    side = np.eye(3)[axis] * open_to
    if k.way == "sheet":
        return [without(box(x, y, z), side)]
    spans = [x, y, z]
    if k.way in ("soft", "low") and k.edge > 0.16:
        more = [list(s) for s in spans]
        more[axis][1 if open_to > 0 else 0] += open_to * 0.5
        r = (0.45 if k.way == "soft" else 0.25) * min(s[1] - s[0] for s in spans)
        outer = cut(soft(*(tuple(s) for s in more), r, 2 if k.way == "soft" else 0), _beyond(spans, axis, open_to))
    else:
        outer = box(x, y, z)
    if not k.inside:
        return [outer]
    inner = [[s[0] + wall, s[1] - wall] for s in spans]
    inner[axis][1 if open_to > 0 else 0] += open_to
    return [cut(outer, soft(*(tuple(s) for s in inner), 0.3 * min(s[1] - s[0] for s in spans), 1))]


def _beyond(spans: list[Span], axis: int, open_to: int) -> Trimesh:
    """All that lies beyond the open side."""
    wide = [(s[0] - 1, s[1] + 1) for s in spans]
    wide[axis] = (spans[axis][1], spans[axis][1] + 2) if open_to > 0 else (spans[axis][0] - 2, spans[axis][0])
    return box(*wide)


def _upright_case(k: Maker, wide: float, deep: float, high: float) -> None:
    """Two shells, the one in front opens to a side or down; wheels below, a handle behind."""
    m, foot, wall = k.m, k.m.number(0.03, 0.055), 0.006
    mid, g = deep * k.m.pick(0.3, 0.5, 0.5), abs(k.m.gap(deep)) + 0.001
    z = (foot, foot + high)
    m.add(BASE, *_half_shell(k, (0, wide), (mid, deep), z, -1, 1, wall))
    m.add("front_shell", *_half_shell(k, (0, wide), (0, mid - g), z, 1, 1, wall))
    side = m.pick("left", "left", "right", "right", "below")
    axis = {"left": (0, 0, -1), "right": (0, 0, 1), "below": (1, 0, 0)}[side]
    origin = (wide if side == "right" else 0.0, mid - g / 2, z[0])
    m.hinge("front_shell", origin, axis, m.pick(90, 120, 175) if side != "below" else 80)
    ribs = m.pick(0, 0, 4, 6)
    for x in np.linspace(0.16 * wide, 0.84 * wide, ribs):
        strip = ((x - 0.008, x + 0.008), (z[0] + 0.14 * high, z[1] - 0.14 * high))
        m.add("front_shell", box(strip[0], (-0.004, 0.004), strip[1]))
        m.add(BASE, box(strip[0], (deep - 0.004, deep + 0.004), strip[1]))
    if not ribs and m.chance(0.4):
        m.add(
            "front_shell",
            k.block((0.12 * wide, 0.88 * wide), (-0.025, 0.004), (z[0] + 0.12 * high, z[0] + 0.5 * high), (0, 1, 0)),
        )
    if k.way == "cad":
        away = wide if side == "left" else 0.0
        m.add(BASE, *(cuboid((away, mid + 0.012, u), (0.004, 0.011, 0.025)) for u in (z[0] + 0.3 * high, z[0] + 0.7 * high)))
    _casters(k, wide, (0.15 * deep, deep), foot)
    _pull_handle(k, wide, deep - 0.045, z)
    if m.chance(0.6):
        y = (mid + deep) / 2 - 0.02 if mid < 0.45 * deep else mid + 0.025
        _bail(k, "top_handle", (wide / 2, y, z[1]), 0.13, m.pick(0, 0, 80))


def _casters(k: Maker, wide: float, y: Span, foot: float) -> None:
    """Two wheels on an axle behind and feet in front, or swivelling ones at the corners."""
    m, r = k.m, 0.42 * foot
    front, deep = y
    if m.chance(0.4):
        for i, x in enumerate((0.05, wide - 0.05)):
            at = vec(x, deep - 0.03, r)
            m.add(f"wheel_{i}", rod(at - vec(0.012, 0, 0), at + vec(0.012, 0, 0), r, k.n))
            m.spin(f"wheel_{i}", at, (1, 0, 0))
            m.add(
                BASE,
                *(
                    box((x + s * 0.013, x + s * 0.018), (at[1] - 0.6 * r, at[1] + 0.6 * r), (0.5 * r, foot + 0.02))
                    for s in (-1, 1)
                ),
            )
            m.add(BASE, rod(at - vec(0.018, 0, 0), at + vec(0.018, 0, 0), 0.2 * r, 8))
            m.add("front_shell", k.block((x - 0.012, x + 0.012), (front, front + 0.03), (0, foot + 0.02)))
        return
    spots = [(x, w, part) for x in (0.06, wide - 0.06) for w, part in ((front + 0.01, "front_shell"), (deep - 0.04, BASE))]
    for i, (x, w, parent) in enumerate(spots):
        turn, lean = m.number(0, 360), 0.35 * r
        solids = [
            rod((x, w, 2.1 * r), (x, w, foot + 0.015), 0.4 * r, k.n),
            box((x - 0.012, x + 0.012), (w - 0.5 * r, w + lean), (1.9 * r, 2.2 * r)),
        ]
        solids += [box((x + s * 0.009, x + s * 0.012), (w, w + 0.6 * r), (0.7 * r, 2.0 * r)) for s in (-1, 1)]
        m.add(f"caster_{i}", *(turned(s, (0, 0, 1), turn, (x, w, 0)) for s in solids))
        m.spin(f"caster_{i}", (x, w, foot), (0, 0, 1), parent)
        wheel = rod((x - 0.008, w + lean, 0.95 * r), (x + 0.008, w + lean, 0.95 * r), 0.95 * r, k.n)
        m.add(f"wheel_{i}", turned(wheel, (0, 0, 1), turn, (x, w, 0)))
        t = np.deg2rad(turn)
        m.spin(f"wheel_{i}", (x - lean * np.sin(t), w + lean * np.cos(t), 0.95 * r), (np.cos(t), np.sin(t), 0), f"caster_{i}")


def _pull_handle(k: Maker, wide: float, y: float, z: Span) -> None:
    """Rods with a grip that come out of the top, in one or two stages, pushed in or partly out."""
    m, half = k.m, k.m.number(0.07, 0.12)
    out, length = m.pick(0.0, 0.0, 0.15, 0.3), 0.75 * (z[1] - z[0])
    stages = m.pick(1, 1, 2)
    parent, c = BASE, wide / 2
    m.add(
        BASE,
        *(
            box((c + s * half - 0.014, c + s * half + 0.014), (y - 0.012, y + 0.012), (z[1] - 0.006, z[1] + 0.004))
            for s in (-1, 1)
        ),
    )
    for i in range(stages):
        name, r = ("pull_handle", 0.0055) if i == stages - 1 else ("handle_tube", 0.008)
        up = out * (i + 1) / stages + (0.003 if name == "handle_tube" else 0.0)
        top = z[1] + up + 0.005
        m.add(
            name,
            *(
                rod((c + s * half, y, top - length + 0.004), (c + s * half, y, top + 0.012 * (i == stages - 1)), r, 10)
                for s in (-1, 1)
            ),
        )
        if name == "pull_handle":
            grip = ((c - half - 0.012, c + half + 0.012), (y - 0.012, y + 0.012), (top + 0.006, top + 0.028))
            m.add(name, k.block(*grip))
            if m.chance(0.4):
                button(k, "release_key", (c, y, top + 0.028), (0.015, 0.006), 0.004, (0, 0, 1), name)
        left = 0.45 * (z[1] - z[0]) / stages
        m.slide(name, (0, 0, 1), (-out / stages, max(left, 0.1)), parent)
        parent = name


def _bail(k: Maker, part: str, at: tuple[float, float, float], long: float, lean: float, parent: str = BASE) -> None:
    """A handle on a top that folds: it lies towards the back or stands up by `lean` [deg]."""
    x, y, z = at
    h = 0.032
    axle = z + 0.008
    path = [
        vec(x - long / 2, y, axle),
        vec(x - 0.4 * long, y + h, axle),
        vec(x + 0.4 * long, y + h, axle),
        vec(x + long / 2, y, axle),
    ]
    solids = (
        [tube(path, 0.006, k.n)]
        if k.m.chance(0.6)
        else [
            prism(
                rounded((x - long / 2, x + long / 2), (y - 0.006, y + h), 0.006).difference(
                    rounded((x - 0.38 * long, x + 0.38 * long), (y - 0.01, y + 0.6 * h), 0.004)
                ),
                "z",
                (axle - 0.004, axle + 0.004),
            )
        ]
    )
    k.m.add(part, *(turned(s, (1, 0, 0), lean, (x, y, axle)) for s in solids))
    k.m.add(
        parent,
        *(
            box((x + s * 0.53 * long - 0.008, x + s * 0.53 * long + 0.008), (y - 0.009, y + 0.009), (z - 0.002, z + 0.016))
            for s in (-1, 1)
        ),
    )
    k.m.hinge(part, (x, y, axle), (1, 0, 0), (-lean, 90 - lean))


def _lying_case(k: Maker, wide: float, deep: float, high: float) -> None:
    """A tray and a lid hinged behind; latches, a handle in front, corners, straps, number wheels."""
    m, cut_at, wall = k.m, high * k.m.pick(0.5, 0.6, 0.75), 0.006
    g = abs(m.gap(high)) * 0.5 + 0.0005
    m.add(BASE, *_half_shell(k, (0, wide), (0, deep), (0, cut_at), 1, 2, wall))
    m.add("lid", *_half_shell(k, (0, wide), (0, deep), (cut_at + g, high), -1, 2, wall))
    m.hinge("lid", (0, deep, cut_at + g / 2), (-1, 0, 0), m.pick(90, 105, 150))
    if k.way in ("old", "cad"):
        for x in (0.0, wide):
            for y in (0.0, deep):
                for part, z in ((BASE, 0.0), ("lid", high)):
                    m.add(part, _corner(x, y, z, (wide, deep)))
    if k.way == "old" or m.chance(0.3):
        for x in (0.22 * wide, 0.78 * wide):
            m.add(
                BASE,
                box((x - 0.014, x + 0.014), (-0.003, deep + 0.003), (-0.003, 0.004)),
                box((x - 0.014, x + 0.014), (-0.003, 0.001), (0, 0.75 * cut_at)),
            )
            m.add("lid", box((x - 0.014, x + 0.014), (-0.003, deep + 0.003), (high - 0.004, high + 0.003)))
    _latches(k, wide, cut_at, g)
    z, y = 0.5 * cut_at, 0.0
    posts = [
        box((wide / 2 + s * 0.075 - 0.008, wide / 2 + s * 0.075 + 0.008), (-0.014, 0.002), (z - 0.009, z + 0.009))
        for s in (-1, 1)
    ]
    m.add(BASE, *posts)
    path = [
        vec(wide / 2 - 0.068, y - 0.008, z),
        vec(wide / 2 - 0.055, y - 0.01, z - 0.035),
        vec(wide / 2 + 0.055, y - 0.01, z - 0.035),
        vec(wide / 2 + 0.068, y - 0.008, z),
    ]
    m.add("handle", tube(path, 0.006, k.n))
    m.hinge("handle", (wide / 2, -0.008, z), (-1, 0, 0), m.pick(90, 110))


def _corner(x: float, y: float, z: float, size: Span) -> Trimesh:
    """A cap over a corner."""
    s = 0.032
    spans = [
        tuple(sorted((c - sign * 0.002, c + sign * s)))
        for c, sign in ((x, 1 if x < size[0] / 2 else -1), (y, 1 if y < size[1] / 2 else -1), (z, 1 if z == 0 else -1))
    ]
    return box(*spans)


def _latches(k: Maker, wide: float, z: float, g: float) -> None:
    """Two hasps on the lid's or the tray's front that swing up or down, with or without number wheels."""
    m, hung = k.m, k.m.pick("lid", BASE)
    half = m.number(0.012, 0.02)
    for i, x in enumerate((0.2 * wide, 0.8 * wide)):
        m.add(BASE, box((x - 1.4 * half, x + 1.4 * half), (-0.004, 0.001), (z - 0.034, z - 0.002)))
        m.add("lid", box((x - 1.4 * half, x + 1.4 * half), (-0.004, 0.001), (z + g + 0.002, z + g + 0.022)))
        up = z + g + 0.016 if hung == "lid" else z - 0.028
        m.add(f"latch_{i}", k.block((x - half, x + half), (-0.01, -0.0045), (z - 0.03, z + g + 0.018)))
        m.hinge(f"latch_{i}", (x, -0.007, up), (-1, 0, 0) if hung == "lid" else (1, 0, 0), m.pick(70, 120), hung)
        if k.way == "cad" and m.chance(0.6):
            for n in range(3):
                at = vec(x + (1.9 * half + 0.008 + 0.006 * n) * (1 if i == 0 else -1), -0.001, z - 0.018)
                m.add(f"number_{i}_{n}", rod(at - vec(0.0024, 0, 0), at + vec(0.0024, 0, 0), 0.006, 10))
                m.spin(f"number_{i}_{n}", at, (1, 0, 0))
