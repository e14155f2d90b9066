"""White goods: fridges, dishwashers, washing machines, dryers."""

from __future__ import annotations

import itertools

import numpy as np

from training.kinds.kitchen.appliances import FRONT, PULLS, controls
from training.kinds.kitchen_parts import Look, body, door, drawer, look, rack, tray
from training.kinds.kitchen_trims import dial, feet, trims
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, ball, box, cut, prism, rectangle, rod, tube, vec


def fridge(m: Model) -> None:
    """Fridges: one door, two doors above each other, side by side, French doors above freezer drawers, glass front."""
    style, how = (
        m.pick("one", "stacked", "side", "french", "bar"),
        look(m, 0.8, ("slab", "rounded", "liner", "pan", "raised"), PULLS),
    )
    wide = {"one": m.number(0.5, 0.62), "bar": m.number(0.45, 0.6)}.get(
        style, m.number(0.8, 0.95) if style in ("side", "french") else m.number(0.55, 0.7)
    )
    high, deep, foot = m.number(0.6, 0.9) if style == "bar" else m.number(1.5, 2.0), m.number(0.5, 0.7), m.number(0.02, 0.08)
    if style == "bar":
        how = look(m, 0.8, ("glass", "slab"), PULLS)
    how = Look(how.front, how.pull, m.number(0.03, 0.08), None if m.chance(0.85) else how.sunk, how.clear, how.length)
    x, side, split = (0.0, wide), m.pick("left", "right"), 0.5 if style == "french" else m.number(0.4, 0.5)
    at = foot + (high - foot) * (m.number(0.3, 0.4) if m.chance(0.6) or style == "french" else m.number(0.65, 0.75))
    jobs: list[tuple[str, tuple[Span, Span]]] = [(side, (x, (foot, high)))]
    if style == "stacked":
        lower = m.pick(side, "drawer") if at < 0.5 * high else side
        jobs = [(lower, (x, (foot, at - 0.004))), (side, (x, (at, high)))]
    elif style in ("side", "french"):
        low = foot if style == "side" else at
        jobs = [("left", ((0.0, split * wide - 0.002), (low, high))), ("right", ((split * wide + 0.002, wide), (low, high)))]
        borders = np.linspace(foot, at, m.pick(1, 2) + 1) if style == "french" else []
        jobs += [("drawer", (x, (float(a), float(b) - 0.004))) for a, b in itertools.pairwise(borders)]
    hollow = body(m, x, (0, deep), (foot, high), [room for _, room in jobs], how, 0.06)
    feet(m, x, (0, deep), foot)
    for k, (job, (a, z)) in enumerate(jobs):
        part = f"{'drawer' if job == 'drawer' else 'door'}_{k}"
        inner = ((a[0] + 0.05, a[1] - 0.05), (z[0] + 0.05, z[1] - 0.05))
        if job == "drawer":
            drawer(m, part, a, z, deep, how, m.pick("tub", "wire", "box") if hollow else "none", "top")
            continue
        door(m, part, a, z, job, how, m.pick(100, 120, 150))
        if hollow:
            for c in np.linspace(*inner[1], m.pick(3, 4, 6))[1:-1]:
                rack(m, BASE, inner[0], (how.depth[1] + 0.13, deep - 0.04), float(c))
            for c in np.linspace(inner[1][0], inner[1][1] - 0.12, m.pick(1, 3, 4)) if m.chance(0.6) else []:  # balconies
                tray(
                    m, part, (inner[0][0] + 0.02, inner[0][1] - 0.02), (how.depth[1], how.depth[1] + 0.1), (c, c + 0.06), "tub"
                )
            if m.chance(0.5):
                tray(
                    m,
                    f"crisper_{k}",
                    (inner[0][0] + 0.01, inner[0][1] - 0.01),
                    (how.depth[1] + 0.13, deep - 0.05),
                    (inner[1][0] + 0.01, inner[1][0] + 0.17),
                    "tub",
                )
                m.slide(f"crisper_{k}", FRONT, 0.3)
        if k == 0 and style in ("side", "french") and m.chance(0.5):  # a water dispenser in the door
            c, d, y = middle(a), z[0] + 0.5 * (z[1] - z[0]), how.depth[0]
            m.add(
                part,
                prism(rectangle((c - 0.1, c + 0.1), (d, d + 0.3), 0.02), "y", (y - 0.01, y)),
                box((c - 0.09, c + 0.09), (y - 0.03, y), (d, d + 0.01)),
            )
            m.add(part, rod((c, y - 0.012, d + 0.2), (c, y - 0.012, d + 0.28), 0.01, 8))
        elif m.chance(0.3):
            trims(m, part, a, how.depth[0], (z[0] + 0.8 * (z[1] - z[0]), z[1]), 1)
    if m.chance(0.5):  # covers of the hinges
        m.add(BASE, *(box((c, c + 0.07), (how.depth[0], 0.06), (high, high + 0.02)) for c in (0.01, wide - 0.08)))


