"""Robots: an arm of four to six joints, a parallel gripper, a walker on four legs."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, rounded, tube, vec
from training.kinds.wheels import beam, lathe


def link_solids(m: Model, a, b, w: float, style: str) -> list[Trimesh]:
    """A limb between two joints."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    if style == "round":
        return [rod(a, b, 0.5 * w, 12), ball(b, (0.5 * w,) * 3, 10)]
    if style == "plates":
        return [beam(a + vec(s * 0.5 * w, 0, 0), b + vec(s * 0.5 * w, 0, 0), 0.12 * w, 0.7 * w) for s in (-1, 1)] + [
            rod((a + b) / 2 - vec(0.5 * w, 0, 0), (a + b) / 2 + vec(0.5 * w, 0, 0), 0.15 * w, 8)
        ]
    if style == "taper":
        return [beam(a, b, w, 1.1 * w, taper=0.65)]
    return [beam(a, b, 0.8 * w, 0.8 * w)]


def robot_arm(m: Model) -> None:
    """Base, turning column, shoulder, elbow and wrist joints, perhaps a tool or a gripper with two fingers."""
    w, n, style = m.number(0.06, 0.14), m.pick(12, 16, 24), m.pick("round", "plates", "taper", "square")
    floor = m.number(0.8, 1.6) * w
    m.add(
        BASE,
        rod((0, 0, 0), (0, 0, 0.6 * floor), 1.3 * w, n)
        if m.chance(0.5)
        else prism(rounded((-1.4 * w, 1.4 * w), (-1.4 * w, 1.4 * w), 0.2 * w), "z", (0, 0.6 * floor)),
    )
    m.add(
        BASE,
        *(
            rod((a, b, 0.6 * floor), (a, b, 0.65 * floor), 0.12 * w, 6)
            for a in (-0.85 * w, 0.85 * w)
            for b in (-0.85 * w, 0.85 * w)
        ),
    )
    shoulder = vec(0, 0, floor + 1.4 * w)
    m.add("column", rod((0, 0, 0.6 * floor), (0, 0, floor), w, n))
    cheeks = m.pick(1, 2)
    for s in (-1, 1)[:cheeks]:
        m.add("column", box((s * 0.62 * w, s * 0.95 * w), (-0.6 * w, 0.6 * w), (floor, shoulder[2] + 0.5 * w)))
    m.spin("column", (0, 0, 0.6 * floor), (0, 0, 1))
    lean, long = m.number(-20, 45), m.number(3, 6) * w
    bend = lean + m.number(40, 110)
    aim = lambda t: vec(0, -np.sin(np.deg2rad(t)), np.cos(np.deg2rad(t)))  # noqa: E731
    elbow = shoulder + long * aim(lean)
    wrist = elbow + m.number(0.7, 1.0) * long * aim(bend)
    parent, chain = "column", [("upper", shoulder, elbow), ("lower", elbow, wrist)]
    for name, a, b in chain:
        m.add(name, *link_solids(m, a, b, w, style), rod(a - vec(0.6 * w, 0, 0), a + vec(0.6 * w, 0, 0), 0.5 * w, n))
        m.hinge(name, a, (1, 0, 0), m.pick((-60, 60), (-90, 45), (-30, 100)), parent)
        parent = name
        if m.chance(0.3):
            m.add(name, box((0.6 * w, 0.9 * w), (a[1] - 0.3 * w, a[1] + 0.3 * w), (a[2] - 0.3 * w, a[2] + 0.3 * w)))
        w *= 0.85
    way = aim(bend)
    if m.chance(0.5):
        m.add("roll", rod(wrist, wrist + 0.6 * w * way, 0.55 * w, n))
        m.spin("roll", wrist, way, parent)
        parent, wrist = "roll", wrist + 0.6 * w * way
    end = wrist + 1.2 * w * way
    m.add(
        "wrist",
        *link_solids(m, wrist, end, 0.7 * w, "square"),
        rod(wrist - vec(0.5 * w, 0, 0), wrist + vec(0.5 * w, 0, 0), 0.35 * w, n),
    )
    m.hinge("wrist", wrist, (1, 0, 0), (-90, 90), parent)
    if m.chance(0.7):
        m.add(
            "flange",
            rod(end, end + 0.3 * w * way, 0.5 * w, n),
            box((-0.1 * w, 0.1 * w), (end[1] - 0.55 * w, end[1] + 0.1), (end[2], end[2] + 0.1 * w)),
        )
        m.spin("flange", end, way, "wrist")
        parent, end = "flange", end + 0.3 * w * way
        tool = m.pick("fingers", "pen", "none")
        if tool == "pen":
            m.add("flange", rod(end, end + 1.2 * w * way, 0.12 * w, 10))
        elif tool == "fingers":
            m.add("flange", beam(end, end + 0.4 * w * way, 1.4 * w, 0.6 * w))
            for s, side in ((-1, "left"), (1, "right")):
                a = end + vec(s * 0.35 * w, 0, 0) + 0.4 * w * way
                m.add(f"finger_{side}", beam(a, a + 0.8 * w * way, 0.2 * w, 0.4 * w))
                m.slide(f"finger_{side}", (s, 0, 0), 0.3 * w, "flange")
    if m.chance(0.4):
        m.add(BASE, tube([(0, 1.3 * w, 0.3 * floor), (0, 3 * w, 0.2 * floor), (w, 5 * w, 0.02)], 0.12 * w, 8))


