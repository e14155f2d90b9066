"""Figures of creatures, modelled in pieces of which none moves: beasts, birds, fish, people, stuffed toys, insects."""

from __future__ import annotations

import numpy as np

from training.kinds.clay import Clay, clay, curve
from training.kinds.model import Model
from training.kinds.solids import Point, box, prism, ring, rod, turned, vec
from training.kinds.wheels import lathe

BEASTS = {  # leg, barrel, neck, its rise [deg], head, snout by the length of the back; that length [m]
    "dog": (0.45, 0.2, 0.2, 50, 0.17, 0.2, 0.6),
    "horse": (0.8, 0.25, 0.6, 50, 0.15, 0.35, 1.5),
    "cow": (0.55, 0.32, 0.3, 15, 0.19, 0.24, 1.6),
    "elephant": (0.55, 0.42, 0.25, 20, 0.32, 0.1, 1.7),
    "sheep": (0.4, 0.3, 0.25, 30, 0.15, 0.14, 0.9),
    "giraffe": (1.1, 0.27, 1.3, 70, 0.14, 0.22, 1.6),
    "deer": (0.75, 0.22, 0.45, 55, 0.14, 0.18, 1.1),
}
BIRDS = {  # pitch [deg], girth, neck, leg, beak, its girth by the length of the body; that length [m]
    "duck": (8, 0.3, 0.3, 0.08, 0.18, 0.09, 0.35),
    "owl": (80, 0.36, 0.02, 0.1, 0.08, 0.05, 0.3),
    "penguin": (84, 0.3, 0.04, 0.06, 0.15, 0.04, 0.7),
    "flamingo": (15, 0.24, 0.8, 1.2, 0.2, 0.05, 0.6),
    "hen": (20, 0.34, 0.22, 0.25, 0.1, 0.05, 0.35),
    "eagle": (40, 0.26, 0.12, 0.18, 0.14, 0.06, 0.6),
}


def _beast_legs(c: Clay, at: Point, r: float, leg: float, swing: float, folded: bool) -> None:
    """A pair of legs below a point, straight or folded on the ground."""
    x, y, z, w, whole = 0.6 * r, float(at[1]), float(at[2]), c.m.number(0.2, 0.32) * r + 0.02, c.m.chance(0.5)
    if folded:
        c.lump((0.8 * r, y, 0.6 * r), (0.35 * r, 0.65 * r, 0.6 * r), True)
        c.limb([(r, y + 0.1, w), (r, y - 0.3, w), (r, y - 0.55 * leg - 0.2, w)], [w, w, 0.8 * w], True)
        return
    for s in (-1, 1):
        path = [(s * x, y, z - 0.2 * r), (s * x, y + 0.4 * s * swing, 0.5 * leg), (s * x, y + s * swing, w)]
        c.jointed(path, (1.5 * w, w, 0.8 * w), whole)
        c.lump((s * x, y + s * swing - 0.3 * w, 0.5 * w), (w, 1.3 * w, 0.6 * w))


def _beast_head(c: Clay, name: str, at: Point, h: float, snout: float) -> None:
    """A head with snout, nose, ears and eyes, perhaps trunk, tusks, horns or antlers."""
    m, tip, nose = c.m, at + vec(0, -0.7 * h - snout, -0.35 * h), (0.45 if name == "cow" else 0.35) * h
    c.lump(at, vec(0.85, 1, 0.9) * h)
    c.limb([at, tip], [0.6 * h, nose])
    c.eyes(at + vec(0.6, -0.7, 0.3) * h, m.number(0.08, 0.18) * h)
    if name == "elephant":
        c.limb(curve(tip, tip - vec(0, 0.5, 0.2), tip + vec(0, -0.3, m.number(-0.8, 0.2)), 8), np.linspace(0.14, 0.06, 8))
        tusk = curve(tip + vec(0.15, 0.1, 0), tip + vec(0.2, -0.2, -0.3), tip + vec(0.2, -0.4, -0.1))
        c.limb(tusk, np.linspace(0.05, 0.015, 6), True)
        return c.lump(at + vec(1.3 * h, 0.1, 0), (0.8 * h, 0.05, h), True, (0, 0, 1), m.number(0, 40))
    root, ear = at + vec(0.55, 0.2, 0.7) * h, m.pick((0.25, 0.12, 0.6, 10), (0.15, 0.3, 0.6, 150), (0.35, 0.15, 0.35, 0))
    c.lump(root, vec(*ear[:3]) * h, True, (0, 1, 0), ear[3])
    if name in ("cow", "deer"):
        end = root + vec(0.6, -0.2, 0.9) * h * m.number(0.8, 1.6)
        c.limb(curve(root, root + vec(0.8, 0.2, 0.2) * h, end), np.linspace(0.13, 0.04, 6) * h, True)
        for k in (0.2, 0.6) if name == "deer" else ():
            c.limb([end - k * (end - root), end + vec(-0.1, -0.4, 0.6 - k) * h], [0.01] * 2, True)
    return c.lump(tip + nose * vec(0, -0.9, 0.2), nose * vec(0.5, 0.3, 0.35))


