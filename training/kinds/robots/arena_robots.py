"""Humanoid robots and toy robots of one artist; they look to -Y."""

from __future__ import annotations

import numpy as np

from training.kinds.arena_style import Look, lathe, look
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod, rounded, vec

FORWARD = vec(0, -1, 0)


def humanoid_robot(m: Model) -> None:
    """A torso on a pelvis with a head, arms with hands or tools and legs with feet, standing or with its arms out."""
    k, s = look(m), m.number(0.8, 1.1)
    hip, waist = m.number(0.75, 0.95) * s, m.chance(0.6)
    broad, tall, deep = m.number(0.15, 0.27) * s, m.number(0.38, 0.55) * s, m.number(0.09, 0.16) * s
    torso = "torso" if waist else BASE
    low = hip + 0.14 * s
    m.add(BASE, *k.body((-0.12 * s, 0.12 * s), (-0.7 * deep, 0.7 * deep), (hip - 0.07 * s, hip + 0.08 * s)))
    m.add(BASE, rod((0, 0, hip + 0.06 * s), (0, 0, low), 0.06 * s, k.n))
    if m.chance(0.6):
        m.add(torso, *k.body((-broad, broad), (-deep, deep), (low, low + tall)))
    else:
        m.add(torso, *k.body((-0.7 * broad, 0.7 * broad), (-0.8 * deep, 0.8 * deep), (low, low + 0.45 * tall)))
        m.add(torso, *k.body((-broad, broad), (-deep, deep), (low + 0.4 * tall, low + tall)))
    if m.chance(0.5):
        chest = ((-0.5 * broad, 0.5 * broad), (-deep - 0.02 * s, -0.9 * deep), (low + 0.55 * tall, low + 0.9 * tall))
        m.add(torso, *k.plate(*chest, "-y"))
    if m.chance(0.4):
        m.add(torso, *k.body((-0.7 * broad, 0.7 * broad), (0.9 * deep, 1.6 * deep), (low + 0.3 * tall, low + 0.95 * tall)))
    if waist:
        m.spin("torso", (0, 0, low), (0, 0, 1)) if m.chance(0.2) else m.hinge("torso", (0, 0, low), (0, 0, 1), (-90, 90))
    _head(m, k, torso, low + tall, s)
    pose, grip = m.pick(0, 8, 8, 45, 85), m.pick("fist", "claw", "fingers")
    for side, name in ((-1, "right"), (1, "left")):
        _arm(m, k, torso, side, name, vec(side * (broad + 0.05 * s), 0, low + 0.88 * tall), s, pose, grip)
        _leg(m, k, name, vec(side * 0.09 * s, 0, hip - 0.04 * s), s)


def _head(m: Model, k: Look, torso: str, z: float, s: float) -> None:
    """A head on a neck with eyes or a visor."""
    r, neck = m.number(0.07, 0.12) * s, m.number(0.03, 0.07) * s
    m.add(torso, rod((0, 0, z - 0.02 * s), (0, 0, z + neck), 0.045 * s, k.n))
    top = z + neck + 2.2 * r
    shape = m.pick("body", "body", "dome", "lathe")
    if shape == "body":
        m.add("head", *k.body((-0.85 * r, 0.85 * r), (-r, r), (z + neck, top)))
    elif shape == "dome":
        m.add("head", ball((0, 0, z + neck + 1.05 * r), (0.9 * r, r, 1.1 * r), max(10, k.n)))
    else:
        turned = lathe([(0, 0), (0.8 * r, 0), (r, 0.5 * r), (0.95 * r, 1.5 * r), (0.4 * r, 2.1 * r), (0, 2.2 * r)], k.n)
        turned.apply_translation((0, 0, z + neck))
        m.add("head", turned)
    if m.chance(0.5):
        m.add("head", box((-0.6 * r, 0.6 * r), (-1.05 * r, -0.5 * r), (z + neck + 1.1 * r, z + neck + 1.5 * r)))
    else:
        m.add("head", *(ball((q * 0.35 * r, -0.85 * r, z + neck + 1.3 * r), (0.2 * r, 0.25 * r, 0.2 * r), 8) for q in (-1, 1)))
    if m.chance(0.4):
        m.add("head", *(rod((0.8 * q * r, 0, z + neck + r), (1.05 * q * r, 0, z + neck + r), 0.3 * r, k.n) for q in (-1, 1)))
    m.hinge("head", (0, 0, z + neck), (0, 0, 1), (-80, 80), torso)