def gripper(m: Model) -> None:
    """A hand with two or three fingers that slide or swing, on a flange with bolts."""
    w, n = m.number(0.06, 0.14), m.sections()
    high = m.number(0.6, 1.2) * w
    body = rounded((-w / 2, w / 2), (-0.3 * w, 0.3 * w), m.pick(0.02, 0.1) * w)
    m.add(BASE, prism(body, "z", (0, high)), rod((0, 0, high), (0, 0, high + 0.15 * w), 0.35 * w, n))
    m.add(
        BASE,
        *(
            rod(
                (0.25 * w * np.cos(t), 0.25 * w * np.sin(t), high),
                (0.25 * w * np.cos(t), 0.25 * w * np.sin(t), high + 0.2 * w),
                0.03 * w,
                6,
            )
            for t in (0.8, 2.4, 3.9, 5.5)
        ),
    )
    way, gap = m.pick("slide", "slide", "swing", "three"), m.number(0.0, 0.25) * w
    if way == "three":
        for k in range(3):
            t = 2 * np.pi * k / 3
            out = vec(np.cos(t), np.sin(t), 0)
            a, side = 0.25 * w * out + vec(0, 0, -0.02 * w), vec(-np.sin(t), np.cos(t), 0)
            m.add(f"finger_{k}", beam(a, a + vec(0, 0, -0.45 * w) + 0.1 * w * out, 0.14 * w, 0.12 * w, side))
            m.add(f"finger_{k}", rod(a - 0.1 * w * side, a + 0.1 * w * side, 0.08 * w, n))
            m.hinge(f"finger_{k}", a, np.cross(vec(0, 0, -1), out), (0, 45))
            if m.chance(0.7):
                b = a + vec(0, 0, -0.45 * w) + 0.1 * w * out
                m.add(
                    f"tip_{k}",
                    beam(b, b + vec(0, 0, -0.35 * w) - 0.12 * w * out, 0.12 * w, 0.1 * w, side),
                    rod(b - 0.08 * w * side, b + 0.08 * w * side, 0.065 * w, n),
                )
                m.hinge(f"tip_{k}", b, np.cross(vec(0, 0, -1), out), (-30, 30), f"finger_{k}")
        return
    if way == "slide":
        m.add(BASE, box((-0.55 * w, 0.55 * w), (-0.1 * w, 0.1 * w), (-0.05 * w, 0.0)))
    shape = m.pick("block", "stepped", "long")
    for s, side in ((-1, "left"), (1, "right")):
        name, x = f"finger_{side}", s * (gap / 2 + 0.002)
        if way == "slide":
            long = {"block": 0.4, "stepped": 0.6, "long": 0.9}[shape] * w
            m.add(
                name,
                box((x, x + s * 0.18 * w), (-0.2 * w, 0.2 * w), (-0.2 * w, -0.05 * w)),
                box((x, x + s * 0.1 * w), (-0.12 * w, 0.12 * w), (-0.05 * w - long, -0.19 * w)),
            )
            if m.chance(0.4):
                m.add(name, box((x, x + s * 0.15 * w), (-0.14 * w, 0.14 * w), (-0.05 * w - long, 0.1 * w - long)))
            m.slide(name, (s, 0, 0), 0.3 * w)
        else:
            a = vec(s * 0.3 * w, 0, -0.05 * w)
            knee, tip = a + vec(s * 0.15 * w, 0, -0.4 * w), vec(x + s * 0.05 * w, 0, -0.95 * w)
            m.add(
                name,
                beam(a, knee, 0.14 * w, 0.2 * w, (0, 1, 0)),
                beam(knee, tip, 0.12 * w, 0.14 * w, (0, 1, 0)),
                rod(a - vec(0, 0.2 * w, 0), a + vec(0, 0.2 * w, 0), 0.07 * w, n),
            )
            m.add(
                BASE,
                *(
                    box((a[0] - 0.1 * w, a[0] + 0.1 * w), (y - 0.03 * w, y + 0.03 * w), (-0.1 * w, 0.02 * w))
                    for y in (-0.16 * w, 0.16 * w)
                ),
            )
            m.hinge(name, a, (0, -s, 0), 35)
    if m.chance(0.5):
        m.add(BASE, tube([(0, 0.3 * w, 0.5 * high), (0, 0.6 * w, 0.5 * high), (0.1 * w, 0.8 * w, 1.5 * high)], 0.04 * w, 6))
    if m.chance(0.4):
        m.add(
            BASE,
            box((-0.2 * w, 0.2 * w), (-0.42 * w, -0.3 * w), (0.3 * high, 0.8 * high)),
            rod((0, -0.45 * w, 0.55 * high), (0, -0.42 * w, 0.55 * high), 0.08 * w, 12),
        )


