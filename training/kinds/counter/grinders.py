"""Coffee grinders and pepper mills."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_parts import body, drawer, look
from training.kinds.kitchen_trims import dial, feet, fluted, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, tube, turned, vec


def coffee_grinder(m: Model) -> None:
    """A box mill with a crank, a drawer and a slide; or an electric one with a hopper, its lid, a ring and a bin."""
    n = m.pick(12, 16, 24)
    if m.chance(0.55):
        w, high = m.number(0.06, 0.09), m.number(0.1, 0.16)
        room = ((-w + 0.014, w - 0.014), (0.014, 0.014 + 0.4 * high))
        how = look(m, 0.1, ("slab", "rounded", "raised", "sheet"), ("knob", "knob", "cup", "none"))
        hollow = body(m, (-w, w), (0, 2 * w), (0.006, high), [room], how, 0.008)
        m.add(
            BASE,
            *(
                prism(rounded((-w - e, w + e), (-e, 2 * w + e), 0.006), "z", z)
                for e, z in ((0.012, (0, 0.01)), (0.008, (high - 0.01, high)))
            ),
        )
        drawer(m, "drawer", *room, 2 * w, how, "tub" if hollow else "none", "middle")
        at, dome = vec(0, w, high), m.number(0.03, 0.06)
        if m.chance(0.6):
            m.add(BASE, lathe([(0.8 * w, high), (0.7 * w, high + 0.6 * dome), (0.15 * w, high + dome)], n, (0, w, 0)))
        else:
            m.add(
                BASE,
                lathe([(0.4 * w, high), (0.8 * w, high + dome), (0.75 * w, high + dome), (0.3 * w, high + 0.01)], n, (0, w, 0)),
            )
            m.add(BASE, box((-0.76 * w, 0.76 * w), (w - 0.006, w + 0.006), (high + dome - 0.006, high + dome)))
        crank_up, start, reach = at + vec(0, 0, dome + 0.025), m.number(0, 360), m.number(0.09, 0.14)
        end = crank_up + vec(reach, 0, m.pick(0.0, 0.02))
        solids = [rod(at + vec(0, 0, 0.5 * dome), crank_up + vec(0, 0, 0.006), 0.005, 8)]
        solids.append(
            rod(crank_up, end, 0.005, 8)
            if m.chance(0.5)
            else box(*np.c_[crank_up - vec(0.01, 0.008, 0), end + vec(0.008, 0.008, 0.004)])
        )
        m.add("crank", *(turned(s, (0, 0, 1), start, at) for s in solids))
        m.spin("crank", at, (0, 0, 1))
        part = m.pick("grip", "grip", "crank")
        pin = [rod(end, end + vec(0, 0, 0.02), 0.004, 8)] if part == "grip" else []
        grip = [*pin, ball(end + vec(0, 0, 0.03 if pin else 0.014), (0.015, 0.015, 0.018), n)]
        m.add(part, *(turned(s, (0, 0, 1), start, at) for s in grip))
        if part == "grip":
            m.spin(
                "grip",
                turned(box((0, 1), (0, 1), (0, 1)).apply_translation(end), (0, 0, 1), start, at).vertices[0],
                (0, 0, 1),
                "crank",
            )
        return
    r, high, foot = m.number(0.05, 0.07), m.number(0.2, 0.28), 0.008
    round_ = m.chance(0.5)
    column = (
        lathe([(1.2 * r, foot), (r, high)], n) if round_ else prism(rounded((-r, r), (-r, 1.2 * r), 0.012), "z", (foot, high))
    )
    hole = (box((-0.7 * r, 0.7 * r), (-2 * r, 0.5 * r), (0.03, 0.03 + 0.4 * high)),)
    m.add(BASE, cut(column, *hole))
    feet(m, (-r, r), (-r, r), foot)
    bin_ = box((-0.66 * r, 0.66 * r), (-1.02 * r, 0.46 * r), (0.032, 0.028 + 0.38 * high))
    m.add("bin", cut(bin_, box((-0.6 * r, 0.6 * r), (-0.95 * r, 0.4 * r), (0.04, 1))) if m.chance(0.7) else bin_)
    m.slide("bin", (0, -1, 0), 1.3 * r)
    top, z = high + m.number(0.06, 0.1), high + 0.016
    m.add("ring", fluted(1.02 * r, m.pick(12, 20), (high + 0.001, z)))
    m.hinge("ring", (0, 0, high), (0, 0, 1), m.pick(90, 180)) if m.chance(0.5) else m.spin("ring", (0, 0, high), (0, 0, 1))
    m.add(BASE, lathe([(0.7 * r, z), (1.15 * r, top), (1.1 * r, top), (0.65 * r, z + 0.004)], n))
    m.add("lid", lathe([(1.18 * r, top + 0.001), (1.18 * r, top + 0.012), (0.4 * r, top + 0.018)], n))
    if m.chance(0.5):
        m.add("lid", rod((0, 0, top + 0.015), (0, 0, top + 0.032), 0.01, 10))
        m.slide("lid", (0, 0, 1), 0.08)
    else:
        m.add(BASE, box((-0.012, 0.012), (1.05 * r, 1.25 * r), (top - 0.03, top)))
        m.hinge("lid", (0, 1.2 * r, top + 0.002), (-1, 0, 0), m.pick(80, 110))
    dial(m, "knob", (0, -1.08 * r if round_ else -r, 0.03 + 0.55 * high), (0, -1, 0), 0.014)


def pepper_mill(m: Model) -> None:
    """Mills with a turned top, a crank or a wheel, perhaps beside shakers that stay, on a tray."""
    count = m.pick(1, 1, 2)
    for k in range(count):
        n, r, high, x = m.pick(8, 12, 16, 24, 32), m.number(0.02, 0.032), m.number(0.1, 0.4), 0.09 * k
        waist, split = m.number(0.55, 1.0), high * m.number(0.6, 0.75)
        profile = [(r, 0.0), (r, 0.02), (waist * r, 0.4 * split), (m.number(0.8, 1.0) * r, 0.9 * split), (0.8 * r, split)]
        m.add(BASE, lathe(profile, n, (x, 0, 0)))
        style, top, s = (
            m.pick("turned", "turned", "crank", "wheel", "shaker" if k else "turned"),
            f"top_{k}",
            split + abs(m.gap(0.1)),
        )
        dome = [
            (0.75 * r, s),
            (m.number(0.9, 1.15) * r, s + 0.4 * (high - s)),
            (0.7 * r, s + 0.8 * (high - s)),
            (0.2 * r, high),
        ]
        if style == "shaker":
            m.add(BASE, lathe(dome, n, (x, 0, 0)))
            continue
        if style == "wheel":
            m.add(top, fluted(1.05 * r, n, (s, s + 0.02), (x, 0, 0)), rod((x, 0, s + 0.02), (x, 0, s + 0.028), 0.6 * r, n))
        elif style == "crank":
            m.add(BASE, lathe([(0.8 * r, s), (0.9 * r, s + 0.01), (0.3 * r, s + 0.03)], n, (x, 0, 0)))
            up = vec(x, 0, s + 0.04)
            m.add(
                top,
                rod(up - vec(0, 0, 0.02), up + vec(0, 0, 0.003), 0.004, 8),
                tube([up, up + vec(0.025, 0, 0.012), up + vec(0.055, 0, 0.012)], 0.003, 6),
            )
            m.add(top, rod(up + vec(0.055, 0, 0.005), up + vec(0.055, 0, 0.04), 0.008, 10))
        else:
            m.add(top, lathe(dome, n, (x, 0, 0)))
            if m.chance(0.6):
                nut = m.pick(f"nut_{k}", top)
                m.add(nut, ball((x, 0, high + 0.006), (0.008,) * 3, 10))
                if nut != top:  # its neck shows
                    m.add(nut, rod((x, 0, high - 0.004), (x, 0, high + 0.002), 0.004, 8))
                    m.spin(nut, (x, 0, high), (0, 0, 1), top)
        m.spin(top, (x, 0, s), (0, 0, 1))
        if m.chance(0.3):
            m.add(BASE, ring((x, 0, 0.9 * split), (0, 0, 1), r, 0.002, n))
    if m.chance(0.3):
        m.add(BASE, prism(rounded((-0.06, 0.09 * count), (-0.06, 0.06), 0.02), "z", (-0.008, 0.0)))
