"""Things that decorate a room and have a mechanism: music boxes, grandfather clocks, globes."""

from __future__ import annotations

import numpy as np

from training.kinds.cabinets.cabinets import legs
from training.kinds.joinery import face, pull, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, hang
from training.kinds.solids import arch, ball, box, common, cut, loft, prism, rectangle, ring, rod, tube, turned, vec


def music_box(m: Model) -> None:
    """Make a box with a lid, a figure that turns, a crank or key, perhaps a drawer."""
    wide, deep, high, wall, n = m.number(0.12, 0.25), m.number(0.1, 0.18), m.number(0.05, 0.12), 0.006, m.sections()
    slot = m.pick(0.0, 0.0, 0.035)
    floor, gap, how = slot + m.number(0.2, 0.6) * (high - slot), m.gap(0.2), m.pick("flat", "flat", "vault", "cap")
    body = box((0, wide), (0, deep), (0, high))
    m.add(BASE, cut(body, box(shrunk((0, wide), wall), shrunk((0, deep), wall), (floor, high + 1))) if m.chance(0.8) else body)
    for a in m.pick((), (0.0, wide)):
        m.add(BASE, *(ball((a, b, 0.0), (0.008,) * 3, 8) for b in (0.004, deep - 0.004)))
    if m.chance(0.4):
        m.add(BASE, prism(rectangle((-0.006, wide + 0.006), (-0.006, deep + 0.006), 0.0055), "z", (0.0, 0.012)))
    over, z = m.pick(0.0, 0.004), high + gap
    x, y = (-over, wide + over), (-over, deep + over)
    lid = [prism(rectangle(x, y), "z", (z, z + 0.008))]
    if how == "vault":
        lid = [prism(arch(y, (z, z + 0.4 * deep), 0.38 * deep, m.pick(8, 16)), "x", x)]
    elif how == "cap":
        lid = [cut(box(x, y, (z, z + 0.03)), box(shrunk(x, wall), shrunk(y, wall), (z - 1, z + 0.024)))]
    if m.chance(0.4) and how != "vault":
        top = lid[0].bounds[1, 2]
        lid.append(prism(rectangle(shrunk(x, 0.02), shrunk(y, 0.02), 0.005), "z", (top, top + 0.003)))
    m.add("lid", *lid)
    about = (wide / 2, y[1], high + max(gap, 0.0))
    m.hinge("lid", about, (-1, 0, 0), m.number(80, 110))
    if m.chance(0.5):
        m.add(
            m.pick("lid", BASE),
            *(rod((c - 0.01, y[1], about[2]), (c + 0.01, y[1], about[2]), 0.003, 8) for c in (0.25 * wide, 0.75 * wide)),
        )
    if m.chance(0.5):
        m.add("lid", ball((wide / 2, y[0] - 0.003, z + 0.004), (0.005,) * 3, 8))
    side = m.pick(-1, 1)
    at = np.array([wide if side > 0 else 0.0, deep / 2, 0.6 * high])
    if m.chance(0.8):
        out = np.array([side * 0.02, 0, 0])
        m.add("crank", rod(at, at + out, 0.003, 8))
        if m.chance(0.6):
            m.add(
                "crank",
                box((at + out)[0] + np.array((-0.002, 0.002)), (at[1] - 0.004, at[1] + 0.028), (at[2] - 0.004, at[2] + 0.004)),
            )
            m.add("crank", rod(at + out + (0.0, 0.025, 0), at + 1.8 * out + (0.0, 0.025, 0), 0.004, 8))
        else:
            m.add("crank", *(ball(at + out + (0.0, s * 0.01, 0), (0.003, 0.01, 0.007), 8) for s in (-1, 1)))
        m.spin("crank", at, (side, 0, 0))
    if m.chance(0.6) and floor < high - 0.01:  # a figure on a disc
        c = (wide * m.number(0.4, 0.6), deep / 2)
        room = 0.8 * (high - floor) if how == "flat" else high - floor + 0.01
        m.add("figure", rod((*c, floor), (*c, floor + 0.003), 0.02, n), rod((*c, floor), (*c, floor + 0.8 * room), 0.003, 6))
        m.add(
            "figure",
            loft(
                np.array(
                    [
                        [
                            (c[0] + r * np.cos(t), c[1] + r * np.sin(t), floor + h * room)
                            for t in np.linspace(0, 2 * np.pi, 8, endpoint=False)
                        ]
                        for h, r in ((0.3, 0.014), (0.6, 0.004), (0.75, 0.006))
                    ]
                )
            ),
        )
        m.add("figure", ball((*c, floor + 0.87 * room), (0.1 * room,) * 3, 8))
        m.spin("figure", (*c, floor), (0, 0, 1))
        m.add(BASE, box((0.05 * wide, 0.3 * wide), (0.2 * deep, 0.8 * deep), (floor, floor + 0.3 * room)))
    if slot and slot < floor - 0.004:
        m.add("drawer", box(shrunk((0, wide), 0.01), (-0.005, 0.0), (0.008, slot)))
        pull(m, "drawer", (wide / 2, slot / 2), -0.005, m.pick("ring", "knob", "none"), 0.02)
        m.slide("drawer", (0, -1, 0), 0.7 * deep)