def four_legged_animal(m: Model) -> None:
    """A dog, horse, cow, elephant, sheep or other beast that stands, walks, sits or lies; nothing moves."""
    name, c = m.pick(*BEASTS), clay(m)
    leg, r, neck, rise, head, snout, size = (v * m.number(0.85, 1.15) for v in BEASTS[name])
    pose = m.pick("stand", "walk", "lie", "sit" if leg < 0.6 else "stand")
    high, up = leg + m.number(0.5, 0.8) * r, np.deg2rad(60 if pose == "sit" else rise)
    hip = vec(0, 0.42, 0.8 * r if pose in ("lie", "sit") else high)
    shoulder = vec(0, -0.05 if pose == "sit" else -0.42, 0.8 * r if pose == "lie" else high)
    c.limb([hip, (hip + shoulder) / 2 - vec(0, 0, m.number(-0.05, 0.15) * r), shoulder], [0.9 * r, r, 0.95 * r])
    root = shoulder + vec(0, -0.4 * r, 0.4 * r)
    top = root + (neck + 0.4 * head) * vec(0, -np.cos(up), np.sin(up))
    c.limb([root, (root + top) / 2, top], [0.65 * r, 0.4 * r + 0.3 * head, 0.6 * head])
    swing = m.number(0.1, 0.25) if pose == "walk" else 0.0
    _beast_legs(c, shoulder, 0.9 * r, leg, swing, pose == "lie")
    _beast_legs(c, hip, 0.9 * r, leg, -swing, pose in ("lie", "sit"))
    fuse = len(m.pieces)
    _beast_head(c, name, top, head, snout)
    back, long = hip + vec(0, 0.9 * r, 0.3 * r), m.number(0.15, 0.7)
    end = back + vec(m.number(-0.2, 0.2), 0.6 * long, m.number(-0.7, 0.7) * long)
    c.limb(curve(back, back + vec(0, 0.6 * long, 0), end), np.linspace(0.05, 0.025, 6))
    c.lump(end, (0.05, 0.06, 0.08), share=0.4)
    for _ in range(m.pick(10, 20, 34) if name == "sheep" or m.chance(0.2) else 0):  # wool or spots
        t, q = m.number(-0.7, np.pi + 0.7), hip + m.number(0, 1) * (shoulder - hip)
        c.lump(q + 0.85 * r * vec(np.cos(t), 0, np.sin(t)), (min(m.number(0.2, 0.4) * r, 0.11),) * 3)
    if name in ("horse", "giraffe"):
        for t in np.linspace(0, 1, m.pick(5, 9)):
            c.lump(root + t * (top - root) + vec(0, 0.35 * r + 0.1 * head, 0.3 * head), (0.03, 0.1 * neck + 0.03, 0.08))
    elif m.chance(0.4):
        c.put(ring((root + 2 * top) / 3, top - root, 0.25 * r + 0.6 * head, 0.02, 16))
    c.done(size * m.pick(1.0, 1.0, 0.15), 0.3, fuse)


def _wings(c: Clay, at: Point, r: float, pitch: float, spread: bool) -> None:
    """A pair of wings, folded or spread, of one lump or of feathers."""
    m, feathers = c.m, c.m.pick(1, 4, 7)
    if not spread:
        for k in range(min(feathers, 4)):
            size = vec(0.25 * r, 0.42 - 0.06 * k, (1.0 - 0.2 * k) * 0.7 * r)
            c.lump(at + vec((0.88 + 0.06 * k) * r, 0.12 + 0.03 * k, -0.05 * k), size, True, (-1, 0, 0), pitch)
        return
    reach, rise = m.number(0.6, 1.2), m.number(-0.1, 0.7)
    arm = [at + vec(0.5 * r, 0, 0), at + reach * vec(0.5, -0.1, rise), at + reach * vec(1, 0, 0.8 * rise)]
    c.limb(arm, [(0.12, 0.04), (0.1, 0.03), (0.06, 0.02)], True)
    for t in np.linspace(0.1, 1, feathers + 3):
        q = arm[0] + t * (arm[2] - arm[0]) + vec(0, 0, 0.3 * reach * rise * np.sin(np.pi * t))
        tip = q + vec(0.5 * t, 0.45 - 0.2 * t, -0.05) * m.number(0.9, 1.1)
        c.limb([q, (q + tip) / 2, tip], [(0.07, 0.012), (0.07, 0.012), (0.03, 0.008)], True)