def dishwasher(m: Model) -> None:
    """A door that falls open, two baskets, a spray arm; controls on the door or above it."""
    wide, high, deep, foot = m.pick(0.45, 0.6, 0.6), m.number(0.75, 0.86), m.number(0.52, 0.6), m.number(0.04, 0.12)
    how, panel = look(m, 0.5, ("slab", "rounded", "liner", "pan", "framed"), PULLS), m.pick(0.0, 0.1, 0.13)
    room = ((0.008, wide - 0.008), (foot + 0.01, high - panel - 0.01))
    hollow = body(m, (0, wide), (0, deep), (foot, high), [room], how, 0.03)
    feet(m, (0, wide), (0, deep), foot)
    door(m, "door", *room, "bottom", how, m.pick(85, 90))
    if m.chance(0.4):
        m.add(BASE, box((0, wide), (0.04, 0.06), (0, foot)))
    if panel:
        controls(m, (0.02, wide - 0.02), 0.0, (high - panel, high), most=2)
    elif how.front in ("slab", "rounded", "liner"):
        controls(m, (0.1, wide - 0.1), how.depth[0], (room[1][1] - 0.1, room[1][1] - 0.02), "door", 1)
    if not hollow:
        return
    inner, start = (0.05, wide - 0.05), how.depth[1] + 0.02
    for name, z in (("lower", foot + 0.12), ("upper", foot + 0.42)):
        tray(m, f"{name}_basket", inner, (start, deep - 0.05), (z, z + 0.12), "wire")
        m.add(
            f"{name}_basket", *(rod((a, start, z), (a, deep - 0.05, z), 0.002, 6) for a in np.linspace(*inner, m.pick(5, 10)))
        )
        m.slide(f"{name}_basket", FRONT, 0.45)
        if name == "upper" and m.chance(0.6):
            m.add(BASE, *(box((a, a + 0.01), (start, deep - 0.04), (z + 0.03, z + 0.06)) for a in (0.036, wide - 0.046)))
    if m.chance(0.6):
        at = (wide / 2, deep / 2, foot + 0.06)
        m.add(
            "spray_arm",
            box((0.08, wide - 0.08), (at[1] - 0.025, at[1] + 0.025), (at[2], at[2] + 0.02)),
            rod(at, (at[0], at[1], at[2] + 0.035), 0.03, 12),
        )
        m.spin("spray_arm", at, (0, 0, 1))


def top_loader(m: Model) -> None:
    """A washing machine with a lid above, perhaps folding, a drum that turns, a console with knobs at the back."""
    wide, deep, high, n = m.pick(0.4, m.number(0.55, 0.7)), m.number(0.55, 0.68), m.number(0.85, 0.95), m.pick(12, 20, 32)
    foot, back, rim = m.number(0.01, 0.05), m.number(0.08, 0.15), m.number(0.03, 0.06)
    mouth, t = ((rim, wide - rim), (rim, deep - back)), m.number(0.01, 0.03)
    inset, hollow = m.chance(0.3), m.chance(0.7)
    shell, at, r = box((0, wide), (0, deep), (foot, high)), (wide / 2, (deep - back) / 2), 0.42 * min(wide, deep - back)
    if inset:
        shell = cut(shell, box(*mouth, (high - t - 0.002, high + 1)))
    if hollow:
        shell = cut(shell, rod((*at, high - 0.5), (*at, high + 1), 1.06 * r, n))
    m.add(BASE, shell)
    feet(m, (0, wide), (0, deep), foot)
    if hollow and m.chance(0.8):
        m.add(
            "drum",
            cut(rod((*at, high - 0.49), (*at, high - 0.05), r, n), rod((*at, high - 0.48), (*at, high + 1), 0.96 * r, n)),
        )
        if m.chance(0.5):
            m.add("drum", rod((*at, high - 0.48), (*at, high - 0.15), 0.2 * r, 10))
            m.add(
                "drum",
                *(
                    box((at[0] + s * 0.2 * r, at[0] + s * 0.45 * r), (at[1] - 0.01, at[1] + 0.01), (high - 0.48, high - 0.3))
                    for s in (-1, 1)
                ),
            )
        m.spin("drum", (*at, high - 0.48), (0, 0, 1))
    gap = abs(m.gap(0.4)) + 0.001
    z = (high - t, high) if inset else (high + 0.001, high + t)
    x, y = (mouth[0][0] + gap, mouth[0][1] - gap), (mouth[1][0] + gap, mouth[1][1] - gap)
    if not inset and m.chance(0.6):
        x, y = (0.0, wide), (-0.01, mouth[1][1])
    half = m.number(0.4, 0.6) * (y[0] + y[1]) if m.chance(0.25) else y[0]
    m.add("lid", box(x, (half, y[1]), z) if m.chance(0.6) else prism(rectangle(x, (half, y[1]), 0.06), "z", z))
    if len(m.of("lid").faces) > 12:
        m.add("lid", box((x[0] + 0.05, x[1] - 0.05), (half + 0.05, y[1] - 0.05), (z[0] + 0.3 * t, z[0] + 0.6 * t)))
    m.hinge("lid", (wide / 2, y[1], z[m.pick(0, 1)]), (-1, 0, 0), m.pick(80, 100))
    if half > y[0]:
        m.add("front_half", box(x, (y[0], half - 0.002), z))
        m.hinge("front_half", (wide / 2, half, z[1]), (-1, 0, 0), m.pick(90, 160), "lid")
    elif m.chance(0.6):
        m.add("lid", box((0.4 * wide, 0.6 * wide), (y[0] - 0.02, y[0] + 0.01), (z[1] - 0.008, z[1])))
    tall, slant = m.number(0.06, 0.18), m.pick(0.0, 0.04)
    edge = deep - back + 0.005
    m.add(BASE, prism([(edge, high), (deep, high), (deep, high + tall), (edge + slant, high + tall)], "x", (0, wide)))
    up = np.array([0.0, -tall, slant]) / np.hypot(tall, slant)
    for k, a in enumerate(np.linspace(0, wide, m.pick(1, 2, 3) + 2)[1:-1]):
        dial(m, f"knob_{k}", (a, edge + slant / 2, high + tall / 2), up, min(0.3 * tall, 0.04))
    if m.chance(0.4):
        m.add(BASE, tube([(0.1, deep, 0.6), (0.1, deep + 0.05, 0.6), (0.1, deep + 0.05, 0.05)], 0.015, 8))