def grandfather_clock(m: Model) -> None:
    """Make a long-case clock: a hood with a dial and hands, a trunk with a door, a pendulum and weights."""
    base, trunk, hood = m.number(0.4, 0.5), m.number(0.28, 0.34), m.number(0.38, 0.46)
    z1, z2, z3 = m.number(0.35, 0.55), m.number(1.25, 1.45), m.number(1.75, 1.95)
    deep, side, n, wall = m.number(0.22, 0.28), m.pick("left", "right"), m.pick(16, 24, 32), 0.018
    m.add(
        BASE,
        box((-base / 2, base / 2), (-0.02, deep), (0, z1)),
        box((-base / 2 - 0.02, base / 2 + 0.02), (-0.04, deep), (0, 0.08)),
    )
    face(m, BASE, shrunk((-base / 2, base / 2), 0.05), (-0.03, -0.02), (0.13, z1 - 0.05), m.pick("slab", "moulded", "raised"))
    for z, half in ((z1, base / 2), (z2, hood / 2)):
        m.add(BASE, box((-half - 0.015, half + 0.015), (-0.035, deep), (z - 0.02, z + 0.02)))
    x, y, z = (-trunk / 2, trunk / 2), (0.0, deep - 0.01), (z1 + 0.02, z2 - 0.02)
    hollow = m.chance(0.75)
    body = box(x, y, z)
    m.add(BASE, cut(body, box(shrunk(x, wall + 0.02), (-1, deep - 0.03), shrunk(z, wall + 0.02))) if hollow else body)
    a, b, gap = shrunk(x, wall), shrunk(z, wall), m.gap(0.3)
    a, b, front = shrunk(a, gap), shrunk(b, gap), (-0.016, 0.0)
    if hollow and m.chance(0.7):
        glazed(m, "door", a, front, b, 0.035)
    else:
        face(m, "door", a, front, b, m.pick("slab", "moulded", "framed", "raised"))
    edge = a[1] - 0.015 if side == "left" else a[0] + 0.015
    pull(m, "door", (edge, (b[0] + b[1]) / 2), front[0], m.pick("knob", "ring", "none"), 0.03)
    hang(m, "door", a, front, b, side, OUT, 110)
    x, c, r = (-hood / 2, hood / 2), (z2 + z3) / 2, 0.36 * hood
    m.add(
        BASE,
        box(x, (0.0, deep), (z2 + 0.02, z3)) if m.chance(0.5) else prism(rectangle(x, (z2 + 0.02, z3), 0.03), "y", (0.0, deep)),
        box(shrunk(x, 0.028), (0.012, 0.02), (z2 + 0.045, z3 - 0.025)),
    )
    f = -0.004
    m.add(BASE, rod((0, f, c), (0, 0.013, c), r, n), ring((0, f, c), (0, 1, 0), r, 0.008, n))
    for k in range(12):
        t = 2 * np.pi * k / 12
        m.add(
            BASE,
            turned(box((-0.004, 0.004), (f - 0.002, f), (c + 0.82 * r, c + 0.94 * r)), (0, 1, 0), np.degrees(t), (0, 0, c)),
        )
    time = m.number(0, 360)
    for part, long, half, out in (("minute", 0.85, 0.005, 0.012), ("hour", 0.55, 0.008, 0.007)):
        hand = prism(
            [
                (-half, c - 0.12 * r),
                (half, c - 0.12 * r),
                (half, c + 0.8 * long * r),
                (0, c + long * r),
                (-half, c + 0.8 * long * r),
            ],
            "y",
            (f - out, f - out + 0.003),
        )
        m.add(part, turned(hand, (0, 1, 0), time if part == "minute" else 30 * m.number(0, 12), (0, 0, c)))
        m.spin(part, (0, f, c), (0, 1, 0))
    m.add(m.pick("minute", BASE), rod((0, f - 0.015, c), (0, f, c), 0.006, 10))
    if hollow:  # a pendulum and weights
        py, low = 0.55 * deep, z1 + m.number(0.15, 0.25)
        m.add(
            "pendulum",
            rod((0, py, z2 - 0.05), (0, py, low), 0.004, 8),
            rod((0, py - 0.008, low), (0, py + 0.008, low), m.number(0.04, 0.06), n),
        )
        m.hinge("pendulum", (0, py, z2 - 0.05), (0, 1, 0), (-4, 4))
        for w in m.pick((), (-0.06, 0.06), (-0.08, 0.0, 0.08)):
            wz = m.number(z1 + 0.4, z2 - 0.3)
            m.add(
                BASE,
                rod((w, py - 0.05, wz), (w, py - 0.05, wz + 0.16), 0.016, 10),
                rod((w, py - 0.05, wz), (w, py - 0.05, z2 - 0.03), 0.002, 6),
            )
    if m.chance(0.6):
        a = shrunk(x, 0.01)
        door = prism(rectangle(a, (z2 + 0.03, z3 - 0.01), 0.025), "y", (-0.035, -0.022))
        m.add("hood", door)
        hang(m, "hood", a, (-0.035, -0.022), (z2 + 0.03, z3 - 0.01), side, OUT, 100)
    if m.chance(0.6):
        m.add(
            BASE,
            *(
                rod((s * (hood / 2 + 0.012), 0.0, z2 + 0.02), (s * (hood / 2 + 0.012), 0.0, z3), 0.012, m.sections())
                for s in (-1, 1)
            ),
        )
    crown = m.pick("flat", "arch", "gable", "horns")
    m.add(BASE, box(shrunk(x, -0.03), (-0.04, deep), (z3, z3 + 0.03)))
    if crown == "arch":
        m.add(BASE, prism(arch(x, (z3 + 0.03, z3 + 0.15), 0.12), "y", (-0.02, 0.05)))
    elif crown == "gable":
        m.add(BASE, prism([(x[0], z3 + 0.03), (x[1], z3 + 0.03), (0, z3 + 0.16)], "y", (-0.02, deep)))
    elif crown == "horns":
        m.add(
            BASE,
            *(
                prism(
                    [(s * hood / 2, z3 + 0.03), (s * 0.03, z3 + 0.03), (s * 0.03, z3 + 0.15), (s * 0.08, z3 + 0.15)],
                    "y",
                    (-0.02, 0.0),
                )
                for s in (-1, 1)
            ),
        )
        m.add(BASE, ball((0, -0.01, z3 + 0.08), (0.022, 0.022, 0.05), 10))


