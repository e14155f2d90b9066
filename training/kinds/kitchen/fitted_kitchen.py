"""Fitted kitchens: runs of base units with a sink and a dishwasher."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.kitchen_parts import FRONTS, Look, fill, tray
from training.kinds.kitchen_trims import dial, feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.shells import Room, manner, place
from training.kinds.solids import Span, box, cut, prism, rod, rounded, tube

FRONT = (0, -1, 0)


def cell(m: Model, x: Span, deep: float, z: Span, t: float) -> Room:
    """One unit of boards without a top; its room."""
    m.add(BASE, *(box(s, (0.0, deep), z) for s in ((x[0], x[0] + t), (x[1] - t, x[1]))))
    m.add(BASE, box((x[0] + t, x[1] - t), (0.0, deep), (z[0], z[0] + t)), box(x, (deep - 0.006, deep), z))
    return (x[0] + t, x[1] - t), (z[0] + t, z[1] - 0.004)


def _drawers(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """A bank of two to four drawers."""
    shares = np.cumsum([0.0, *m.pick((1.0, 1.0), (1.2, 1.0, 0.5), (1.0, 1.0, 1.0), (1.3, 0.6, 0.6, 0.6))])
    ends = room[1][0] + (room[1][1] - room[1][0]) * shares / shares[-1]
    for k, (a, b) in enumerate(itertools.pairwise(ends)):
        place(m, f"{name}_drawer_{k}", "drawer", (room[0], (float(a) + 0.008, float(b) - 0.008)), how, deep)


def _sink(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """Doors below a sink, a false front above them or a flap that tips; a waste pipe inside."""
    x, z = room
    cuts = z[1] - m.pick(0.0, 0.12, 0.15)
    if cuts < z[1]:
        above = (x, (cuts + 0.014, z[1]))
        place(m, f"{name}_tip", m.pick("false", "bottom"), above, how, deep)
    pair = x[1] - x[0] > 0.55
    place(m, f"{name}_door", "pair" if pair else m.pick("left", "right"), (x, (z[0], cuts)), how, deep)
    c, b = middle(x), 0.5 * deep
    m.add(
        BASE,
        tube(
            [(c, b, z[1] - 0.12), (c, b, z[1] - 0.35), (c + 0.08, b, z[1] - 0.35), (c + 0.08, deep - 0.01, z[1] - 0.3)], 0.02, 8
        ),
    )


def _dishwasher(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """A panel that falls with the door of the machine behind it; two baskets of wire."""
    x, z = room
    t = 0.018
    m.add(f"{name}_panel", box((x[0] + 0.004, x[1] - 0.004), (max(how.depth[1], 0.001), 0.05), (z[0] + 0.03, z[1] - 0.02)))
    place(m, f"{name}_panel", "bottom", (x, z), how, deep)
    for k, c in enumerate((z[0] + 0.1, z[0] + 0.42)):
        tray(m, f"{name}_basket_{k}", (x[0] + t, x[1] - t), (0.07, deep - 0.06), (c, c + 0.13), "wire")
        m.slide(f"{name}_basket_{k}", FRONT, 0.42)
        m.add(
            BASE,
            *(box(s, (0.07, deep - 0.03), (c + 0.04, c + 0.06)) for s in ((x[0], x[0] + t - 0.002), (x[1] - t + 0.002, x[1]))),
        )


def _carousel(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """Two or three round trays on a post that turn behind a door."""
    x, z = room
    place(m, f"{name}_door", m.pick("left", "right"), room, how, deep)
    c, b, part = middle(x), max(how.depth[1], 0.0) + 0.5 * (deep - max(how.depth[1], 0.0)), f"{name}_carousel"
    r = min(0.46 * (x[1] - x[0]), 0.44 * (deep - how.depth[1]))
    m.add(part, rod((c, b, z[0]), (c, b, z[1] - 0.04), 0.012, 10))
    disc = Spot(c, b).buffer(r, quad_segs=m.pick(4, 8))
    for h in np.linspace(z[0] + 0.03, z[1] - 0.1, m.pick(2, 3) + 1)[:-1]:
        m.add(part, prism(disc, "z", (h, h + 0.01)), prism(disc.difference(disc.buffer(-0.006)), "z", (h, h + 0.05)))
    m.spin(part, (c, b, z[0]), (0, 0, 1))


def _pull_out(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """A front that comes out with bins or two tiers of wire."""
    x, z = room
    lap = 0.008 if how.sunk is None else -0.002
    part, span, tall = f"{name}_pull_out", (x[0] - lap, x[1] + lap), (z[0] - lap, z[1])
    fill(m, part, span, how.depth, tall, how, "top")
    start = max(how.depth[1], 0.0)
    if m.chance(0.5):
        for c in (z[0] + 0.06, z[0] + 0.36):
            tray(m, part, (x[0] + 0.02, x[1] - 0.02), (start, deep - 0.05), (c, c + 0.1), "wire")
        m.add(part, box((middle(x) - 0.01, middle(x) + 0.01), (start, start + 0.012), (z[0] + 0.02, z[0] + 0.5)))
    else:
        ends = np.linspace(start + 0.02, deep - 0.05, m.pick(2, 3))
        for a, b in itertools.pairwise(ends):
            tray(m, part, (x[0] + 0.03, x[1] - 0.03), (float(a), float(b) - 0.01), (z[0] + 0.03, z[0] + 0.4), "tub")
        m.add(part, box((x[0] + 0.02, x[1] - 0.02), (start, deep - 0.05), (z[0] + 0.015, z[0] + 0.03)))
    m.slide(part, FRONT, 0.75 * deep)


def _plain(m: Model, name: str, room: Room, deep: float, how: Look) -> None:
    """A door or two, perhaps below one drawer, or an open room."""
    x, z = room
    if m.chance(0.4):
        cuts = z[1] - 0.16
        place(m, f"{name}_drawer", "drawer", (x, (cuts + 0.016, z[1])), how, deep)
        z = (z[0], cuts)
    place(m, f"{name}_door", "pair" if x[1] - x[0] > 0.6 else m.pick("left", "right", "open"), (x, z), how, deep)
    m.add(BASE, box(x, (0.06, deep - 0.01), (middle(z), middle(z) + 0.016)))


UNITS: dict[str, tuple[Callable[[Model, str, Room, float, Look], None], tuple[float, ...]]] = {
    "drawers": (_drawers, (0.4, 0.6, 0.8)),
    "sink": (_sink, (0.6, 0.8)),
    "dishwasher": (_dishwasher, (0.45, 0.6)),
    "carousel": (_carousel, (0.5, 0.6)),
    "pull_out": (_pull_out, (0.3, 0.4)),
    "plain": (_plain, (0.4, 0.5, 0.8)),
}


def kitchen_base_run(m: Model) -> None:
    """Base units side by side: drawers, a sink over doors, a dishwasher's panel, a carousel, a pull-out, below one worktop."""
    how = manner(m, tuple(f for f in FRONTS if f not in ("glass", "sheet")))
    foot, high, deep, t = m.number(0.08, 0.15), m.number(0.82, 0.9), m.number(0.54, 0.62), 0.016
    others = ["drawers", "dishwasher", "carousel", "pull_out", "plain", "plain", "drawers"]
    plan = [str(p) for p in m.rng.permutation(["sink", *m.rng.permutation(others)[: m.pick(1, 2, 3, 4)]])]
    at, bowl = 0.0, (0.0, 0.6)
    for k, job in enumerate(plan):
        make, widths = UNITS[job]
        x = (at, at + m.pick(*widths))
        make(m, f"{job}_{k}", cell(m, x, deep, (foot, high), t), deep, how)
        bowl, at = (x if job == "sink" else bowl), x[1]
    if m.chance(0.6):
        m.add(
            BASE,
            box((0.0, at), (0.05, 0.066), (0, foot)),
            *(box(s, (0.066, deep), (0, foot)) for s in ((0, 0.016), (at - 0.016, at))),
        )
    else:
        feet(m, (0, at), (0, deep), foot)
    _worktop(m, (0.0, at), deep, high, bowl)