def quadruped(m: Model) -> None:
    """A trunk on four legs of two or three joints each; perhaps a head that turns."""
    long, half, high = m.number(0.35, 0.8), m.number(0.08, 0.18), m.number(0.28, 0.55)
    thick, style, n = m.number(0.1, 0.16), m.pick("round", "plates", "taper", "square"), m.sections()
    trunk = rounded((-half, half), (high - thick / 2, high + thick / 2), m.pick(0.01, 0.04))
    m.add(BASE, prism(trunk, "y", (0, long)))
    if m.chance(0.5):
        m.add(BASE, box((-0.6 * half, 0.6 * half), (0.2 * long, 0.8 * long), (high + thick / 2, high + thick / 2 + 0.04)))
    joints, w, bend = m.pick(2, 3), m.number(0.035, 0.06), m.pick((1, 1), (1, -1), (-1, -1))
    for s, side in ((-1, "l"), (1, "r")):
        for k, (y, sign) in enumerate(((0.1 * long, bend[0]), (0.9 * long, bend[1]))):
            leg, parent = f"{'fr'[k]}{side}", BASE
            x = s * (half + 0.03)
            if joints == 3:
                parent = f"hip_{leg}"
                m.add(
                    parent,
                    rod((x - s * 0.025, y - 0.05, high), (x - s * 0.025, y + 0.05, high), 0.035, n),
                    box((x, x + s * 0.03), (y - 0.03, y + 0.03), (high - 0.03, high + 0.03)),
                )
                m.hinge(parent, (x - s * 0.025, y, high), (0, -s, 0), (-25, 40))
                x += s * (0.035 + 0.6 * w)
            else:
                m.add(BASE, rod((s * half, y, high), (x, y, high), 0.035, n))
                x += s * 0.6 * w
            hip = vec(x, y, high)
            knee, foot = hip + vec(0, sign * 0.35 * high, -0.48 * high), vec(x, y + 0.02, 0.03)
            m.add(
                f"thigh_{leg}",
                *link_solids(m, hip, knee, w, style),
                rod(hip - vec(0.6 * w, 0, 0), hip + vec(0.6 * w, 0, 0), 0.9 * w, n),
            )
            m.hinge(f"thigh_{leg}", hip, (1, 0, 0), (-45, 45), parent)
            m.add(
                f"shank_{leg}",
                *link_solids(m, knee, foot, 0.7 * w, style),
                rod(knee - vec(0.6 * w, 0, 0), knee + vec(0.6 * w, 0, 0), 0.45 * w, n),
            )
            m.add(f"shank_{leg}", ball(foot, (0.03, 0.03, 0.03), n))
            m.hinge(f"shank_{leg}", knee, (sign, 0, 0), (-30, 60), f"thigh_{leg}")
    head = m.pick("block", "turns", "none")
    if head != "none":
        part, at = ("head" if head == "turns" else BASE), vec(0, 0, high + 0.2 * thick)
        m.add(
            part,
            rod(at, at + vec(0, -0.05, 0.03), 0.025, n),
            box((-0.6 * half, 0.6 * half), (-0.16, -0.04), (at[2], at[2] + 0.09)),
        )
        m.add(
            part,
            *(rod((c * 0.3 * half, -0.165, at[2] + 0.05), (c * 0.3 * half, -0.155, at[2] + 0.05), 0.015, 10) for c in (-1, 1)),
        )
        if head == "turns":
            m.hinge(part, at, (0, 0, 1), (-50, 50))
    if m.chance(0.3):
        m.add(BASE, lathe([(0, 0), (0.04, 0), (0.04, 0.03), (0.02, 0.04), (0, 0.04)], 16, (0, 0.6 * long, high + thick / 2)))