def bird_figure(m: Model) -> None:
    """A duck, owl, penguin, flamingo, hen or eagle, perhaps on a branch; nothing moves."""
    name, c = m.pick(*BIRDS), clay(m)
    pitch, r, neck, leg, beak, wide, size = (v * m.number(0.9, 1.1) for v in BIRDS[name])
    way = vec(0, -np.cos(np.deg2rad(pitch)), np.sin(np.deg2rad(pitch)))
    c.limb([k * way for k in (-0.5, -0.25, 0.0, 0.25, 0.42)], np.array([0.25, 0.75, 1.0, 0.9, 0.5]) * r)
    h, top = m.number(0.5, 0.7) * r + 0.03, 0.45 * way + vec(0, -0.05, 0.05)
    at = top + vec(0, -0.25 * neck, neck + 0.3 * r)
    c.limb(curve(top - 0.1 * way, top + vec(0, -0.4 * neck, 0.5 * neck), at), np.linspace(0.55 * r, 0.6 * h, 6))
    c.lump(at, vec(0.9, 1.05, 0.95) * h)
    c.eyes(at + vec(0.55, -0.65, 0.25) * h, m.number(0.1, 0.3 if name == "owl" else 0.18) * h)
    for k in m.pick((0.0,), (-0.3, 0.3)):
        start = at + vec(0, -0.7 * h, k * wide)
        c.limb([start, start + vec(0, -beak - 0.3 * h, -0.3 * beak + k * wide)], [(wide, 0.6 * wide), (0.4 * wide, 0.3 * wide)])
    _wings(c, 0.15 * way, r, pitch, m.chance(0.3))
    for k in np.linspace(-1, 1, m.pick(1, 3, 5)):
        tip = -0.5 * way - m.number(0.2, 0.45) * (way + vec(0.5 * k, 0, 0))
        c.limb([-0.4 * way, (tip - 0.5 * way) / 2, tip], [(0.1, 0.03), (0.09, 0.02), (0.07, 0.01)])
    for k in range(m.pick(0, 3, 4) if name == "hen" else 0):  # a comb
        c.lump(at + vec(0, (0.6 - 0.5 * k) * h, 0.95 * h), vec(0.12, 0.3, 0.4) * h)
    low = -max(r, 0.45 * way[2] + 0.05) - leg
    foot = vec(0.4 * r, -0.02, low)
    c.limb([vec(0.4 * r, 0.02, -0.5 * r), foot], [m.number(0.02, 0.04)] * 2, True)
    for k in (-0.5, 0.0, 0.5):
        c.limb([foot, foot + vec(0.2 * k, -0.18, 0)], [0.025, m.pick(0.012, 0.04)], True)
    if m.chance(0.3):
        c.put(rod((-0.8, -0.05, low - 0.06), (0.8, -0.05, low - m.number(0.02, 0.1)), 0.06, 8))
    c.done(size, 0.4, 2)