def _arm(m: Model, k: Look, torso: str, side: int, name: str, at: np.ndarray, s: float, pose: float, grip: str) -> None:
    """Shoulder, upper arm, forearm and hand."""
    a = np.deg2rad(pose)
    way = vec(side * np.sin(a), 0, -np.cos(a))
    fold = np.cross(way, FORWARD)
    upper, fore, t = 0.27 * s, 0.25 * s, 0.085 * s
    elbow, wrist = at + upper * way, at + (upper + fore) * way
    m.add(torso, *k.knuckle(at - vec(side * 0.03 * s, 0, 0), (1, 0, 0), 0.045 * s, 0.045 * s))
    m.add(f"upper_arm_{name}", *k.limb(at - 0.03 * s * way, elbow - 0.03 * s * way, t, t, FORWARD))
    m.hinge(
        f"upper_arm_{name}", at, (-1, 0, 0) if pose < 40 else vec(0, side, 0), (-50, 120) if pose < 40 else (-40, 60), torso
    )
    m.add(f"upper_arm_{name}", *k.knuckle(elbow, fold, 0.04 * s, 0.045 * s))
    m.add(f"forearm_{name}", *k.limb(elbow + 0.03 * s * way, wrist, 0.95 * t, t, FORWARD, 0.75))
    m.hinge(f"forearm_{name}", elbow, fold, (0, 120), f"upper_arm_{name}")
    _hand(m, k, name, wrist, way, s, grip)


def _hand(m: Model, k: Look, name: str, wrist: np.ndarray, way: np.ndarray, s: float, grip: str) -> None:
    """A fist, a claw of two or three, or a palm with fingers."""
    hand, across = f"hand_{name}", np.cross(way, FORWARD)
    side = 1 if name == "left" else -1
    m.add(hand, rod(wrist - 0.01 * s * way, wrist + 0.02 * s * way, 0.03 * s, k.n))
    m.add(hand, *k.limb(wrist + 0.01 * s * way, wrist + 0.09 * s * way, 0.07 * s, 0.04 * s, FORWARD))
    m.hinge(hand, wrist, way, (-90, 90), f"forearm_{name}")
    knuckles = wrist + 0.085 * s * way
    if grip == "fist":
        return
    spots = (-1, 1) if grip == "claw" else (-1.0, -0.33, 0.33, 1.0)
    for i, q in enumerate(spots):
        finger = f"finger_{name}_{i}"
        at = knuckles + 0.026 * s * q * FORWARD
        m.add(finger, *k.limb(at, at + 0.075 * s * way, 0.014 * s, 0.016 * s, FORWARD))
        if grip == "claw":
            m.hinge(finger, at, q * across, (0, 40), hand)
        else:
            m.hinge(finger, at, side * FORWARD, (0, 80), hand)


def _leg(m: Model, k: Look, name: str, at: np.ndarray, s: float) -> None:
    """Thigh, shin and foot below a hip."""
    ankle = vec(at[0], 0, 0.09 * s)
    knee = at + 0.5 * (ankle - at)
    t = 0.12 * s
    m.add(BASE, *k.knuckle(at, (1, 0, 0), 0.05 * s, 0.06 * s))
    m.add(f"thigh_{name}", *k.limb(at - vec(0, 0, 0.02 * s), knee + vec(0, 0, 0.02 * s), t, 1.1 * t, (1, 0, 0), 0.85))
    m.hinge(f"thigh_{name}", at, (-1, 0, 0), (-30, 80))
    m.add(f"thigh_{name}", *k.knuckle(knee, (1, 0, 0), 0.045 * s, 0.055 * s))
    m.add(f"shin_{name}", *k.limb(knee - vec(0, 0, 0.02 * s), ankle, 0.9 * t, t, (1, 0, 0), 0.8))
    m.hinge(f"shin_{name}", knee, (1, 0, 0), (0, 110), f"thigh_{name}")
    m.add(f"foot_{name}", *k.body((at[0] - 0.055 * s, at[0] + 0.055 * s), (-0.17 * s, 0.08 * s), (0, 0.07 * s)))
    m.add(f"foot_{name}", *k.knuckle(ankle, (1, 0, 0), 0.035 * s, 0.05 * s))
    m.hinge(f"foot_{name}", ankle, (1, 0, 0), (-25, 30), f"shin_{name}")


