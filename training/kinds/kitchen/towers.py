"""Appliances above one another: a dryer on a washer, ovens in a tall cabinet; refrigerators of several styles."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.kitchen.appliances import controls
from training.kinds.kitchen_parts import Look, door, drawer, pull, rack
from training.kinds.kitchen_trims import feet
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, hang, middle
from training.kinds.shells import Room, manner, place
from training.kinds.solids import Span, ball, box, cut, prism, rod, tube, vec

FRONT = (0, -1, 0)


def _porthole(m: Model, part: str, at: tuple[float, float], r: float, side: str, hollow: bool) -> None:
    """A round door with its glass, hinged at a side."""
    n, out, s = m.pick(16, 24, 32), m.number(0.025, 0.05), -1 if side == "left" else 1
    center, face = vec(at[0], 0, at[1]), vec(0, -out, 0)
    ring = prism(
        Spot(at).buffer(r, quad_segs=n // 4).difference(Spot(at).buffer(0.68 * r, quad_segs=n // 4)), "y", (-out, -0.001)
    )
    bowl = ball(center + 0.5 * face, (0.69 * r, m.pick(0.4, 0.9) * out, 0.69 * r), n)
    m.add(part, ring, bowl if m.chance(0.5) else rod(center + 0.3 * face, center + 0.7 * face, 0.69 * r, n))
    grip = m.pick("block", "notch", "none")
    c = at[0] - s * 0.86 * r
    if grip == "block":
        m.add(part, box((c - 0.015, c + 0.015), (-out - 0.014, -out), (at[1] - 0.05, at[1] + 0.05)))
    elif grip == "notch":
        m.add(part, box((c - 0.025, c + 0.025), (-out - 0.003, -out), (at[1] - 0.03, at[1] + 0.03)))
    pin = at[0] + s * r
    m.add(BASE, box((pin - 0.01, pin + 0.02), (-0.6 * out, 0), (at[1] - 0.05, at[1] + 0.05)))
    if hollow and m.chance(0.6):  # a gasket
        m.add(BASE, prism(Spot(at).buffer(0.8 * r).difference(Spot(at).buffer(0.7 * r)), "y", (-0.0005, 0.02)))
    m.hinge(part, (pin, -m.pick(0.0, 0.5) * out, at[1]), (0, 0, s), m.pick(110, 150, 170))


def _machine(m: Model, name: str, wide: float, deep: float, z: Span, side: str, plan: tuple[bool, bool, float, float]) -> None:
    """One front loader: a shell, a porthole, a drum, a drawer for soap or water, knobs, a flap for the filter below."""
    washer, above, r, room = plan  # room: height of the panel of controls
    wide_z = z[1] - z[0]
    at = (wide / 2, z[0] + (0.5 * (wide_z - room) if above else room + 0.5 * (wide_z - room)) + m.number(-0.01, 0.02))
    hollow, n = m.chance(0.7), m.pick(16, 24)
    strip = (z[1] - room, z[1] - 0.015) if above else (z[0] + 0.01, z[0] + room)
    left, soap = m.chance(0.8), washer or m.chance(0.5)
    slot = (0.012, 0.2) if left else (wide - 0.2, wide - 0.012)
    shell = box((0, wide), (0, deep), z)
    if hollow and soap:
        shell = cut(shell, box((slot[0] + 0.01, slot[1] - 0.01), (-1, 0.36), (strip[0] + 0.014, strip[1] - 0.01)))
    if hollow:
        shell = cut(shell, rod((at[0], -1, at[1]), (at[0], deep - 0.06, at[1]), 0.82 * r, n))
    m.add(BASE, shell)
    _porthole(m, f"{name}_door", at, r, side, hollow)
    if hollow:
        pipe = rod((at[0], 0.04, at[1]), (at[0], deep - 0.07, at[1]), 0.8 * r, n)
        m.add(f"{name}_drum", cut(pipe, rod((at[0], -1, at[1]), (at[0], deep - 0.08, at[1]), 0.76 * r, n)))
        m.add(f"{name}_drum", box((at[0] - 0.012, at[0] + 0.012), (0.06, deep - 0.09), (at[1] - 0.78 * r, at[1] - 0.6 * r)))
        m.spin(f"{name}_drum", (at[0], 0.1, at[1]), (0, -1, 0))
    free = (slot[1], wide - 0.004) if left else (0.004, slot[0])
    m.add(BASE, box(free if soap else (0.004, wide - 0.004), (-0.004, 0), strip))
    front = Look(m.pick("slab", "rounded"), m.pick("none", "cup", "groove"), 0.012, None, 0.005, 0.5)
    if soap:
        drawer(
            m, f"{name}_drawer", slot, (strip[0] + 0.008, strip[1] - 0.004), 0.35, front, "box" if hollow else "none", "middle"
        )
    sub = Model(m.rng)
    controls(sub, (0.22, wide - 0.03) if left else (0.03, wide - 0.22), -0.004, (strip[0] + 0.01, strip[1]), most=2)
    m.pieces += [(p if p == BASE else f"{name}_{p}", solid) for p, solid in sub.pieces]
    m.joints |= {f"{name}_{p}": j for p, j in sub.joints.items()}
    if above and at[1] - r - z[0] > 0.13 and m.chance(0.6):
        a = m.pick((0.03, 0.17), (wide - 0.17, wide - 0.03))
        door(m, f"{name}_filter_flap", a, (z[0] + 0.02, z[0] + 0.11), m.pick("bottom", "left"), front, 90)


def washer_tower(m: Model) -> None:
    """A dryer above a washer: on a kit with a board that slides out, as one machine, or in a cupboard."""
    wide, deep, each, foot = m.pick(0.6, 0.6, 0.686), m.number(0.55, 0.68), m.number(0.82, 0.9), m.number(0.015, 0.04)
    style, r, side = m.pick("kit", "kit", "one", "cupboard"), m.number(0.19, 0.23), m.pick("left", "right")
    room = m.number(0.1, 0.14)
    if style == "one":
        m.add(BASE, box((0.02, wide - 0.02), (0.03, deep), (foot + each, foot + each + 0.012)))
    kit = m.pick(0.012, 0.06) if style != "one" else 0.012
    _machine(m, "washer", wide, deep, (foot, foot + each), side, (True, True, r, room))
    low = foot + each + kit
    _machine(m, "dryer", wide, deep, (low, low + each), side if m.chance(0.7) else "right", (False, style != "one", r, room))
    feet(m, (0, wide), (0, deep), foot)
    if kit > 0.05:
        m.add(BASE, *(box(s, (0.0, deep), (low - kit, low)) for s in ((0.0, 0.02), (wide - 0.02, wide))))
        m.add(BASE, box((0.02, wide - 0.02), (0.1, deep), (low - kit, low - kit + 0.006)))
        m.add("board", box((0.023, wide - 0.023), (-0.006, 0.8 * deep), (low - kit + 0.012, low - kit + 0.03)))
        m.add("board", box((0.023, wide - 0.023), (-0.02, -0.006), (low - kit + 0.008, low - 0.006)))
        m.slide("board", FRONT, m.number(0.25, 0.4))
    elif style == "kit":
        m.add(BASE, *(box(s, (0.02, deep - 0.02), (low - kit, low)) for s in ((0.0, 0.05), (wide - 0.05, wide))))
    top = low + each
    if style == "cupboard":
        m.add(BASE, *(box(s, (-0.02, deep + 0.02), (0, top + 0.05)) for s in ((-0.04, -0.02), (wide + 0.02, wide + 0.04))))
        m.add(BASE, box((-0.04, wide + 0.04), (-0.02, deep + 0.02), (top + 0.05, top + 0.07)))
        if m.chance(0.5):
            how = replace(manner(m), sunk=None)
            x = (-0.04, wide + 0.04)
            for part, a in (("lift_left", (x[0], middle(x))), ("lift_right", (middle(x), x[1]))):
                room_z = (top + 0.07, top + 0.42)
                m.add(BASE, *(box(s, (0.0, deep), room_z) for s in ((a[0], a[0] + 0.016), (a[1] - 0.016, a[1]))))
                door(m, part, a, room_z, "left" if part.endswith("left") else "right", how)
            m.add(BASE, box(x, (0.0, deep), (top + 0.42, top + 0.436)), box(x, (deep - 0.006, deep), (top + 0.07, top + 0.42)))
    elif m.chance(0.5):
        m.add(BASE, tube([(0.1, deep, 0.7), (0.1, deep + 0.06, 0.7), (0.1, deep + 0.06, 0.06)], 0.014, 8))
    if m.chance(0.4):
        m.add(
            BASE,
            box((0.1, wide - 0.1), (0.2, deep - 0.1), (top, top + 0.02))
            if style != "cupboard"
            else box((0, wide), (0, 0.01), (0, foot)),
        )


def _oven(m: Model, name: str, x: Span, z: Span, deep: float, plan: str, hollow: bool) -> None:
    """A built-in appliance: an oven or a steamer whose door falls, or a microwave whose door turns aside or falls."""
    if plan == "drawer":
        m.add(
            name, box(x, (-0.03, -0.001), z), box((x[0] + 0.02, x[1] - 0.02), (-0.001, 0.8 * deep), (z[0] + 0.02, z[1] - 0.03))
        )
        m.slide(name, FRONT, 0.3)
        return
    strip = m.number(0.08, 0.12) if plan != "microwave" or m.chance(0.4) else 0.0
    thick = m.number(0.02, 0.035)
    panel = (z[1] - strip, z[1])
    side = m.pick("left", "left", "bottom") if plan == "microwave" else "bottom"
    column = 0.0 if strip else m.number(0.1, 0.13)
    a, b = (x[0], x[1] - column), (z[0], z[1] - strip)
    if strip or column:
        m.add(BASE, box(x if strip else (a[1], x[1]), (-thick, 0.0), panel if strip else z))
    y = (-thick - 0.001, -0.001)
    glazed(
        m,
        name,
        (a[0] + 0.002, a[1] - 0.002),
        y,
        (b[0] + 0.002, b[1] - 0.003),
        m.number(0.05, 0.09) * (0.6 if plan == "microwave" else 1.0),
    )
    if m.chance(0.4):
        m.add(name, box((a[0] + 0.002, a[1] - 0.002), (y[0] - 0.003, y[0]), (b[0] + 0.002, b[1] - 0.003)))
        y = (y[0] - 0.003, y[1])
    how = Look("slab", m.pick("bar", "rail", "rail", "rim", "merged"), thick, None, 0.0, m.pick(0.7, 0.85))
    pull(m, name, how, a, y[0], b, {"bottom": "top", "left": "right"}[side])
    hang(m, name, a, y, b, side, OUT, 90 if side == "bottom" else m.pick(100, 120))
    sub = Model(m.rng)
    span = (x[0] + 0.03, x[1] - 0.03) if strip else (a[1] + 0.01, x[1] - 0.01)
    controls(sub, span, -thick, panel if strip else (z[0] + 0.4 * (z[1] - z[0]), z[1] - 0.02), most=3 if strip else 1)
    m.pieces += [(p if p == BASE else f"{name}_{p}", solid) for p, solid in sub.pieces]
    m.joints |= {f"{name}_{p}": j for p, j in sub.joints.items()}
    if hollow:
        _cavity(m, name, (x, z), (a, b), deep, plan)


def _cavity(m: Model, name: str, outer: Room, inner: Room, deep: float, plan: str) -> None:
    """The inside of an oven with racks, or of a microwave with its plate."""
    (x, z), (a, b) = outer, inner
    m.add(
        BASE,
        cut(
            box((x[0] + 0.01, x[1] - 0.01), (0.0, deep - 0.06), (z[0] + 0.005, z[1] - 0.005)),
            box((a[0] + 0.05, a[1] - 0.05), (-1, deep - 0.09), (b[0] + 0.05, b[1] - 0.04)),
        ),
    )
    if plan == "microwave":
        at = (middle(a), deep / 2, b[0] + 0.055)
        m.add("plate", rod(at, (at[0], at[1], at[2] + 0.008), min(0.15, 0.33 * deep, 0.4 * (a[1] - a[0]) - 0.05), 20))
        m.spin("plate", at, (0, 0, 1))
    else:
        for k, c in enumerate(np.linspace(b[0] + 0.1, b[1] - 0.12, m.pick(1, 2))):
            rack(m, f"{name}_rack_{k}", (a[0] + 0.056, a[1] - 0.056), (0.03, deep - 0.1), float(c))
            m.slide(f"{name}_rack_{k}", FRONT, 0.3, BASE)


def oven_tower(m: Model) -> None:
    """A tall cabinet with an oven, a microwave or a second oven above it, a drawer or doors below, doors above."""
    wide, deep, foot, t, how = m.number(0.6, 0.66), m.number(0.56, 0.62), m.pick(0.1, 0.15), 0.018, manner(m)
    below, above = (
        m.pick(["drawer"], ["drawer", "drawer"], ["left"]),
        m.pick(["right"], ["left"], ["pair"], ["top"], ["open"], []),
    )
    plan = m.pick(["oven", "microwave"], ["oven"], ["oven", "oven"], ["oven", "drawer", "microwave"], ["oven", "steamer"])
    tall = {"oven": 0.595, "microwave": m.number(0.36, 0.42), "drawer": 0.14, "steamer": 0.455}
    jobs = [*((job, m.number(0.18, 0.3) if job == "drawer" else 0.55) for job in below)]
    jobs += [(f"!{what}", tall[what]) for what in plan] + [(job, m.number(0.35, 0.6)) for job in above]
    high = foot + sum(h for _, h in jobs) + t * (len(jobs) + 1)
    m.add(BASE, *(box(s, (0.0, deep), (foot, high)) for s in ((0.0, t), (wide - t, wide))))
    m.add(BASE, box((t, wide - t), (deep - 0.006, deep), (foot, high)))
    at, hollow = foot, m.chance(0.6)
    for k, (job, size) in enumerate(jobs):
        m.add(BASE, box((t, wide - t), (0.0, deep - 0.006), (at, at + t)))
        room: Room = (t, wide - t), (at + t, at + t + size)
        if job.startswith("!"):
            _oven(m, f"{job[1:]}_{k}", (0.003, wide - 0.003) if m.chance(0.7) else room[0], room[1], deep, job[1:], hollow)
        else:
            place(m, f"{'drawer' if job == 'drawer' else 'door'}_{k}", job, room, how, deep, t)
        at = room[1][1]
    m.add(BASE, box((t, wide - t), (0.0, deep - 0.006), (at, high)))
    feet(m, (0, wide), (0, deep), foot)
    if m.chance(0.3):
        m.add(
            BASE, box((-0.02, 0.0), (-0.02, deep), (0, high + 0.02)), box((wide, wide + 0.02), (-0.02, deep), (0, high + 0.02))
        )
    if m.chance(0.3):
        m.add(BASE, box((-0.01, wide + 0.01), (-0.03, deep), (high, high + 0.04)))
