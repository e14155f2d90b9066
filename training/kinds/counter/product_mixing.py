"""Things that stir, by one artist: stand mixer."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, tapered
from training.kinds.solids import ball, box, loft, prism, rod, rounded, tube, turned, vec


def bowl_mixer(m: Model) -> None:
    """A stand mixer: a head that tilts, or a bowl that a crank lifts; a whisk, a dial, a lock, a bowl that turns."""
    look = Look.of(m)
    scale, n = m.number(0.85, 1.15), max(look.n, 8)
    lifts = m.chance(0.3)
    r, y = 0.105 * scale, -0.13 * scale
    foot, head = 0.03 * scale, m.number(0.2, 0.24) * scale
    if look.style in ("prop", "sheet") or m.chance(0.4):
        m.add(BASE, look.block((-0.1 * scale, 0.1 * scale), (y - 0.12 * scale, 0.09 * scale), (0, foot)))
    else:
        m.add(
            BASE,
            prism(
                rounded((-0.1 * scale, 0.1 * scale), (y - 0.12 * scale, 0.09 * scale), 0.085 * scale, n // 3), "z", (0, foot)
            ),
        )
    post = ((-0.05 * scale, 0.05 * scale), (-0.005 * scale, 0.085 * scale), (foot - 0.002, head))
    m.add(
        BASE, look.block(*post) if m.chance(0.5) else tapered(((-0.07 * scale, 0.07 * scale), post[1]), post[:2], post[2], 0.02)
    )
    low = foot + (0.06 if lifts else 0.002) * scale
    high = head - 0.012 * scale - low
    _bowl(look, vec(0, y, low), r, high)
    if lifts:
        _crank(look, vec(0, y, low), r, high, scale)
    else:
        m.add(BASE, lathe([(0.55 * r, foot - 0.002), (0.5 * r, foot + 0.004)], n, (0, y, 0)))
        m.hinge("bowl", (0, y, low), UP, (0, m.pick(30, 60)))
        m.hinge("head", (0, 0.06 * scale, head), (-1, 0, 0), m.pick(45, 50, 55))
    head_part = BASE if lifts else "head"
    _mixer_head(look, head_part, y, head, scale)
    _whisk(look, head_part, vec(0, y, head), low + 0.16 * high, 0.5 * r)


def _bowl(look: Look, at: np.ndarray, r: float, high: float) -> None:
    """A bowl, perhaps with an ear."""
    m, closed = look.m, look.style != "sheet"
    metal = [(0.5, 0.0), (0.8, 0.12), (1.0, 0.55), (1.03, 1.0)]
    inside = [(1.0, 1.0), (0.96, 0.55), (0.75, 0.15), (0.3, 0.05)] if closed else []
    m.add("bowl", lathe([(a * r, b * high) for a, b in metal + inside], max(look.n, 12), at, caps=closed))
    if m.chance(0.5):
        ear = [(0.98, 0.85), (1.5, 0.8), (1.5, 0.5), (0.9, 0.4)]
        m.add("bowl", tube([at + vec(a * r, 0, b * high) for a, b in ear], 0.006))


def _crank(look: Look, at: np.ndarray, r: float, high: float, scale: float) -> None:
    """Arms that carry the bowl on the column, and the crank that lowers them."""
    m, y, z = look.m, at[1], at[2] + 0.55 * high
    m.add("bowl", *(box((s * r - 0.009, s * r + 0.009), (y, 0.0), (z, z + 0.02)) for s in (-1, 1)))
    m.add("bowl", box((-1.1 * r, 1.1 * r), (-0.016, -0.004), (z - 0.05 * high, z + 0.15 * high)))
    m.slide("bowl", (0, 0, -1), 0.05 * scale)
    side, h = 0.05 * scale, at[2] + 0.4 * high
    m.add("crank", rod((side, 0.04, h), (side + 0.03, 0.04, h), 0.01, max(look.n, 8)))
    m.add("crank", tube([(side + 0.02, 0.04, h), (side + 0.023, 0.1, h + 0.02), (side + 0.05, 0.12, h + 0.03)], 0.005))
    m.hinge("crank", (side, 0.04, h), (1, 0, 0), m.pick(90, 160))


def _mixer_head(look: Look, part: str, y: float, z: float, scale: float) -> None:
    """The motor over the bowl, its dial, its lock and a cap at the nose."""
    m, n = look.m, max(look.n, 8)
    gap, tall, half = 0.001, m.number(0.1, 0.13) * scale, m.number(0.052, 0.065) * scale
    front, back = y - 0.085 * scale, 0.1 * scale
    z0, z1 = z + gap, z + gap + tall
    if look.style in ("soft", "sunk") or m.chance(0.3):
        nose = [(back, 0.35), (back - 0.02, 0.75), (0.0, 0.95), (y, 1.0), (front + 0.02, 0.85), (front, 0.45)]
        t = np.linspace(0, 2 * np.pi, n, endpoint=False)
        rings = [np.c_[half * s * np.cos(t), np.full(n, a), z0 + tall / 2 + tall / 2 * s * np.sin(t)] for a, s in nose]
        m.add(
            part, loft(np.array(rings)), look.block((-0.7 * half, 0.7 * half), (y - 0.04, back - 0.03), (z0, z0 + 0.4 * tall))
        )
    else:
        m.add(part, look.block((-half, half), (front, back), (z0, z1), leave=""))
    if m.chance(0.5):
        m.add(part, rod((0, front + 0.01, z0 + tall / 2), (0, front - 0.012, z0 + tall / 2), 0.4 * half, n))
    if m.chance(0.5):
        m.add(part, box((-1.03 * half, 1.03 * half), (front + 0.05, back - 0.05), (z0 + 0.5 * tall, z0 + 0.58 * tall)))
    side, at_y = (0.98 * half, m.pick(-0.02, 0.03))
    if m.chance(0.5):
        look.dial("dial", (side, at_y, z0 + 0.5 * tall), (1, 0, 0), 0.018 * scale, 0.018, part)
    else:
        m.add("speed_lever", rod((side - 0.005, at_y, z0 + 0.4 * tall), (side + 0.014, at_y, z0 + 0.4 * tall), 0.005, 8))
        m.add("speed_lever", ball((side + 0.016, at_y, z0 + 0.4 * tall), (0.008, 0.008, 0.008), 8))
        m.slide("speed_lever", FRONT, 0.03, part)
    if m.chance(0.5):
        look.key("lock", (0.05 * scale, 0.045 * scale, z - 0.05 * scale), (1, 0, 0), (0.015, 0.015, 0.007))


def _whisk(look: Look, parent: str, at: np.ndarray, low: float, r: float) -> None:
    """A balloon whisk, a flat beater or a hook under the head."""
    m, kind = look.m, look.m.pick("balloon", "flat", "hook")
    mid, top = (low + at[2]) / 2, at[2] + 0.002
    add = [rod((0, at[1], mid + 0.3 * (top - mid)), (0, at[1], top), 0.011, max(8, look.n // 2))]
    if kind == "balloon":
        add += _balloon(at[1], low, mid + 0.4 * (top - mid), r, m.pick(3, 4, 6))
    elif kind == "flat":
        plan = [
            (0.1 * r, low),
            (0.6 * r, low + 0.02),
            (0.8 * r, mid),
            (0.1 * r, top - 0.03),
            (-0.1 * r, top - 0.03),
            (-0.8 * r, mid),
            (-0.6 * r, low + 0.02),
            (-0.1 * r, low),
        ]
        add += [prism(plan, "y", (at[1] - 0.004, at[1] + 0.004))]
    else:
        t = np.linspace(0, 1.5 * np.pi, 9)
        add += [
            tube(
                [
                    (0, at[1], mid + 0.35 * (top - mid)),
                    *(
                        (0.5 * r * np.sin(a), at[1] + 0.4 * r * (1 - np.cos(a)) * np.cos(a), mid - (mid - low) * a / t[-1])
                        for a in t
                    ),
                ],
                0.007,
            )
        ]
    m.add("whisk", *add)
    m.spin("whisk", at, UP, parent)


def _balloon(y: float, low: float, top: float, r: float, count: int) -> list[Trimesh]:
    """Loops of wire."""
    t = np.linspace(0, 2 * np.pi, 13)
    loop = [(0.7 * r * np.sin(a), 0.0, (low + top) / 2 + (top - low) / 2 * np.cos(a)) for a in t]
    wires = [tube(loop, 0.0022, 5) for _ in range(count)]
    return [turned(w.apply_translation((0, y, 0)), UP, 180 * k / count, (0, y, 0)) for k, w in enumerate(wires)]