def tumble_dryer(m: Model) -> None:
    """A front with a round or square door, a drum, a water drawer, a flap over the filter, knobs."""
    wide, high, deep, foot = 0.6, m.number(0.82, 0.88), m.number(0.55, 0.65), m.number(0.01, 0.03)
    square, n, r = m.chance(0.35), m.pick(16, 24, 32), m.number(0.16, 0.21)
    at, how = (wide / 2, m.number(0.4, 0.48)), look(m, 0.4, ("slab", "rounded", "glass", "raised", "pan"), PULLS)
    shell, hollow, side = box((0, wide), (0, deep), (foot, high)), m.chance(0.65), m.pick("left", "right")
    x, z = (at[0] - r, at[0] + r), (at[1] - r, at[1] + r)
    if hollow:
        shell = cut(shell, rod((at[0], -1, at[1]), (at[0], deep - 0.05, at[1]), 0.85 * r, n))
    m.add(BASE, shell)
    feet(m, (0, wide), (0, deep), foot)
    if square:
        how = Look(how.front, how.pull, how.thick, None, how.clear, how.length)
        door(m, "door", x, z, side, how, m.pick(110, 170))
    else:
        out, s = m.number(0.02, 0.05), -1 if side == "left" else 1
        center, face = vec(at[0], 0, at[1]), vec(0, -out, 0)
        m.add("door", cut(rod(center, center + face, r, n), rod(center - face, center + 2 * face, 0.65 * r, n)))
        glass = rod(center + 0.3 * face, center + 0.6 * face, 0.66 * r, n)
        m.add("door", ball(center + 0.4 * face, (0.66 * r, 0.9 * out, 0.66 * r), n) if m.chance(0.4) else glass)
        if m.chance(0.6):
            m.add(
                "door",
                box(
                    (at[0] - s * 0.95 * r - 0.012, at[0] - s * 0.95 * r + 0.012),
                    (-out - 0.012, -out),
                    (at[1] - 0.04, at[1] + 0.04),
                ),
            )
        pin = at[0] + s * (r + m.pick(0.0, 0.01))
        if m.chance(0.6):
            m.add(BASE, box((pin - 0.012, pin + 0.02), (-0.6 * out, 0), (at[1] - 0.05, at[1] + 0.05)))
        m.hinge("door", (pin, -m.pick(0.0, 0.5) * out, at[1]), (0, 0, s), m.pick(110, 170))
    if hollow and m.chance(0.7):
        m.add(
            "drum",
            cut(
                rod((at[0], 0.03, at[1]), (at[0], deep - 0.06, at[1]), 0.84 * r, n),
                rod((at[0], -1, at[1]), (at[0], deep - 0.07, at[1]), 0.8 * r, n),
            ),
        )
        m.add("drum", box((at[0] - 0.01, at[0] + 0.01), (0.05, deep - 0.08), (at[1] - 0.82 * r, at[1] - 0.6 * r)))
        m.spin("drum", (at[0], 0.1, at[1]), (0, -1, 0))
    panel = Look(m.pick("slab", "rounded"), m.pick("none", "recess", "cup"), 0.015, None, 0.0, 0.5)
    if m.chance(0.7):
        drawer(m, "water_drawer", (0.015, 0.2), (high - 0.12, high - 0.02), deep, panel, "none", "middle")
    if m.chance(0.6):
        a = m.pick((0.03, 0.25), (0.35, 0.57), (0.02, 0.58))
        door(m, "filter_flap", a, (foot + 0.03, foot + 0.15), m.pick("bottom", "left"), panel, 90)
    else:
        trims(m, BASE, (0.05, 0.55), 0.0, (foot + 0.03, foot + 0.16))
    controls(m, (0.22, 0.58), 0.0, (high - 0.12, high - 0.02), most=2)
