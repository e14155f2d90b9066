"""Sailing boats: a dinghy, a keel yacht, a catamaran."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from training.kinds.boats_and_trains.sails import hull, rig, rudder
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, rectangle, ring, rod, rounded, tube, vec
from training.kinds.wheels import beam


def _dinghy(m: Model) -> None:
    """An open boat with thwarts and a board that is drawn up through its case."""
    long = m.number(3.4, 5.0)
    half, low = 0.17 * long, m.number(0.5, 0.8)
    deck = low + m.number(0.5, 0.65)
    skin = hull(m, long, half, (low, deck))
    plan = np.array(
        [(-0.5, 0.36), (0.5, 0.36), (0.66, 0.5), (0.66, 0.75), (0.45, 0.92), (-0.45, 0.92), (-0.66, 0.75), (-0.66, 0.5)]
    )
    pit = prism(plan * [half, long], "z", (low + 0.45 * (deck - low), deck + 1))
    m.add(BASE, cut(skin, pit))
    y = 0.44 * long
    m.add(BASE, box((-0.67 * half, 0.67 * half), (0.6 * long, 0.6 * long + 0.22), (deck - 0.16, deck - 0.12)))
    for s in (-1, 1) if m.chance(0.5) else ():
        m.add(BASE, box((s * 0.66 * half, s * 0.42 * half), (0.5 * long, 0.75 * long), (deck - 0.16, deck - 0.12)))
    m.add(BASE, *(box((s * 0.025, s * 0.06), (y - 0.12, y + 0.45), (low - 0.01, deck - 0.1)) for s in (-1, 1)))
    m.add(
        "board",
        prism([(y, deck + 0.08), (y, 0.02), (y + 0.26, 0.08), (y + 0.34, deck + 0.08)], "x", (-0.018, 0.018)),
        box((-0.05, 0.05), (y - 0.02, y + 0.36), (deck + 0.06, deck + 0.1)),
    )
    m.slide("board", (0, 0, 1), 0.8 * (low - 0.02))
    rig(
        m,
        vec(0, 0.34 * long, deck - 0.05),
        long,
        m.number(1.15, 1.4) * long,
        vec(0, 0.03, deck + 0.03),
        0.95 * long,
        0.8 * half,
    )
    rudder(m, 0.0, long, (0.2, deck), long, True)
    if m.chance(0.6):  # a launching cradle
        m.add(
            BASE,
            *(
                prism(rectangle((-0.7 * half, 0.7 * half), (0, low + 0.14)), "y", (c * long - 0.05, c * long + 0.05))
                for c in (0.35, 0.75)
            ),
        )


def _cabin(m: Model, long: float, half: float, deck: float) -> float:
    """A cabin with lights, a hatch that slides, a door or washboard, a hinged hatch on the foredeck; returns its height."""
    a, b, wide, tall = m.number(0.26, 0.32) * long, 0.64 * long, m.number(0.5, 0.6) * half, m.number(0.3, 0.5)
    side = [(a, deck - 0.05), (a + 0.1 * long, deck + 0.8 * tall), (b, deck + tall), (b + 0.05, deck - 0.05)]
    house, way = prism(side, "x", (-wide, wide)), 0.24 + 0.004 * long
    house = cut(house, box((-way, way), (b - 0.55, b + 1), (deck - 0.2, deck + 2)))
    m.add(BASE, house)
    for s in (-1, 1):
        for k in range(m.pick(1, 2, 3)):
            y = a + 0.14 * long + 0.1 * long * k
            m.add(
                BASE,
                prism(
                    rounded((y, y + 0.08 * long), (deck + 0.3 * tall, deck + 0.62 * tall), 0.04),
                    "x",
                    tuple(sorted((s * wide, s * (wide + 0.012)))),
                ),
            )
        m.add(BASE, box((s * (way + 0.01), s * (way + 0.05)), (b - 1.35, b), (deck + 0.9 * tall, deck + tall + 0.05)))
    roof = prism(
        rounded((-way - 0.005, way + 0.005), (b - 0.62, b + 0.03), 0.03), "z", (deck + tall + 0.008, deck + tall + 0.045)
    )
    m.add("hatch", roof, box((-0.08, 0.08), (b - 0.02, b + 0.03), (deck + tall + 0.045, deck + tall + 0.07)))
    m.slide("hatch", (0, -1, 0), m.number(0.5, 0.58))
    if m.chance(0.6):
        for s, name in ((-1, "door_left"), (1, "door_right")):
            x = tuple(sorted((s * 0.004, s * (way - 0.005))))
            m.add(
                name,
                box(x, (b + 0.01, b + 0.035), (deck - 0.1, deck + tall)),
                box((s * 0.03, s * 0.06), (b + 0.035, b + 0.06), (deck + 0.1, deck + 0.16)),
            )
            m.hinge(name, (s * way, b + 0.035, deck), (0, 0, -s), m.pick(90, 120))
    y, size, edge = 0.2 * long, m.number(0.2, 0.26), m.pick(-1, 1)
    m.add("fore_hatch", prism(rounded((-size, size), (y - size, y + size), 0.05), "z", (deck + 0.07, deck + 0.11)))
    m.add(BASE, box((-size + 0.02, size - 0.02), (y - size + 0.02, y + size - 0.02), (deck - 0.05, deck + 0.065)))
    m.hinge("fore_hatch", (0, y + edge * size, deck + 0.07), (-edge, 0, 0), m.pick(80, 100))
    return tall


def _rails(m: Model, long: float, half: float, deck: float) -> None:
    """A pulpit at the bow, stanchions with wires, winches."""
    edge = [(0.35, 0.14), (0.72, 0.35), (0.92, 0.55), (0.88, 0.8), (0.72, 0.99)]
    for s in (-1, 1):
        posts = [vec(s * (w * half - 0.05), y * long, deck - 0.02) for w, y in edge]
        m.add(BASE, *(rod(p, p + vec(0, 0, 0.58), 0.012, 6) for p in posts))
        m.add(
            BASE,
            *(rod(a + vec(0, 0, h), b + vec(0, 0, h), 0.006, 5) for h in (0.3, 0.57) for a, b in pairwise(posts)),
        )
        m.add(BASE, rod((s * 0.72 * half, 0.7 * long, deck), (s * 0.72 * half, 0.7 * long, deck + 0.16), 0.07, 10))
    w = 0.35 * half - 0.05
    m.add(
        BASE,
        tube(
            [
                (-w, 0.14 * long, deck + 0.56),
                (-0.12, 0.01 * long, deck + 0.6),
                (0.12, 0.01 * long, deck + 0.6),
                (w, 0.14 * long, deck + 0.56),
            ],
            0.014,
            6,
        ),
    )


def _yacht(m: Model) -> None:
    """A keel boat with cabin and cockpit, steered by tiller or wheel."""
    long = m.number(6.0, 10.5)
    half, depth = 0.16 * long, m.number(0.14, 0.2) * long
    deck = depth + m.number(0.13, 0.16) * long
    pit = prism(rounded((-0.4 * half, 0.4 * half), (0.655 * long, 0.95 * long), 0.1), "z", (deck - 0.45, deck + 1))
    m.add(BASE, cut(hull(m, long, half, (depth, deck)), pit))
    a, b = 0.4 * long, m.number(0.55, 0.62) * long
    keel = [(a, depth + 0.1), (a + 0.06 * long, 0.05), (b, 0.05), (b + 0.02 * long, depth + 0.15)]
    if m.chance(0.3):
        keel = [(0.22 * long, depth + 0.15), (0.4 * long, 0.05), (0.85 * long, 0.05), (0.9 * long, depth + 0.2)]
    elif m.chance(0.6):
        m.add(BASE, ball((0, (a + b) / 2 + 0.03 * long, 0.13), (0.16, 0.5 * (b - a) + 0.1, 0.13), 12))
    m.add(BASE, prism(keel, "x", (-0.07, 0.07)))
    tall, wheel = _cabin(m, long, half, deck), m.chance(0.5)
    mast = vec(0, 0.41 * long, deck + 0.75 * tall)
    height = m.number(1.15, 1.35) * long
    rig(m, mast, long, height, vec(0, 0.02 * long, deck + 0.05), 0.97 * long, 0.8 * half)
    m.add(BASE, rod((0, long, deck), mast + vec(0, 0, height), 0.007, 5))
    rudder(m, 0.0, long, (0.4 * depth, deck), long, not wheel)
    if wheel:
        y, r = 0.86 * long, m.number(0.36, 0.5)
        at = vec(0, y - 0.14, deck + 0.42)
        m.add(BASE, beam((0, y, deck - 0.5), (0, y - 0.03, deck + 0.5), 0.16, 0.18, (1, 0, 0), 0.7))
        m.add("wheel", ring(at, (0, 1, 0), r, 0.015, 24), rod(at - (0, 0.03, 0), at + vec(0, 0.1, 0), 0.04, 10))
        spokes = m.pick(3, 5, 6)
        m.add(
            "wheel", *(rod(at, at + r * vec(np.cos(t), 0, np.sin(t)), 0.01, 6) for t in 2 * np.pi * np.arange(spokes) / spokes)
        )
        m.spin("wheel", at, (0, 1, 0))
    if m.chance(0.7):
        _rails(m, long, half, deck)


def _catamaran(m: Model) -> None:
    """Two narrow hulls, beams and a net between them, a rudder on each hull."""
    long = m.number(4.5, 6.5)
    apart, half, deck = 0.2 * long, 0.045 * long, m.number(0.45, 0.55)
    for s in (-1, 1):
        m.add(BASE, hull(m, long, half, (0.0, deck), s * apart, 0.5))
    spans = (0.38 * long, 0.78 * long)
    m.add(BASE, *(rod((-apart, y, deck + 0.04), (apart, y, deck + 0.04), 0.05, 10) for y in spans))
    m.add(BASE, box((-apart + half, apart - half), (spans[0], spans[1]), (deck + 0.03, deck + 0.045)))
    m.add(BASE, *(rod((s * apart, 0.08 * long, deck), (0, spans[0] - 0.2 * long, deck + 0.05), 0.012, 6) for s in (-1, 1)))
    rig(
        m,
        vec(0, spans[0], deck + 0.08),
        long,
        m.number(1.4, 1.6) * long,
        vec(0, spans[0] - 0.2 * long, deck + 0.05),
        0.98 * long,
        0.95 * apart,
    )
    for s, name in ((-1, "_left"), (1, "_right")):
        rudder(m, s * apart, long, (-0.35, deck), long, True, name)


def sailboat(m: Model) -> None:
    """Make a dinghy with a board, a keel yacht with cabin, hatches, tiller or wheel, or a catamaran; sail set, furled, off."""
    m.pick(_dinghy, _yacht, _yacht, _catamaran)(m)