def _worktop(m: Model, x: Span, deep: float, high: float, bowl: Span) -> None:
    """A worktop with a sink let into it, a tap that turns, perhaps a hob and an upstand."""
    thick, over = m.number(0.02, 0.045), m.pick(0.0, 0.01, 0.02)
    slab = box((x[0] - over, x[1] + over), (-0.035, deep), (high, high + thick))
    a, b, top = (bowl[0] + 0.07, bowl[1] - 0.07), (0.08, deep - 0.12), high + thick
    depth = m.number(0.14, 0.2)
    m.add(BASE, cut(slab, prism(rounded(a, b, 0.03), "z", (high - 1, high + 1))))
    inner = rounded(a, b, 0.03).buffer(-0.004)
    m.add(BASE, prism(rounded(a, b, 0.03).buffer(m.pick(0.0, 0.015)).difference(inner), "z", (top - 0.004, top + 0.003)))
    m.add(
        BASE,
        prism(rounded(a, b, 0.03).difference(inner), "z", (top - depth, top)),
        prism(inner, "z", (top - depth, top - depth + 0.004)),
    )
    c, d, tall = middle(a), deep - 0.06, m.number(0.2, 0.35)
    m.add(BASE, rod((c, d, top), (c, d, top + 0.04), 0.026, 12))
    neck = [
        (c, d, top + 0.04),
        (c, d, top + tall),
        (c, d - 0.06, top + tall + 0.03),
        (c, d - 0.17, top + tall),
        (c, d - 0.18, top + tall - 0.05),
    ]
    m.add("tap", tube(neck, 0.012, 8))
    m.hinge("tap", (c, d, top + 0.04), (0, 0, 1), (-90, 90))
    lever = "tap" if m.chance(0.3) else "tap_lever"
    m.add(lever, rod((c + 0.02, d, top + 0.02), (c + 0.05, d, top + 0.02), 0.012, 10))
    m.add(lever, rod((c + 0.045, d, top + 0.02), (c + 0.06, d - 0.02, top + 0.09), 0.005, 8))
    if lever == "tap_lever":
        m.hinge(lever, (c + 0.05, d, top + 0.02), (1, 0, 0), m.pick(40, 60, 90))
    sides = [s for s in ((x[0], bowl[0]), (bowl[1], x[1])) if s[1] - s[0] > 0.62]
    if sides and m.chance(0.6):
        p = middle(sides[0])
        m.add(BASE, box((p - 0.29, p + 0.29), (0.03, deep - 0.05), (top, top + 0.005)))
        spots = [(p + e, f) for e in (-0.14, 0.14) for f in (0.16, deep - 0.18)]
        m.add(BASE, *(rod((e, f, top), (e, f, top + m.pick(0.006, 0.02)), 0.08, 20) for e, f in spots))
        if m.chance(0.5):
            for k, e in enumerate((-0.15, -0.05, 0.05, 0.15)):
                dial(m, f"hob_knob_{k}", (p + e, 0.06, top + 0.005), (0, 0, 1), 0.018)
    if m.chance(0.4):
        m.add(BASE, box(x, (deep - 0.012, deep), (top, top + m.pick(0.05, 0.1, 0.4))))