def fish_figure(m: Model) -> None:
    """A fish, shark, dolphin or puffer with fins, perhaps striped, perhaps on a stand; nothing moves."""
    c, name, t = clay(m), m.pick("fish", "angel", "shark", "dolphin", "puffer"), np.linspace(0, 1, 9)
    tall, wide = {"fish": (0.22, 0.1), "angel": (0.4, 0.07), "puffer": (0.33, 0.3)}.get(name, (0.15, 0.13))
    r = np.c_[[wide, tall]].T * np.interp(t, [0, 0.12, 0.4, 0.8, 1], [0.2, 0.65, 1, 0.35, 0.15])[:, None] * m.number(0.8, 1.2)
    c.limb([vec(0, v - 0.5, 0) for v in t], r)
    high, fork, thin = tall + m.number(0.08, 0.25), m.number(0.15, 0.4), m.pick(0.008, 0.02)
    c.eyes(vec(0.55 * wide, -0.4, 0.25 * tall), m.number(0.015, 0.04))
    tail = prism([(0.42, 0.03), (0.75, fork), (0.62, 0), (0.75, -fork), (0.42, -0.03)], "x", (-thin, thin))
    c.put(turned(tail, (0, 1, 0), 90 * (name == "dolphin"), (0, 0, 0)))
    c.put(prism([(-0.2, 0.6 * tall), (-0.02, high), (0.15, high - 0.03), (0.25, 0.3 * tall)], "x", (-thin, thin)))
    for k in m.pick((), (0.2,), (0.2, 0.32)):
        c.put(prism([(k - 0.15, -0.4 * tall), (k + 0.1, -high), (k + 0.06, -0.2 * tall)], "x", (-thin, thin)))
    fin = prism([(-0.22, 0.05), (0.05, -m.number(0.1, 0.25)), (-0.1, -0.1), (-0.2, -0.05)], "x", (-thin, thin))
    c.put(turned(fin, (0, 1, 0), -m.number(10, 60), (0, 0, 0)).apply_translation((0.85 * wide, 0, -0.2 * tall)), True)
    for k in (2, 4, 6)[: m.pick(0, 0, 2, 3)]:
        c.limb([vec(0, t[k] - 0.5 + s, 0) for s in (-0.03, 0.03)], [1.03 * r[k], 1.03 * r[k]])
    for _ in range(m.pick(20, 40) if name == "puffer" else 0):
        way = m.rng.normal(size=3) * (1, 0.6, 1)
        c.limb([way * (0.4 * wide, 0.15, 0.4 * tall) - vec(0, 0.1, 0), way * 0.3 - vec(0, 0.1, 0)], [0.02, 0.004])
    if m.chance(0.5):
        c.put(lathe([(0, -0.75), (0.25, -0.75), (0.25, -0.7), (0.02, -0.65), (0.02, -0.3 * tall), (0, -0.3 * tall)], c.n))
    c.done(m.number(0.1, 0.4) if name != "shark" else 2, 0)


def human_figure(m: Model) -> None:
    """A person who stands, walks or sits, from lifelike to big-headed, dressed in pieces; nothing moves."""
    c, h, w, sit, whole = clay(m), m.pick(0.065, 0.075, 0.1, 0.16), m.number(0.09, 0.13), m.chance(0.25), m.chance(0.4)
    neck, thin, stride = 1 - 2 * h, m.number(0.25, 0.36) * w, m.pick(0.0, 0.0, m.number(0.05, 0.15))
    hip, chest, head = 0.53 * neck, 0.91 * neck, vec(0, 0, neck + h)
    c.limb([(0, 0, hip), (0, 0, 0.68 * neck), (0, 0, chest)], [(0.85 * w, 0.6 * w), (0.7 * w, 0.5 * w), (w, 0.6 * w)])
    c.limb([(0, 0, chest), (0, 0, neck + 0.5 * h)], [0.35 * w, 0.35 * w])
    for s in (-1, 1):
        knee, foot = vec(s * 0.5 * w, -s * 0.5 * stride, 0.5 * hip), vec(s * 0.55 * w, -s * stride, thin)
        if sit:
            knee, foot = vec(s * 0.6 * w, -0.48 * hip, hip), vec(s * 0.6 * w, -0.48 * hip - stride, 0.52 * hip)
        c.jointed([vec(s * 0.5 * w, 0, hip), knee, foot], (1.3 * thin, thin, 0.7 * thin), whole)
        c.lump(foot - vec(0, thin, 0.3 * thin), vec(1, 2, 0.8) * thin)
        elbow = vec(s * m.number(1.3, 2.2) * w, m.number(-0.05, 0.05), 0.68 * neck + m.pick(0, 0, 0.15))
        hand = elbow + 0.2 * neck * vec(*m.pick((-s, -0.5, 0.1), (0.2 * s, -0.3, -0.9), (0, -1, 0.2), (0.3 * s, 0, 1)))
        c.jointed([vec(s * w, 0, chest - 0.02), elbow, hand], (0.9 * thin, 0.75 * thin, 0.6 * thin), whole)
        c.lump(hand, (0.8 * thin,) * 3)
    c.put(rod((hand[0], hand[1], 0), (hand[0], hand[1], hand[2] + m.number(0.05, 0.4)), 0.015, 8), share=0.25)
    c.lump(head, vec(0.8, 0.9, 1) * h)
    c.eyes(head + vec(0.3, -0.78, 0.1) * h, m.number(0.08, 0.16) * h)
    c.lump(head - vec(0, 0.9, 0.15) * h, vec(0.12, 0.2, 0.2) * h)
    c.lump(head + vec(0.8, 0, 0) * h, vec(0.12, 0.2, 0.25) * h, True)
    c.lump(head + vec(0, 0.2, 0.25) * h, vec(0.85, 0.95, 0.95) * h, share=0.7)
    hat = [(0, 0.5), (1, 0.5), (1, 0.6), (0.6, 0.65), (m.number(0.1, 0.6), m.number(1, 1.8)), (0, 1.4)]
    c.put(lathe(np.array(hat) * (m.number(1, 1.8) * h, h), c.n, head), share=0.35)
    c.put(rod((0, 0, hip - 0.015), (0, 0, hip + 0.015), 1.0, c.n).apply_scale((0.95 * w, 0.7 * w, 1)), share=0.5)
    for z in np.linspace(hip + 0.05, neck - 0.08, m.pick(0, 0, 3, 5)):
        c.lump((0, -0.6 * w, z), (0.01,) * 3)
    if sit:
        c.put(box((-2 * w, 2 * w), (-w, 1.5 * w), (0.45 * hip, hip - thin)))
    else:
        low, top = m.number(0.02, 0.7) * hip, hip + 0.04
        c.put(lathe([(0, low), (m.number(1.1, 1.8) * w, low), (0.8 * w, top), (0, top)], c.n), share=0.35)
    c.done(m.pick(1.75, m.number(0.1, 0.3)), 0.4, 2)


