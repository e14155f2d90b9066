"""Walking machines of one artist: mechs on two or four legs and spider robots; they look to -Y."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.arena_style import Look, look
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, rod, vec

UP = vec(0, 0, 1)


def mech_walker(m: Model) -> None:
    """A cockpit that turns on hips over bent or straight legs, two or four, with guns, a hatch, a mast or a turret."""
    k, style = look(m), m.pick("bird", "bird", "human", "four")
    hip, w, d, h = m.number(1.8, 2.8), m.number(0.5, 0.9), m.number(0.6, 1.1), m.number(0.6, 1.1)
    turns = m.chance(0.75)
    hull, low = ("torso" if turns else BASE), hip + 0.3
    m.add(BASE, *k.body((-0.6 * w, 0.6 * w), (-0.5, 0.5) if style != "four" else (-d, d), (hip - 0.2, hip + 0.2)))
    m.add(BASE, rod((0, 0, hip), (0, 0, low + 0.05), 0.32, max(8, k.n)))
    m.add(hull, *_cockpit(m, k, w, d, low, h))
    if turns:
        m.hinge("torso", (0, 0, low), (0, 0, 1), m.pick((-90, 90), (-120, 120), (-180, 180)))
    for x in (-1, 1):
        side = "left" if x > 0 else "right"
        if style == "four":
            for y, end in ((-1, "front"), (1, "rear")):
                _leg(m, k, f"{end}_{side}", vec(x * (0.6 * w + 0.12), 0.75 * y * d, hip), style, y)
        else:
            _leg(m, k, side, vec(x * (0.6 * w + 0.12), 0, hip), style, 1)
    _arms(m, k, hull, w, low, h)
    _top(m, k, hull, w, d, low, h)


def _cockpit(m: Model, k: Look, w: float, d: float, low: float, h: float) -> list[Trimesh]:
    """A box, a wedge, a bulb or a box with a nose and engines behind."""
    shape = m.pick("box", "wedge", "nose", "stack")
    if shape == "wedge" and k.style != "round":
        outline = [(-d, low + 0.1 * h), (-1.3 * d, low + 0.35 * h), (-0.8 * d, low + h), (d, low + 0.9 * h), (d, low)]
        found = [prism(outline, "x", (-w, w))]
    else:
        found = k.body((-w, w), (-d, d), (low, low + h))
    if shape == "nose":
        found += k.body((-0.6 * w, 0.6 * w), (-1.5 * d, -0.9 * d), (low + 0.15 * h, low + 0.7 * h), "+y")
    if shape == "stack":
        found += k.body((-0.7 * w, 0.7 * w), (-0.6 * d, 0.8 * d), (low + h - 0.02, low + 1.35 * h), "-z")
    if m.chance(0.6):
        found += [
            p for s in (-1, 1) for p in k.body((s * 0.3 * w, s * 0.8 * w), (0.95 * d, 1.3 * d), (low + 0.2 * h, low + 0.8 * h))
        ]
    if m.chance(0.5):
        found.append(box((-0.5 * w, 0.5 * w), (-d - 0.03, -0.8 * d), (low + 0.55 * h, low + 0.75 * h)))
    return found


def _leg(m: Model, k: Look, name: str, at: np.ndarray, style: str, way: int) -> None:
    """Thigh, shin, perhaps a metatarsal, and a foot with toes."""
    x, _, hip = at
    bend = m.number(0.2, 0.45) if not m.joints else 0.3
    heel = vec(x, at[1], 0.22)
    points = {
        "bird": [at, at + vec(0, -0.28 * hip, -0.3 * hip), at + vec(0, 0.18 * hip, -0.62 * hip), heel],
        "human": [at, at + vec(0, -0.1 * hip, -0.48 * hip), heel],
        "four": [
            at,
            at + vec(0.18 * hip * np.sign(x), way * bend * hip, 0.1),
            heel + vec(0.3 * np.sign(x), way * 0.35 * hip, 0),
        ],
    }[style]
    parent = BASE
    for i, part in enumerate(("thigh", "shin", "shank")[: len(points) - 1]):
        a, b, t = points[i], points[i + 1], 0.3 - 0.05 * i
        out = vec(1, 0, 0) if style != "four" else np.cross(UP, b - a) / np.linalg.norm(np.cross(UP, b - a) + 1e-9)
        m.add(parent, *k.knuckle(a, out, 0.16 - 0.02 * i, 0.18))
        m.add(f"{part}_{name}", *k.limb(a, b, t, t * 1.15, out, 0.8))
        limits = ((-35, 35), (-30, 45), (-30, 30))[i]
        m.hinge(f"{part}_{name}", a, out, limits, parent)
        parent = f"{part}_{name}"
    foot, end = f"foot_{name}", points[-1]
    m.add(foot, *k.knuckle(end, (1, 0, 0), 0.12, 0.17))
    if style == "four":
        m.add(foot, rod(end, end * (1, 1, 0), 0.24, max(8, k.n)))
    else:
        m.add(foot, *k.body((x - 0.24, x + 0.24), (end[1] - 0.3, end[1] + 0.3), (0, 0.16)))
        toes = (-0.14, 0.14) if style == "bird" else (0.0,)
        m.add(
            foot, *(s for q in toes for s in k.limb((x + q, end[1] - 0.2, 0.1), (x + 1.4 * q, end[1] - 0.62, 0.05), 0.16, 0.1))
        )
    m.hinge(foot, end, (1, 0, 0), (-20, 25), parent)


def _arms(m: Model, k: Look, hull: str, w: float, low: float, h: float) -> None:
    """Guns at the shoulders: boxes with barrels that pitch, or arms with forearms, or none."""
    style = m.pick("gun", "gun", "pod", "arm", "none")
    if style == "none":
        return
    r, long, count = m.number(0.05, 0.1), m.number(0.6, 1.3), m.pick(1, 2, 3)
    for s, name in ((-1, "right"), (1, "left")):
        at = vec(s * (w + 0.3), 0, low + 0.55 * h)
        part = f"gun_{name}" if style != "arm" else f"arm_{name}"
        m.add(hull, rod((s * 0.8 * w, 0, at[2]), (s * (w + 0.16), 0, at[2]), 0.12, max(8, k.n)))
        axis = (-1, 0, 0)
        if style == "arm":
            m.add(part, *k.limb(at + vec(0, 0, 0.12), at - vec(0, 0, 0.7), 0.3, 0.32))
            m.hinge(part, at, axis, (-40, 80), hull)
            elbow = at - vec(0, 0, 0.62)
            part, parent = f"forearm_{name}", part
            m.add(part, *k.limb(elbow + vec(0, 0.15, -0.22), elbow + vec(0, -0.9, -0.22), 0.3, 0.26))
            m.add(part, rod(elbow + vec(0, -0.8, -0.22), elbow + vec(0, -0.9 - long, -0.22), r, k.n))
            m.add(parent, *k.knuckle(elbow - vec(0, 0, 0.12), (1, 0, 0), 0.1, 0.17))
            m.hinge(part, elbow - vec(0, 0, 0.12), axis, (-40, 40), parent)
            continue
        m.add(part, *k.body((at[0] - 0.17, at[0] + 0.17), (-0.5, 0.4), (at[2] - 0.22, at[2] + 0.22)))
        if style == "pod":
            m.add(
                part,
                *(
                    rod((at[0] + 0.09 * i, -0.45, at[2] + 0.1 * j), (at[0] + 0.09 * i, -0.56, at[2] + 0.1 * j), 0.04, 8)
                    for i in (-1, 1)
                    for j in (-1, 0, 1)
                ),
            )
        else:
            m.add(
                part,
                *(
                    rod(
                        (at[0], -0.45, at[2] + 0.13 * (i - 0.5 * (count - 1))),
                        (at[0], -0.5 - long, at[2] + 0.13 * (i - 0.5 * (count - 1))),
                        0.8 * r,
                        k.n,
                    )
                    for i in range(count)
                ),
            )
        m.hinge(part, at, axis, m.pick((-30, 40), (-20, 60)), hull)


def _top(m: Model, k: Look, hull: str, w: float, d: float, low: float, h: float) -> None:
    """A hatch, a turret with a gun, a dish or aerials; a gun under the chin."""
    z = low + h
    kind = m.pick("hatch", "turret", "none", "none")
    if kind == "hatch" and k.style != "round" and m.of(hull).bounds[1][2] < z + 0.01:
        y = (0.1 * d, 0.7 * d)
        m.add("hatch", *k.plate((-0.35 * w, 0.35 * w), y, (z + 0.001, z + 0.06), "+z"))
        m.hinge("hatch", (0, y[1], z + 0.001), (-1, 0, 0), m.pick(75, 110), hull)
    elif kind == "turret" and m.of(hull).bounds[1][2] < z + 0.01:
        y = 0.3 * d
        m.add("turret", rod((0, y, z - 0.08), (0, y, z + 0.25), 0.24, max(8, k.n)))
        m.hinge("turret", (0, y, z), (0, 0, 1), (-170, 170), hull)
        m.add("turret_gun", rod((0, y - 0.15, z + 0.14), (0, y - 0.8, z + 0.14), 0.05, k.n))
        m.add("turret_gun", *k.knuckle((0, y - 0.22, z + 0.14), (1, 0, 0), 0.09, 0.12))
        m.hinge("turret_gun", (0, y - 0.2, z + 0.14), (-1, 0, 0), (-3, 45), "turret")
    if m.chance(0.4):
        m.add(hull, rod((0.6 * w, 0.5 * d, z - 0.3 * h), (0.6 * w, 0.5 * d, z + 0.5), 0.015, 6))
    if m.chance(0.35):
        at = vec(0, -0.7 * d, low - 0.05)
        m.add(
            "chin_gun",
            ball(at, (0.16,) * 3, max(8, k.n)),
            *(rod(at + vec(q, 0, 0), at + vec(q, -0.6, -0.02), 0.035, k.n) for q in (-0.06, 0.06)),
        )
        m.hinge("chin_gun", at, (-1, 0, 0), (-25, 8), hull)


def spider_robot(m: Model) -> None:
    """A round, boxed or two-part body on four, six or eight legs of two or three members; a turret, a head or jaws."""
    k, count = look(m), m.pick(4, 6, 6, 8, 8)
    r, high = m.number(0.08, 0.16), m.number(0.09, 0.2)
    long, shape, h = m.pick(1.0, 1.3, 1.7), m.pick("disc", "box", "ball", "two"), m.number(0.03, 0.07)
    if shape == "disc":
        disc = rod((0, 0, high - h), (0, 0, high + h), r, max(8, k.n))
        disc.apply_scale((1, long, 1))
        m.add(BASE, disc, *k.body((-0.5 * r, 0.5 * r), (-0.5 * r, 0.5 * r), (high + 0.8 * h, high + 1.7 * h)))
    elif shape == "ball":
        m.add(BASE, ball((0, 0, high), (r, r * long, 1.3 * h), max(10, k.n)))
    else:
        m.add(BASE, *k.body((-r, r), (-r * long, r * long), (high - h, high + h)))
        if shape == "two":
            m.add(BASE, ball((0, r * (long + 0.9), high + 0.6 * h), (1.1 * r, 1.3 * r, 1.7 * h), max(10, k.n)))
    reach, segments, coxa = m.number(1.5, 2.6) * r, m.pick(2, 2, 3), m.chance(0.7)
    rise = m.number(0.3, 0.9)
    per_side = count // 2
    for s, side in ((1, "left"), (-1, "right")):
        for i in range(per_side):
            q = (2 * i + 1) / per_side - 1
            y = 0.8 * r * long * q
            x = r * (np.sqrt(max(0.05, 1 - (0.8 * q) ** 2)) if shape in ("disc", "ball") else 1.0)
            out = vec(s, 0.75 * q, 0) / np.hypot(1, 0.75 * q)
            _spider_leg(m, k, f"{side}_{i}", vec(s * x * 0.94, y, high), out, (reach, rise, segments, coxa))
    _spider_head(m, k, r, r * long, high, h)


def _spider_leg(m: Model, k: Look, name: str, at: np.ndarray, out: np.ndarray, form: tuple[float, float, int, bool]) -> None:
    """A coxa that turns about the vertical, a femur that rises and a tibia to the ground."""
    reach, rise, segments, coxa = form
    t, parent = 0.17 * reach, BASE
    side = np.cross(UP, out)
    if coxa:
        end = at + 0.22 * reach * out
        m.add(f"coxa_{name}", *k.limb(at, end, t, t, side), *k.knuckle(at + 0.03 * reach * out, UP, 0.5 * t, 0.6 * t))
        m.hinge(f"coxa_{name}", at, UP, (-30, 30))
        parent, at = f"coxa_{name}", end
    knee = at + 0.5 * reach * out + vec(0, 0, rise * 0.5 * reach)
    spots = [at, knee]
    if segments == 3:
        spots.append(knee + 0.35 * reach * out - vec(0, 0, 0.4 * knee[2]))
    spots.append(spots[-1] * (1, 1, 0) + (0.35 if segments == 2 else 0.1) * reach * out)
    for i, part in enumerate(("femur", "tibia", "tarsus")[:segments]):
        a, b = spots[i], spots[i + 1]
        wide = t * (0.9 - 0.2 * i)
        m.add(f"{part}_{name}", *k.limb(a, b, wide, wide, side, 0.8 if i < segments - 1 else 0.35))
        m.add(parent, *k.knuckle(a, side, 0.45 * wide, 0.6 * wide))
        m.hinge(f"{part}_{name}", a, -side if i == 0 else side, ((-40, 40), (-40, 50), (-30, 30))[i], parent)
        parent = f"{part}_{name}"


def _spider_head(m: Model, k: Look, r: float, y: float, z: float, h: float) -> None:
    """In front a head with eyes and jaws, on top a turret or a mast."""
    if m.chance(0.5):
        part = "head" if m.chance(0.6) else BASE
        m.add(part, *k.body((-0.4 * r, 0.4 * r), (-y - 0.5 * r, -y + 0.05 * r), (z - 0.5 * h, z + 0.7 * h)))
        m.add(part, *(ball((q * 0.2 * r, -y - 0.48 * r, z + 0.2 * h), (0.08 * r,) * 3, 8) for q in (-1, 1)))
        if part == "head":
            m.hinge("head", (0, -y, z), m.pick(UP, vec(1, 0, 0)), (-25, 25))
        if m.chance(0.6):
            for q, name in ((-1, "right"), (1, "left")):
                a = vec(q * 0.25 * r, -y - 0.42 * r, z - 0.3 * h)
                m.add(f"jaw_{name}", *k.limb(a, a + vec(-q * 0.1 * r, -0.45 * r, -0.3 * h), 0.1 * r, 0.1 * r, (1, 0, 0), 0.4))
                m.hinge(f"jaw_{name}", a, (0, 0, q), (0, 40), part)
    if m.chance(0.4):
        top = z + 1.6 * h
        m.add("turret", rod((0, 0, z + 0.5 * h), (0, 0, top + 0.3 * r), 0.3 * r, max(8, k.n)))
        m.add(
            "turret",
            *(
                rod((q * 0.12 * r, -0.2 * r, top + 0.12 * r), (q * 0.12 * r, -0.9 * r, top + 0.12 * r), 0.05 * r, k.n)
                for q in m.pick((-1, 1), (0,))
            ),
        )
        m.hinge("turret", (0, 0, top), UP, (-150, 150))