def globe_stand(m: Model) -> None:
    """Make a globe that turns in a tilted arc on a foot or in a floor stand, or whose upper half opens as a lid."""
    r, n, how = m.number(0.1, 0.25), m.pick(16, 24), m.pick("desk", "desk", "floor", "bar")
    c = np.array([0, 0, {"desk": 1.7, "floor": 3.4, "bar": 3.4}[how] * r])
    tilt = 0.0 if how == "bar" else np.radians(m.pick(0.0, 23.4, 23.4))
    axis = np.array([np.sin(tilt), 0, np.cos(tilt)])
    if how == "desk":
        t = np.linspace(-np.pi / 2, np.pi / 2, 14)
        arc = [c + 1.12 * r * np.array([np.cos(a) * np.cos(-tilt), 0, np.sin(a)]) for a in t] if not tilt else None
        if arc is None:
            u = np.array([np.cos(tilt), 0, -np.sin(tilt)])
            arc = [c + 1.12 * r * (np.cos(a) * u + np.sin(a) * axis) for a in t]
        m.add(BASE, tube(arc, 0.03 * r + 0.002, 6))
        low = arc[int(np.argmin([p[2] for p in arc]))][2]
        m.add(
            BASE,
            rod((0, 0, 0), (0, 0, 0.1 * r), 0.7 * r, n),
            rod((arc[3][0], 0, 0.05 * r), (arc[3][0], 0, max(arc[3][2], low)), 0.06 * r, 8),
        )
        m.add(m.pick(BASE, "globe"), rod(c - 1.13 * r * axis, c + 1.13 * r * axis, 0.02 * r, 8))
    else:
        m.add(BASE, ring(c, (0, 0, 1), 1.2 * r, 0.06 * r, n))
        for a in 2 * np.pi * np.arange(m.pick(3, 4)) / 4 + 0.4:
            p = np.array([np.cos(a), np.sin(a), 0])
            m.add(
                BASE,
                rod(c + 1.2 * r * p, np.array([1.1 * r * p[0], 1.1 * r * p[1], 0]), 0.05 * r, m.sections()),
                rod(0.3 * c + 1.1 * r * p, 0.3 * c, 0.03 * r, 6),
            )
        if m.chance(0.5):
            m.add(BASE, rod(0.3 * c - (0, 0, 0.02), 0.3 * c, 0.6 * r, n))
        if how == "floor":
            m.add(BASE, ring(c, np.cross(axis, (0, 1, 0)) if m.chance(0.5) else (0, 1, 0), 1.1 * r, 0.03 * r, n))
            m.add(m.pick(BASE, "globe"), rod(c - 1.1 * r * axis, c + 1.1 * r * axis, 0.02 * r, 8))
    sphere = ball(c, (r, r, r), n)
    if how == "bar":
        shell = cut(sphere, ball(c, (0.94 * r,) * 3, n)) if m.chance(0.7) else sphere
        big = box((-2 * r, 2 * r), (-2 * r, 2 * r), (c[2], c[2] + 2 * r))
        m.add("lid", common(shell, big))
        m.add(
            BASE,
            cut(shell, big),
            *(rod(c + vec(a, 0.1 * r, -0.5 * r), c + vec(a, 0.1 * r, -0.05 * r), 0.1 * r, 8) for a in (-0.3 * r, 0.2 * r)),
        )
        m.hinge("lid", c + vec(0, r, 0), (-1, 0, 0), m.number(80, 110))
        if m.chance(0.5):
            m.add("lid", ball(c + vec(0, -r, 0.05 * r), (0.05 * r,) * 3, 8))
        if m.chance(0.5):
            m.add(BASE, rod(c + vec(-0.15 * r, r, 0), c + vec(0.15 * r, r, 0), 0.03 * r, 8))
        return
    m.add("globe", sphere)
    for _ in range(m.pick(0, 4, 8)):  # raised land
        d = m.rng.normal(size=3)
        d /= np.linalg.norm(d)
        m.add("globe", common(ball(c + 0.8 * r * d, (m.number(0.25, 0.45) * r,) * 3, 8), ball(c, (1.012 * r,) * 3, n)))
    if m.chance(0.4):
        m.add("globe", ring(c, axis, r, 0.01 * r, n))
    m.spin("globe", c, axis)
    if m.chance(0.3) and how == "desk":
        legs(m, (-0.6 * r, 0.6 * r), (-0.6 * r, 0.6 * r), 0.04 * r, 0.1 * r)