def toy_robot(m: Model) -> None:
    """A tin toy with a box or a drum for a body, a winding key, stiff arms, legs, rollers or tracks, a chest door, knobs."""
    k = look(m)
    w, d, h = m.number(0.03, 0.05), m.number(0.02, 0.035), m.number(0.06, 0.09)
    stand, drum = m.pick("legs", "legs", "rollers", "skirt"), m.chance(0.3)
    z = 0.0 if stand == "skirt" else m.number(0.03, 0.07)
    if drum:
        turned = lathe([(0, 0), (w, 0), (w, 0.8 * h), (0.8 * w, h), (0, h)], k.n)
        turned.apply_translation((0, 0, z))
        m.add(BASE, turned)
        d = w
    else:
        m.add(BASE, *k.body((-w, w), (-d, d), (z, z + h)))
    if stand == "skirt":
        m.add(BASE, *k.body((-1.2 * w, 1.2 * w), (-1.2 * d, 1.2 * d), (0, 0.15 * h)))
    _toy_head(m, k, w, z + h)
    grip = m.pick("claw", "ball", "mitt")
    for side, name in ((-1, "right"), (1, "left")):
        _toy_arm(m, k, side, name, w, z + 0.82 * h, h, grip)
        if stand == "legs":
            x = (side * 0.12 * w, side * 0.9 * w)
            m.add(f"leg_{name}", *k.body(x, (-0.6 * d, 0.6 * d), (0.006, z - 0.12 * d)))
            m.add(f"leg_{name}", *k.body((side * 0.08 * w, side * w), (-1.2 * d, 0.8 * d), (0, 0.3 * z)))
            m.add(BASE, rod((x[0], 0, z), (x[1], 0, z), 0.25 * d, k.n))
            m.hinge(f"leg_{name}", (side * 0.5 * w, 0, z), (-1, 0, 0), m.pick((-15, 15), (-18, 18)))
        elif stand == "rollers":
            m.add(BASE, box((side * 0.5 * w, side * 0.7 * w), (-0.9 * d, 0.9 * d), (0.6 * min(0.52 * d, 0.8 * z), z + 0.001)))
            for i, y in enumerate((-0.55 * d, 0.55 * d)):
                r = min(0.52 * d, 0.8 * z)
                m.add(f"wheel_{name}_{i}", *k.wheel((side * 0.86 * w, y, r), (1, 0, 0), r, 0.15 * w))
                m.spin(f"wheel_{name}_{i}", (side * 0.86 * w, y, r), (1, 0, 0))
                m.add(BASE, rod((side * 0.5 * w, y, r), (side * 0.95 * w, y, r), 0.15 * r, 8))
    if not drum:
        _toy_front(m, k, w, d, z, h)
    if m.chance(0.6):
        y, at = d + 0.012, z + 0.45 * h
        m.add("key", rod((0, 0.85 * d, at), (0, y, at), 0.002, 8))
        m.add(
            "key",
            *(ring((q * 0.007, y + 0.004, at), FORWARD if m.chance(0.5) else (0, 1, 0), 0.006, 0.002, 12) for q in (-1, 1)),
        )
        m.spin("key", (0, d, at), (0, 1, 0))


