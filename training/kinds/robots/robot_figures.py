"""Humanoid robots: heads, arms and legs on hinges."""

from __future__ import annotations

from training.kinds.model import BASE, Model
from training.kinds.robots.robot_limbs import Body, arm, block, leg
from training.kinds.solids import ball, box, prism, rod

STYLES = ("boxy", "round", "tin", "armour")


def robot_figure(m: Model) -> None:
    """A robot that stands: head, arms with elbows, legs with knees; hands, feet, a waist, a hatch in some."""
    h = m.number(0.12, 2.2)
    b = Body(
        m.pick(*STYLES), h, m.number(0.13, 0.2) * h, m.number(0.038, 0.06) * h, m.pick(8, 12, 16), m.pick("rod", "ball", "rod")
    )
    hip, waist, neck = m.number(0.46, 0.52) * h, m.number(0.54, 0.6) * h, m.number(0.95, 1.0) * h
    turns = m.chance(0.35)
    torso = "torso" if turns else BASE
    pelvis = 0.75 * b.w
    m.add(BASE, *block(b, (-pelvis, pelvis), (-0.09 * h, 0.09 * h), (hip - 0.03 * h, waist + (0.0 if turns else 0.01 * h))))
    _torso(m, b, torso, waist, neck)
    if turns:
        m.add(torso, rod((0, 0, waist + 0.001 * h), (0, 0, waist + 0.03 * h), 0.4 * b.w, b.n))
        m.spin(torso, (0, 0, waist), (0, 0, 1))
    _head(m, b, torso, neck)
    arms, legs = m.pick("two", "two", "one"), m.pick("two", "two", "one", "fused")
    fists, feet = m.pick("fist", "claw", "ball"), m.chance(0.6)
    bulk, length = m.number(1.0, 1.5), m.number(0.85, 1.1)
    for s, side in ((-1, "right"), (1, "left")):
        arm(m, b, s, side, torso, neck - 0.07 * h, arms, fists, bulk, length)
        if legs != "fused":
            leg(m, b, s, side, 0.58 * pelvis, hip, legs, feet, bulk)
    if legs == "fused":
        m.add(
            BASE,
            *block(b, (-0.6 * b.w, 0.6 * b.w), (-0.07 * h, 0.07 * h), (0.03 * h, hip)),
            rod((0, 0, 0), (0, 0, 0.05 * h), 1.1 * b.w, b.n),
        )
    elif m.chance(0.25):
        m.add(
            BASE,
            rod((0, 0.13 * h, 0), (0, 0.13 * h, hip), 0.02 * h, 8),
            box((-0.04 * h, 0.04 * h), (0.05 * h, 0.15 * h), (hip - 0.02 * h, hip + 0.01 * h)),
        )
        m.add(
            BASE,
            rod((0, 0.05 * h, -0.03 * h), (0, 0.05 * h, -0.002 * h), 0.4 * h, 24),
            rod((0, 0.13 * h, -0.01 * h), (0, 0.13 * h, 0.01 * h), 0.04 * h, 8),
        )