def stuffed_toy(m: Model) -> None:
    """A teddy, rabbit, elephant or octopus that sits or stands, with pads, buttons and a bow; nothing moves."""
    c, name = Clay(m, "round", m.pick(10, 14, 18)), m.pick("bear", "rabbit", "elephant", "octopus")
    h, r, k = m.number(0.24, 0.34), m.number(0.22, 0.3), m.number(0.09, 0.13)
    head = vec(0, -0.02, 1.7 * r + 0.75 * h)
    c.lump((0, 0, r), (r, 0.9 * r, 1.1 * r))
    c.lump(head, vec(1.1, 0.95, 0.95) * h)
    c.eyes(head + vec(0.4, -0.8, 0.2) * h, m.number(0.08, 0.15) * h)
    for t in np.arange(8) * np.pi / 4 + 0.4 if name == "octopus" else ():
        way, thick = r * vec(np.cos(t), np.sin(t), 0), np.linspace(1, 0.5, 6) * k
        c.limb(curve(0.6 * way + vec(0, 0, 0.5 * r), 1.5 * way, 2 * way + vec(0, 0, 0.1)), thick)
    if name != "octopus":
        _toy_parts(c, name, head, h, r, k)
    c.lump((0, -0.35 * r, 0.95 * r), (0.7 * r, 0.6 * r, 0.75 * r), share=0.5)
    if m.chance(0.5):
        c.lump((0.3 * r, -0.9 * r, 1.75 * r), (0.3 * r, 0.1, 0.2 * r), True, (0, 1, 0), 15)
        c.lump((0, -0.95 * r, 1.75 * r), (0.07,) * 3)
    c.done(m.number(0.15, 0.6), 0)