def _toy_head(m: Model, k: Look, w: float, z: float) -> None:
    """A box, dome or lathed head with eyes, mouth, ears and aerials."""
    r = m.number(0.45, 0.8) * w
    m.add(BASE, rod((0, 0, z - 0.002), (0, 0, z + 0.004), 0.5 * r, k.n))
    low = z + 0.003
    top = low + m.number(1.1, 1.7) * r
    if m.chance(0.7):
        m.add("head", *k.body((-r, r), (-0.8 * r, 0.8 * r), (low, top)))
    else:
        turned = lathe([(0, 0), (r, 0), (r, 0.5 * r), (0.7 * r, top - low - 0.2 * r), (0, top - low)], k.n)
        turned.apply_translation((0, 0, low))
        m.add("head", turned)
    z_eye = low + 0.55 * (top - low)
    m.add("head", *(rod((q * 0.4 * r, -0.7 * r, z_eye), (q * 0.4 * r, -0.95 * r, z_eye), 0.2 * r, k.n) for q in (-1, 1)))
    if m.chance(0.5):
        m.add("head", box((-0.5 * r, 0.5 * r), (-0.85 * r, -0.6 * r), (low + 0.15 * r, low + 0.35 * r)))
    if m.chance(0.6):
        m.add(
            "head",
            rod((0, 0, top - 0.1 * r), (0, 0, top + 0.7 * r), 0.06 * r, 6),
            ball((0, 0, top + 0.75 * r), (0.14 * r,) * 3, 8),
        )
    if m.chance(0.5):
        m.add("head", *(rod((0.9 * q * r, 0, z_eye), (1.15 * q * r, 0, z_eye), 0.25 * r, k.n) for q in (-1, 1)))
    if m.chance(0.5):
        m.spin("head", (0, 0, low), (0, 0, 1))
    else:
        m.hinge("head", (0, 0, low), (0, 0, 1), (-60, 60))


def _toy_arm(m: Model, k: Look, side: int, name: str, w: float, z: float, h: float, grip: str) -> None:
    """A stiff arm on a pin, hanging, with a claw, a ball or a mitt."""
    x, t, long = side * (w + 0.010), 0.012, 0.55 * h
    part = f"arm_{name}"
    m.add(BASE, rod((side * 0.8 * w, 0, z), (side * (w + 0.0045), 0, z), 0.005, k.n))
    m.add(part, *k.limb((x, 0, z + 0.006), (x, 0, z - long), t, t), rod((side * (w + 0.0035), 0, z), (x, 0, z), 0.007, k.n))
    if grip == "ball":
        m.add(part, ball((x, 0, z - long - 0.004), (0.008,) * 3, max(8, k.n)))
    elif grip == "mitt":
        m.add(part, *k.body((x - 0.006, x + 0.006), (-0.009, 0.009), (z - long - 0.014, z - long + 0.001)))
    else:
        m.add(
            part, *(k.limb((x, q * 0.004, z - long + 0.002), (x, q * 0.01, z - long - 0.014), 0.006, 0.003)[0] for q in (-1, 1))
        )
    m.hinge(part, (x, 0, z), (-1, 0, 0), (-60, 150))


def _toy_front(m: Model, k: Look, w: float, d: float, z: float, h: float) -> None:
    """On the chest: a door, knobs that turn, or gauges that stay."""
    if m.chance(0.35):
        m.add("door", *k.plate((-0.6 * w, 0.6 * w), (-d - 0.003, -d - 0.0002), (z + 0.2 * h, z + 0.7 * h), "-y"))
        m.hinge("door", (-0.6 * w, -d - 0.0002, z + 0.45 * h), (0, 0, -1), m.pick(90, 120))
        return
    m.add(BASE, prism(rounded((-0.7 * w, 0.7 * w), (z + 0.3 * h, z + 0.8 * h), 0.004), "y", (-d - 0.002, -d)))
    turns = m.chance(0.5)
    for i, q in enumerate(m.pick((-0.4, 0.4), (-0.5, 0.0, 0.5), (0.0,))):
        part = f"knob_{i}" if turns else BASE
        m.add(part, rod((q * w, -d - 0.0015, z + 0.55 * h), (q * w, -d - 0.007, z + 0.55 * h), 0.16 * w, k.n))
        if turns:
            m.add(part, box((q * w - 0.001, q * w + 0.001), (-d - 0.009, -d - 0.006), (z + 0.55 * h, z + 0.55 * h + 0.15 * w)))
            m.spin(part, (q * w, -d, z + 0.55 * h), (0, -1, 0))
