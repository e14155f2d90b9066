"""Food processors and salad spinners."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.counter.counter_appliances import bar, tower
from training.kinds.kitchen_trims import button, cable, dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, prism, ring, rod, rounded, turned, vec


def vessel(r: float, low: float, high: float, wall: float, n: int, taper: float = 1.0) -> Trimesh:
    """An open round vessel about z."""
    inner = [(r - wall, high), (taper * r - wall, low + wall)]
    return lathe([(taper * r, low), (r, high), *inner], n)


def _loop(m: Model, part: str, r: float, low: float, high: float, angle: float) -> None:
    """A handle at the side of a round vessel."""
    out, x = r + m.number(0.035, 0.05), 0.95 * r
    if m.chance(0.5):
        grip = bar([(x, 0, high), (out, 0, high), (out, 0, low), (x, 0, low)], 0.009, 8)
    else:
        grip = prism(
            [
                (x, low),
                (out, low + 0.015),
                (out, high),
                (x, high),
                (x, high - 0.015),
                (out - 0.014, high - 0.015),
                (out - 0.014, low + 0.025),
                (x, low + 0.014),
            ],
            "y",
            (-0.011, 0.011),
        )
    m.add(part, turned(grip, (0, 0, 1), angle, (0, 0, 0)))


def food_processor(m: Model) -> None:
    """Make a food processor: bowl on its motor or beside it, or a chopper; chute, pusher, blades or disc, dial or paddles."""
    style, n = m.pick("on", "on", "beside", "chopper"), m.pick(16, 24, 32)
    if style == "chopper":
        _chopper(m, n)
        return
    r, tall = m.number(0.08, 0.105), m.number(0.11, 0.15)
    low = m.number(0.1, 0.15) if style == "on" else 0.05
    top = low + tall
    _processor_body(m, style, r, low, top)
    m.add(BASE, vessel(r, low, top, 0.004, n, m.pick(1.0, 0.93)))
    _loop(m, BASE, r, low + 0.02, top - 0.01, m.pick(0, -20, 160, 180) if style == "on" else m.pick(-90, -60, 180))
    if m.chance(0.8):
        _cutter(m, m.pick("blades", "blades", "disc"), r, low, top, n)
    lid = m.pick("lid", "lid", BASE)
    m.add(lid, lathe([(1.02 * r, top), (1.02 * r, top + 0.012), (0.85 * r, top + m.number(0.013, 0.025))], n))
    if lid == "lid":
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.16))
    _chute(m, lid, r, top + 0.01)
    if m.chance(0.4):
        cable(m, (0, r + 0.02, 0.02), 0.2)


def _processor_body(m: Model, style: str, r: float, low: float, top: float) -> None:
    wide, y = r + m.number(0.005, 0.02), -r - 0.012
    if style == "on":
        levels = [(0.96, 0.006), (1, 0.02), (1, 0.7 * low), (m.pick(0.78, 0.95), low)]
        m.add(BASE, tower((-wide, wide), (y, wide), m.pick(0.02, 0.05), levels))
        level = 0.42 * low
    else:
        block = 2 * wide
        m.add(BASE, tower((-wide, block + wide), (-wide, wide), 0.03, [(0.97, 0.004), (1, 0.012), (1, low)]))
        m.add(
            BASE,
            tower((wide, block + 0.96 * wide), (-0.94 * wide, 0.94 * wide), 0.03, [(1, low), (1, top), (0.85, top + 0.03)]),
        )
        m.add(BASE, *(rod((a, b, 0), (a, b, 0.01), 0.01, 8) for a in (-0.7 * wide, 2.6 * wide) for b in (-0.07, 0.07)))
    at = vec(0, y, level) if style == "on" else vec(2 * wide, -0.94 * wide, 0.6 * top)
    how = m.pick("dial", "dial", "buttons", "paddles")
    if how == "dial":
        dial(m, "dial", at, (0, -1, 0), min(0.028, 0.35 * low) if style == "on" else 0.028)
    for k in range(m.pick(2, 3) if how != "dial" else 0):
        c = at + vec(0.034 * (k - 1), 0, 0)
        if how == "buttons":
            button(m, f"button_{k}", c, (0, -1, 0), 0.02)
            continue
        m.add(f"paddle_{k}", box((c[0] - 0.012, c[0] + 0.012), (c[1] - 0.012, c[1] + 0.002), (c[2] - 0.022, c[2] + 0.02)))
        m.hinge(f"paddle_{k}", c + vec(0, 0, 0.02), (1, 0, 0), m.pick(8, 12))
    if style == "on" and m.chance(0.8):
        m.add(BASE, *(rod((a, b, 0), (a, b, 0.01), 0.012, 8) for a in (-0.7 * r, 0.7 * r) for b in (-0.7 * r, 0.7 * r)))


def _cutter(m: Model, style: str, r: float, low: float, top: float, n: int) -> None:
    m.add("blade", rod((0, 0, low + 0.004), (0, 0, top - 0.012), m.pick(0.012, 0.016), 12))
    if style == "disc":
        z = top - 0.022
        disc = rod((0, 0, z), (0, 0, z + 0.003), 0.9 * r, n)
        slots = [
            turned(box((0.3 * r, 0.8 * r), (-0.004, 0.004), (z - 1, z + 1)), (0, 0, 1), a, (0, 0, 0)) for a in (0, 120, 240)
        ]
        m.add("blade", cut(disc, *slots))
    else:
        t = np.linspace(0, 1.4, 6)
        outer, inner = (
            np.c_[np.cos(t), np.sin(t)] * (0.2 + 0.5 * t[:, None]),
            np.c_[np.cos(t), np.sin(t)] * (0.1 + 0.38 * t[:, None]),
        )
        for k in range(m.pick(2, 2, 3)):
            z = low + 0.012 + 0.02 * k
            wing = prism(r * np.concatenate([outer, inner[::-1]]), "z", (z, z + 0.003))
            m.add("blade", turned(wing, (0, 0, 1), 180 * k + 20, (0, 0, 0)))
    m.spin("blade", (0, 0, low), (0, 0, 1))


def _chute(m: Model, lid: str, r: float, z: float) -> None:
    at, high = (m.pick(0.0, 0.35) * r, m.pick(0.0, -0.4, 0.4) * r), m.number(0.06, 0.1)
    a, b = m.number(0.02, 0.027), m.pick(0.02, 0.032)
    spans = (at[0] - b, at[0] + b), (at[1] - a, at[1] + a)
    outline = rounded(*spans, 0.95 * min(a, b))
    inside = rounded(
        (spans[0][0] + 0.003, spans[0][1] - 0.003), (spans[1][0] + 0.003, spans[1][1] - 0.003), 0.9 * min(a, b) - 0.003
    )
    m.add(lid, prism(outline.difference(inside), "z", (z - 0.002, z + high)))
    if m.chance(0.4):
        m.add(lid, prism(outline.buffer(0.006).difference(inside), "z", (z + high - 0.006, z + high)))
    if m.chance(0.85):
        m.add("pusher", prism(inside.buffer(-0.0015), "z", (z + 0.004, z + high + 0.006)))
        m.add("pusher", prism(outline.buffer(0.004), "z", (z + high + 0.001, z + high + m.number(0.008, 0.02))))
        m.slide("pusher", (0, 0, 1), 0.9 * high, lid)


def _chopper(m: Model, n: int) -> None:
    r, tall = m.number(0.055, 0.075), m.number(0.08, 0.11)
    m.add(BASE, vessel(r, 0.004, tall, 0.004, n, m.pick(1.0, 0.85)), ring((0, 0, 0.006), (0, 0, 1), 0.85 * r, 0.005, 16))
    _cutter(m, "blades", 0.85 * r, 0.004, tall, n)
    high, pinch = tall + m.number(0.08, 0.12), m.pick(0.7, 0.9)
    m.add(
        "motor",
        lathe(
            [(1.03 * r, tall), (1.03 * r, tall + 0.02), (pinch * r, tall + 0.03), (pinch * r, high - 0.01), (0.6 * r, high)], n
        ),
    )
    m.slide("motor", (0, 0, 1), m.number(0.08, 0.12))
    for k in range(m.pick(1, 2)):
        button(m, f"button_{k}", (0.024 * k - 0.012 * m.pick(0, 1), 0, high), (0, 0, 1), 0.02, "motor")
    if m.chance(0.5):
        _loop(m, BASE, r, 0.025, tall - 0.015, m.pick(0, -40))
    if m.chance(0.4):
        m.add("motor", box((-0.02, 0.02), (-pinch * r - 0.002, 0), (tall + 0.045, tall + 0.06)))


def salad_spinner(m: Model) -> None:
    """Make a salad spinner with a crank, a pull cord, a pump knob or a lever; bowl open or solid, a slotted basket, a brake."""
    r, tall, n = m.number(0.11, 0.14), m.number(0.12, 0.17), m.pick(20, 28, 36)
    taper, open_ = m.pick(0.6, 0.75, 0.9), m.chance(0.75)
    profile = [(taper * r, 0), (0.93 * r, 0.45 * tall), (r, tall)]
    inside = [(r - 0.004, tall), (0.93 * r - 0.004, 0.45 * tall), (taper * r - 0.004, 0.005)]
    m.add(BASE, lathe(profile + inside if open_ else profile, n))
    if m.chance(0.5):
        m.add(BASE, ring((0, 0, tall - 0.003), (0, 0, 1), r, 0.004, n))
    if m.chance(0.4):
        m.add(BASE, ring((0, 0, 0.003), (0, 0, 1), taper * r, 0.004, n))
    if open_:
        _basket(m, r, tall, taper, n)
    lid, z = m.pick("lid", "lid", "lid", BASE), tall + m.number(0.012, 0.03)
    m.add(lid, lathe([(1.02 * r, tall + 0.001), (1.02 * r, tall + 0.01), (0.85 * r, z), (0.2 * r, z + 0.004)], n))
    if lid == "lid":
        m.slide("lid", (0, 0, 1), m.number(0.6, 0.95) * tall)
    m.pick(_crank, _crank, _pump, _cord)(m, lid, r, z, n)
    if m.chance(0.4):
        button(m, "brake", (0.6 * r, 0.25 * r, z - 0.002), (0, 0, 1), 0.022, lid)


def _basket(m: Model, r: float, tall: float, taper: float, n: int) -> None:
    low, wide = 0.014, 0.9 * r
    bottom = 0.84 * taper * r
    if m.chance(0.5):
        m.add(
            "basket",
            *(
                rod((bottom * np.cos(t), bottom * np.sin(t), low), (wide * np.cos(t), wide * np.sin(t), tall - 0.008), 0.003, 5)
                for t in np.linspace(0, 2 * np.pi, 20, endpoint=False)
            ),
            rod((0, 0, low - 0.003), (0, 0, low + 0.002), bottom, n),
        )
        m.add(
            "basket",
            *(ring((0, 0, c), (0, 0, 1), s, 0.0035, n) for c, s in ((tall - 0.008, wide), (tall / 2, (wide + bottom) / 2))),
        )
    else:
        m.add(
            "basket",
            lathe([(bottom, low), (wide, tall - 0.006), (wide - 0.003, tall - 0.006), (bottom - 0.003, low + 0.003)], n),
        )
    m.spin("basket", (0, 0, low), (0, 0, 1))


def _crank(m: Model, lid: str, r: float, z: float, n: int) -> None:
    c, long, w = m.pick(0.0, 0.0, 0.3) * r, m.number(0.5, 0.75) * r, m.number(0.01, 0.016)
    m.add(lid, rod((c, 0, z - 0.006), (c, 0, z + 0.012), 0.025, n))
    outline = rounded((c - long - w, c + 0.02), (-w, w), 0.9 * w)
    m.add("crank", prism(outline, "z", (z + 0.013, z + 0.022)))
    end = vec(c - long, 0, z + 0.02)
    grip = m.pick("knob", "post")
    m.add("crank", rod(end, end + vec(0, 0, 0.03), 0.009, 12))
    if grip == "knob":
        m.add("crank", ball(end + vec(0, 0, 0.035), (0.018, 0.018, 0.014), 12))
    m.spin("crank", (c, 0, z + 0.013), (0, 0, 1), lid)


def _pump(m: Model, lid: str, r: float, z: float, n: int) -> None:
    wide, up = m.number(0.2, 0.42) * r, m.number(0.03, 0.05)
    m.add(
        lid, lathe([(1.15 * wide, z - 0.006), (1.15 * wide, z + 0.01), (1.03 * wide, z + 0.012), (1.02 * wide, z + 0.004)], n)
    )
    m.add("pump", rod((0, 0, z - 0.004), (0, 0, z + up), m.pick(0.5, 0.97) * wide, n))
    m.add("pump", lathe([(wide, z + up), (wide, z + up + 0.012), (0.5 * wide, z + up + 0.018)], n))
    m.slide("pump", (0, 0, -1), up - 0.014, lid)
    if m.chance(0.4):
        m.add("lock", box((1.3 * wide, 1.3 * wide + 0.02), (-0.008, 0.008), (z - 0.002, z + 0.008)))
        m.slide("lock", (-1, 0, 0), 0.01, lid)


def _cord(m: Model, lid: str, r: float, z: float, n: int) -> None:
    wide, out = m.number(0.4, 0.55) * r, m.number(0.12, 0.2)
    m.add(lid, rod((0, 0, z - 0.004), (0, 0, z + 0.022), wide, n))
    level, half = z + 0.014, m.number(0.012, 0.02)
    at = vec(wide + 0.012, 0, level)
    m.add(lid, rod((wide - 0.004, 0, level), (wide + 0.004, 0, level), 0.008, 10))
    grip = m.pick("bar", "ring", "ball")
    if grip == "bar":
        m.add("pull", rod(at - vec(0, 1.6 * half, 0), at + vec(0, 1.6 * half, 0), 0.008, 10))
    elif grip == "ring":
        m.add("pull", ring(at + vec(half, 0, 0), (0, 0, 1), half, 0.004, 16))
    else:
        m.add("pull", ball(at, (half, half, half), 10))
    m.add("pull", rod((0.2 * wide, 0, level), at, 0.003, 6))
    m.slide("pull", (1, 0, 0), min(out, 0.6 * wide + 0.05), lid)