def _toy_parts(c: Clay, name: str, head: Point, h: float, r: float, k: float) -> None:
    """Arms, legs, muzzle or trunk, ears and tail."""
    m, sit, lean = c.m, c.m.chance(0.6), c.m.number(0, 25)
    c.jointed([vec(0.8 * r, 0, 1.7 * r), vec(1.5 * r, -0.1, r), vec(1.4 * r, -0.3, 0.8 * r)], (k, k, 0.9 * k), True, True)
    foot = vec(0.8 * r, -0.45, k) if sit else vec(0.5 * r, -0.02, -0.35)
    c.limb([vec(0.5 * r, 0, 0.5 * r), foot], [1.2 * k, 1.2 * k], True)
    c.lump(foot - vec(0, 0.5 * k, 0), (1.25 * k, 0.9 * k, 1.5 * k) if sit else (1.25 * k, 1.6 * k, k), True)
    c.lump(foot - vec(0, 1.3 * k, 0), (0.8 * k, 0.2 * k, k), True, share=0.5 * sit)
    snout = head + vec(0, -0.85, -0.25) * h
    if name == "elephant":
        c.limb(curve(snout, snout - vec(0, 0.3, 0.05), snout - vec(0, 0.3, 0.35)), np.linspace(0.4, 0.22, 6) * h)
    else:
        c.lump(snout, vec(0.45, 0.4, 0.35) * h)
        c.lump(snout + vec(0, -0.4, 0.15) * h, vec(0.15, 0.1, 0.12) * h)
    tall = m.number(0.8, 1.3)
    x, z, wide, tall = {"bear": (0.75, 0.7, 0.35, 0.38), "rabbit": (0.4, 0.6 + 0.7 * tall, 0.32, tall)}.get(
        name, (1.3, 0, 0.5, 0.8)
    )
    c.lump(head + vec(x, 0, z) * h, vec(wide, 0.12, tall) * h, True, (0, 1, 0), lean)
    c.lump(head + vec(x, -0.1, z) * h, vec(0.6 * wide, 0.08, 0.7 * tall) * h, True, (0, 1, 0), lean, share=0.6)
    c.lump((0, 0.9 * r, 0.5 * r), (0.3 * r,) * 3)


def insect_figure(m: Model) -> None:
    """An ant, beetle, bee, butterfly, spider or caterpillar, perhaps on a base; nothing moves."""
    c, name = clay(m), m.pick("ant", "beetle", "bee", "butterfly", "spider", "caterpillar")
    fat = {"beetle": 0.3, "spider": 0.28, "bee": 0.2, "ant": 0.15}.get(name, 0.07)
    segments = m.pick(6, 9, 12) if name == "caterpillar" else 0
    for k in range(segments):
        c.lump((0, 0.16 * k, 0.05 * np.sin(k)), (0.11, 0.11, 0.11 * m.number(0.9, 1.1)))
        c.limb([(0.05, 0.16 * k, -0.05), (0.09, 0.16 * k, -0.14)], [0.025, 0.02], True)
    head, h = vec(0, -0.2, 0.02), m.number(0.08, 0.14)
    c.lump(head, (h, h, 0.9 * h))
    c.eyes(head + vec(0.6, -0.6, 0.3) * h, m.number(0.15, 0.45) * h)
    end = head + vec(m.number(0.05, 0.3), -m.number(0.1, 0.3), m.number(0.05, 0.25))
    c.limb(curve(head + vec(0.3 * h, -0.5 * h, 0.5 * h), head + vec(0.1, -0.1, 0.25), end), [0.012] * 6, True)
    c.lump(end, (0.025,) * 3, True, share=0.5)
    if not segments:
        c.lump((0, 0, 0.02), (0.6 * fat + 0.05, 0.15, 0.6 * fat + 0.04))
        c.lump((0, 0.38, 0.02), (fat, 0.32, 0.85 * fat), False, (1, 0, 0), m.number(0, 15))
    low, wide, whole = -m.number(0.15, 0.35), m.number(0.3, 0.6), m.chance(0.5)
    for k in () if segments else np.linspace(-1, 1, 4 if name == "spider" else 3):
        knee = vec(0.5 * wide + 0.1, 0.2 * k, m.number(0.05, 0.3))
        c.jointed([vec(0.05, 0.1 * k, 0), knee, vec(wide + 0.1, 0.4 * k, low)], (0.03, 0.022, 0.012), whole, True)
    for t in np.linspace(0.2, 0.55, m.pick(2, 3, 4) if name in ("bee", "beetle") else 0):
        if name == "bee":
            r = 1.03 * fat * np.sqrt(1 - ((t - 0.38) / 0.32) ** 2)
            c.limb([(0, t - 0.02, 0.02), (0, t + 0.02, 0.02)], [(r, 0.86 * r)] * 2)
        else:
            c.lump((0.5 * fat, t, 0.02 + 0.7 * fat), (0.2 * fat, 0.05, 0.06), True)
    for k in (0, 1) if name in ("bee", "butterfly") else ():
        reach, by = (0.75, 0.45) if name == "butterfly" else (0.5, 0.15)
        root, way = vec(0.05, 0.1 * k, 0.12), vec(1, 0.8 * k - 0.5 * (name == "butterfly"), m.number(0.1, 0.6))
        c.limb([root, root + 0.6 * reach * way, root + reach * way], [(0.04, 0.01), (0.5 * by, 0.01), (0.45 * by, 0.008)], True)
    c.done(m.number(0.05, 0.3), 0.4)
