"""Appliances on a worktop: toasters, small ovens, espresso machines."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen.appliances import FRONT, controls, racks, window
from training.kinds.kitchen_parts import body, door, look, tray
from training.kinds.kitchen_trims import button, cable, dial, feet, lever
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, join, prism, rectangle, ring, rod, rounded, tube, turned, vec


def toaster(m: Model) -> None:
    """A toaster: slots, one or two levers that go down, a dial, buttons, a crumb tray."""
    pairs, deep, high = m.pick(1, 1, 2), m.number(0.24, 0.4), m.number(0.16, 0.21)
    wide, foot, r = 0.17 * pairs, m.number(0.008, 0.02), m.pick(0.015, 0.03, 0.05)
    outline = rounded((0, wide), (foot, high), r, m.pick(2, 4, 8))
    shell = prism(outline, "y", (0, deep))
    mouths = [0.17 * k + c for k in range(pairs) for c in m.pick((0.055, 0.115), (0.085,))]
    shell = cut(
        shell, *(box((c - 0.014, c + 0.014), (0.05, deep - 0.04), (high - m.pick(0.02, 0.11), high + 1)) for c in mouths)
    )
    m.add(BASE, shell)
    if m.chance(0.5):
        m.add(
            BASE,
            prism(outline.buffer(0.004), "y", (-0.006, 0.012)),
            prism(outline.buffer(0.004), "y", (deep - 0.012, deep + 0.004)),
        )
    feet(m, (0.01, wide - 0.01), (0.01, deep - 0.01), foot)
    face, low, style = -0.006, high * 0.45, m.pick("flat", "round", "paddle")
    for k in range(pairs):
        c = 0.085 + 0.17 * k
        z = high - 0.05
        m.add(f"lever_{k}", box((c - 0.006, c + 0.006), (face - 0.012, 0.001), (z - 0.004, z + 0.004)))
        if style == "round":
            m.add(f"lever_{k}", rod((c - 0.022, face - 0.016, z), (c + 0.022, face - 0.016, z), 0.008, 12))
        else:
            h = 0.006 if style == "flat" else 0.015
            m.add(f"lever_{k}", box((c - 0.022, c + 0.022), (face - 0.028, face - 0.008), (z - h, z + h)))
        if m.chance(0.6):
            m.add(
                BASE,
                *(
                    box((c + s - 0.002, c + s + 0.002), (face - 0.002, face + 0.002), (low - 0.01, high - 0.03))
                    for s in (-0.012, 0.012)
                ),
            )
        m.slide(f"lever_{k}", (0, 0, -1), z - low)
        if m.chance(0.7):
            dial(m, f"dial_{k}", (c + 0.03, face, foot + 0.03), FRONT, 0.014)
        for i in range(m.pick(0, 1, 3)):
            button(m, f"button_{k}_{i}", (c - 0.025, face, foot + 0.02 + 0.018 * i), FRONT, 0.012)
    if m.chance(0.6):
        back = m.pick(-1, 1)
        y = (0.05, deep) if back > 0 else (0.0, deep - 0.05)
        m.add("crumb_tray", box((0.02, wide - 0.02), y, (foot + 0.004, foot + 0.007)))
        end = deep if back > 0 else 0.0
        m.add("crumb_tray", box((0.3 * wide, 0.7 * wide), (end, end + back * 0.012), (foot, foot + 0.012)))
        m.slide("crumb_tray", (0, back, 0), 0.8 * deep)
    if m.chance(0.5):  # a rack for rolls that stays
        m.add(
            BASE,
            *(
                tube([(a, 0.06, high), (a, 0.06, high + 0.04), (a, deep - 0.06, high + 0.04), (a, deep - 0.06, high)], 0.002, 6)
                for a in np.linspace(0.03, wide - 0.03, 4)
            ),
        )
    if m.chance(0.4):
        cable(m, (wide / 2, deep, 0.03), 0.2)


def toaster_oven(m: Model) -> None:
    """A small oven: a glass door that falls open, knobs above each other, a rack, a crumb tray."""
    wide, high, deep, foot = m.number(0.36, 0.52), m.number(0.2, 0.32), m.number(0.26, 0.38), m.number(0.01, 0.025)
    how, above = look(m, 0.3, ("glass", "glass", "slab", "sheet", "rounded"), ("bar", "rail", "merged", "rim")), m.chance(0.25)
    room = ((0.01, wide * m.number(0.7, 0.8)), (foot + 0.035, foot + high - 0.01))
    field = ((room[0][1] + 0.01, wide), (foot, foot + high))
    if above:
        room, field = (
            ((0.01, wide - 0.01), (room[1][0], foot + 0.76 * high)),
            ((0.02, wide - 0.02), (foot + 0.78 * high, foot + high)),
        )
    hollow = body(m, (0, wide), (0, deep), (foot, foot + high), [room], how, 0.012)
    door(m, "door", *room, "left" if m.chance(0.1) else "bottom", how, m.pick(90, 100))
    window(m, "door", how, *room)
    feet(m, (0, wide), (0, deep), foot)
    if above:
        controls(m, field[0], 0.0, field[1], most=4)
    else:
        count, c, style = m.pick(2, 3, 4), (field[0][0] + field[0][1]) / 2, m.pick("plain", "bar", "pointer", "stepped")
        for k, z in enumerate(np.linspace(foot, foot + high, count + 2)[1:-1]):
            dial(m, f"knob_{k}", (c, 0.0, z), FRONT, min(0.3 * (field[0][1] - field[0][0]), 0.09 * high), style=style)
            if m.chance(0.5):
                m.add(BASE, ring((c, 0.0, z), (0, 1, 0), 0.11 * high, 0.002, 16))
    if hollow:
        racks(m, (room[0], (room[1][0] + 0.02, room[1][1] - 0.02)), deep, how.depth[1])
        m.add(
            BASE,
            *(
                rod((room[0][0], b, room[1][0] + 0.02), (room[0][1], b, room[1][0] + 0.02), 0.004, 8)
                for b in (0.3 * deep, 0.7 * deep)
            ),
        )
    if m.chance(0.6):
        m.add("crumb_tray", box((0.03, room[0][1] - 0.02), (0.0, deep - 0.03), (foot + 0.01, foot + 0.014)))
        m.add("crumb_tray", box((0.03, room[0][1] - 0.02), (-0.008, 0.0), (foot + 0.004, foot + 0.024)))
        m.slide("crumb_tray", FRONT, 0.8 * deep)
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                box((a, a + 0.006), (0.3 * deep, 0.7 * deep), (foot + high, foot + high + 0.002))
                for a in np.linspace(0.2 * wide, 0.8 * wide, 8)
            ),
        )


def espresso_machine(m: Model) -> None:
    """An espresso machine: a portafilter that turns out, a steam wand and knob, a drip tray, a tank or its lid."""
    groups = m.pick(1, 1, 1, 2)
    wide, deep, high, foot = m.number(0.18, 0.3) * groups, m.number(0.26, 0.4), m.number(0.3, 0.42), m.number(0.008, 0.03)
    low, head, back, n = 0.09, high - m.number(0.08, 0.13), m.number(0.45, 0.6) * deep, m.sections()
    m.add(BASE, box((0, wide), (back, deep), (foot, high)), box((0, wide), (m.number(0.0, 0.04), back), (head, high)))
    tray_in = m.chance(0.7)
    if tray_in:  # a base with a pocket for the tray
        m.add(
            BASE,
            cut(box((0, wide), (0, back), (foot, low)), box((0.012, wide - 0.012), (-1, back - 0.01), (low - 0.05, low + 1))),
        )
        x, y = (0.014, wide - 0.014), (-0.004, back - 0.012)
        tray(m, "drip_tray", x, y, (low - 0.048, low - 0.004), "tub")
        m.add(
            "drip_tray", *(box((a, a + 0.005), y, (low - 0.004, low)) for a in np.linspace(x[0], x[1] - 0.005, m.pick(6, 10)))
        )
        m.slide("drip_tray", FRONT, 0.7 * back)
    else:
        m.add(BASE, box((0, wide), (0, back), (foot, low)))
        m.add(BASE, *(box((0.02, wide - 0.02), (b, b + 0.006), (low, low + 0.003)) for b in np.linspace(0.02, back - 0.02, 7)))
    feet(m, (0, wide), (0, deep), foot)
    side = m.pick(-1, 1)
    for k in range(groups):
        at = vec(wide * (k + 0.5) / groups, 0.45 * back, head)
        m.add(BASE, rod(at - vec(0, 0, 0.03), at + vec(0, 0, 0.005), 0.036, n))
        cup, grip, turn = at - vec(0, 0, 0.055), m.number(0.1, 0.15), m.pick(0, 20)
        solids = [rod(cup, at - vec(0, 0, 0.03), 0.034, n), rod(cup - vec(0, 0, 0.02), cup, 0.008, 8)]
        solids.append(rod(cup + vec(0, -0.03, 0.012), cup + vec(0, -0.03 - grip, 0.005), m.number(0.009, 0.014), n))
        m.add(
            f"portafilter_{k}", *(turned(s, (0, 0, 1), side * turn, at) for s in ([join(*solids)] if m.chance(0.4) else solids))
        )
        m.hinge(f"portafilter_{k}", at - vec(0, 0, 0.03), (0, 0, -side), m.pick(45, 60, 90))
    top = vec(0.02 if side < 0 else wide - 0.02, 0.02, head)
    m.add("wand", ball(top, (0.011,) * 3, 10), tube([top, top - vec(0, 0.015, 0.06), top - vec(0, 0.03, 0.14)], 0.004, 8))
    m.hinge("wand", top, *m.pick([(0, 0, side), 90], [(0, side, 0), (-20, 40)]))
    if m.chance(0.8):
        if m.chance(0.6):
            c = m.pick((0.0 if side < 0 else wide, 0.15 * deep), None)
            at, axis = (vec(c[0], c[1], high - 0.04), (side, 0, 0)) if c else (vec(top[0], 0.02, high - 0.03), (0, 0, 1))
            dial(m, "steam_knob", at if c else vec(top[0] + 0.005 * side, 0.06, high), axis, 0.02)
        else:
            at = vec(top[0], 0.05, high)
            m.add(BASE, box((at[0] - 0.008, at[0] + 0.008), (0.04, 0.06), (high, high + 0.006)))
            lever(m, "steam_lever", at + vec(0, 0, 0.008), at + vec(0, -0.07, 0.02), 0.009)
            m.hinge("steam_lever", at + vec(0, 0, 0.008), (-1, 0, 0), m.pick(40, 70))
    if m.chance(0.3) and groups == 1:  # a lever that pulls the piston
        at = vec(wide / 2, 0.45 * back, high + 0.03)
        m.add(BASE, box((at[0] - 0.015, at[0] + 0.015), (at[1] - 0.02, at[1] + 0.02), (high, high + 0.045)))
        lever(m, "lever", at, at + vec(0, -0.05, 0.2), 0.014)
        m.add("lever", rod(at - vec(0.022, 0, 0), at + vec(0.022, 0, 0), 0.01, n))
        m.hinge("lever", at, (1, 0, 0), m.pick(70, 100))
    else:
        for k in range(m.pick(0, 2, 3)):
            button(m, f"button_{k}", (wide * (0.25 + 0.2 * k), m.pieces[1][1].bounds[0, 1], high - 0.03), FRONT, 0.018)
    kind = m.pick("lid", "tank", "none")
    if kind == "lid":
        m.add("tank_lid", box((0.02, wide - 0.02), (back + 0.02, deep - 0.004), (high + 0.001, high + 0.009)))
        m.hinge("tank_lid", (wide / 2, deep - 0.004, high), (-1, 0, 0), m.pick(70, 90, 110))
    elif kind == "tank":
        m.add(
            "tank",
            cut(
                box((0.01, wide - 0.01), (deep, deep + 0.09), (0.05, high)),
                box((0.014, wide - 0.014), (deep + 0.004, deep + 0.086), (0.056, 1)),
            ),
        )
        m.slide("tank", (0, 0, 1), 0.15)
    if m.chance(0.5):
        m.add(BASE, prism(rectangle((0.006, wide - 0.006), (0.02, back), 0.004), "z", (high + 0.02, high + 0.025)))
        m.add(
            BASE,
            *(rod((a, b, high), (a, b, high + 0.022), 0.003, 6) for a in (0.008, wide - 0.008) for b in (0.022, back - 0.002)),
        )