def _torso(m: Model, b: Body, part: str, waist: float, neck: float) -> None:
    """The chest with what is on it: a panel, lamps, a pack behind, a hatch in front."""
    h, deep = b.h, m.number(0.09, 0.13) * b.h
    low = waist + 0.02 * h if part != BASE else waist
    if b.style == "armour":
        outline = [
            (-0.6 * b.w, low),
            (0.6 * b.w, low),
            (b.w, 0.75 * neck + 0.25 * low),
            (0.8 * b.w, neck),
            (-0.8 * b.w, neck),
            (-b.w, 0.75 * neck + 0.25 * low),
        ]
        m.add(part, prism(outline, "y", (-deep, deep)))
    else:
        m.add(part, *block(b, (-b.w, b.w), (-deep, deep), (low, neck)))
    middle, q = 0.4 * low + 0.6 * neck, 0.45 * b.w
    front = m.pick("none", "panel", "hatch", "lamp")
    if front in ("panel", "hatch") and b.style != "tin":
        name = "hatch" if front == "hatch" else part
        m.add(
            name, box((-q, q), (-deep - 0.02 * h, -deep - 0.001 * h * (front == "hatch")), (middle - 0.7 * q, middle + 0.7 * q))
        )
        if front == "hatch":
            m.add(name, box((0.6 * q, 0.75 * q), (-deep - 0.03 * h, -deep - 0.019 * h), (middle - 0.2 * q, middle + 0.2 * q)))
            m.hinge(name, (-q, -deep - 0.02 * h, middle), (0, 0, -1), m.pick(90, 130), part)
        else:
            m.add(
                part, *(rod((x * q, -deep - 0.03 * h, middle), (x * q, -deep, middle), 0.15 * q, 10) for x in (-0.5, 0.0, 0.5))
            )
    elif front == "lamp":
        m.add(part, rod((0, -deep - 0.015 * h, middle), (0, -0.5 * deep, middle), 0.3 * b.w, max(b.n, 10)))
    if m.chance(0.4):
        m.add(part, *block(b, (-0.7 * b.w, 0.7 * b.w), (0.9 * deep, deep + 0.08 * h), (middle - 0.5 * b.w, neck - 0.02 * h)))
        if m.chance(0.5):
            m.add(
                part,
                *(
                    rod(
                        (s * 0.4 * b.w, deep + 0.05 * h, middle - 0.7 * b.w),
                        (s * 0.4 * b.w, deep + 0.05 * h, middle),
                        0.025 * h,
                        b.n,
                    )
                    for s in (-1, 1)
                ),
            )


def _head(m: Model, b: Body, torso: str, neck: float) -> None:
    """A head on a neck that turns, or nods, or both; eyes, ears, an aerial."""
    h, q, tall = b.h, m.number(0.06, 0.1) * b.h, m.number(0.12, 0.2) * b.h
    gap = m.number(0.0, 0.03) * h
    m.add(torso, rod((0, 0, neck - 0.01 * h), (0, 0, neck + gap), 0.4 * q, b.n))
    low = neck + gap + 0.002 * h
    face = -0.9 * q
    if b.style == "round" and m.chance(0.6):
        m.add("head", ball((0, 0, low + 0.5 * tall), (1.1 * q, q, 0.52 * tall), max(b.n, 12)))
        face = -0.85 * q
    else:
        m.add("head", *block(b, (-q, q), (-0.9 * q, 0.9 * q), (low, low + tall)))
    z = low + 0.58 * tall
    if m.chance(0.6):
        m.add(
            "head",
            *(
                rod((s * 0.4 * q, face - 0.08 * q, z), (s * 0.4 * q, 0.2 * face, z), m.pick(0.17, 0.22) * q, 10)
                for s in (-1, 1)
            ),
        )
    else:
        m.add("head", box((-0.75 * q, 0.75 * q), (face - 0.07 * q, 0.4 * face), (z - 0.1 * tall, z + 0.12 * tall)))
    if m.chance(0.4):
        m.add("head", *(rod((s * 0.9 * q, 0, z), (s * 1.2 * q, 0, z), 0.25 * q, b.n) for s in (-1, 1)))
    if m.chance(0.5):
        m.add(
            "head",
            rod((0, 0, low + 0.95 * tall), (0, 0, low + 1.5 * tall), 0.06 * q, 6),
            ball((0, 0, low + 1.5 * tall), (0.16 * q,) * 3, 8),
        )
    if m.chance(0.4):
        m.add("head", box((-0.4 * q, 0.4 * q), (face - 0.05 * q, 0.5 * face), (low + 0.2 * tall, low + 0.28 * tall)))
    m.hinge("head", (0, 0, low), (0, 0, 1), m.pick((-60, 60), (-80, 80), (-45, 45)), torso)
