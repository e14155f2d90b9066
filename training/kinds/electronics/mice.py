"""Computer mice."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import box, common, cut, loft, prism, rod, rounded, tube, vec


def _shell(
    wide: float, long: float, high: float, form: tuple[float, float, float, float], n: int, shrink: float = 0.0
) -> Trimesh:
    """A rounded body over y from the nose (-) to the tail; form: where its top is, height of nose and tail, waist."""
    peak, nose, tail, waist = form
    rings, t = [], np.linspace(0, np.pi, n)
    for u in np.linspace(0, 1, n + 1):
        end = np.clip(min(u, 1 - u) / 0.12, 0, 1)
        blunt = 0.72 + 0.28 * np.sqrt(1 - (1 - end) ** 2)
        rise = np.interp(u, [0, peak, 1], [nose, 1, tail])
        rise += 0.25 * (1 - rise) * np.sin(np.pi * (u / peak if u < peak else (1 - u) / (1 - peak)))
        half = wide / 2 * blunt * (1 - waist * np.sin(np.pi * u) ** 2) - shrink
        top = high * rise - shrink
        power = 0.55
        x = half * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** power
        z = 0.0025 + (top - 0.0025) * np.sin(t) ** power
        y = (u - 0.5) * (long - 2 * shrink)
        rings.append(np.c_[x, np.full(n, y), z])
    return loft(np.array(rings))


def _wheel(m: Model, y: float, top: float) -> None:
    """A wheel about x that stands out of the top."""
    r, half, n = m.number(0.009, 0.012), m.number(0.003, 0.0045), m.pick(12, 16, 24)
    at = vec(0, y, top - 0.55 * r)
    m.add("wheel", rod(at - vec(half, 0, 0), at + vec(half, 0, 0), r, n))
    if m.chance(0.6):
        for t in np.linspace(0, 2 * np.pi, 12, endpoint=False):
            p = at + r * vec(0, np.cos(t), np.sin(t))
            m.add("wheel", rod(p - vec(0.8 * half, 0, 0), p + vec(0.8 * half, 0, 0), 0.0006, 5))
    m.add(m.pick("wheel", BASE), rod(at - vec(half + 0.003, 0, 0), at + vec(half + 0.003, 0, 0), 0.002, 8))
    m.spin("wheel", at, (1, 0, 0))


def _height(shell: Trimesh, y: float, x: float = 0.0) -> float:
    """How high a body is at a place."""
    hits = shell.ray.intersects_location([[x, y, 1.0]], [[0, 0, -1.0]])[0]
    return float(hits[:, 2].max())


def _cable(m: Model, y: float, z: float) -> None:
    m.add(BASE, tube([(0, y + 0.006, z), (0, y - 0.015, z), (0.01, y - 0.04, 0.002), (0.03, y - 0.09, 0.002)], 0.0018, 6))
    m.add(BASE, rod((0, y + 0.004, z), (0, y - 0.012, z), 0.003, 8))


def _below(m: Model, wide: float, long: float) -> None:
    """Glides, a switch and a battery cover on the underside."""
    m.add(
        BASE,
        *(
            prism(rounded((-0.3 * wide, 0.3 * wide), (y - 0.005, y + 0.005), 0.003), "z", (0, 0.003))
            for y in (-0.38 * long, 0.38 * long)
        ),
    )
    if m.chance(0.35):
        m.add(
            "battery_cover",
            prism(rounded((-0.24 * wide, 0.24 * wide), (-0.06 * long, 0.2 * long), 0.004), "z", (0.0012, 0.0026)),
        )
        m.slide("battery_cover", (0, 1, 0), 0.13 * long)
    if m.chance(0.35):
        m.add("switch", box((-0.004, 0.002), (-0.2 * long, -0.2 * long + 0.004), (0.0008, 0.003)))
        m.slide("switch", (1, 0, 0), 0.004)


def _round_mouse(m: Model) -> None:
    wide, long, high = m.number(0.055, 0.07), m.number(0.095, 0.128), m.number(0.03, 0.042)
    form = (m.number(0.5, 0.68), m.number(0.45, 0.7), m.number(0.3, 0.6), m.pick(0.0, 0.06, 0.12))
    n, skin, gap = m.pick(9, 12, 16), m.number(0.0022, 0.0035), m.pick(0.0003, 0.0006, 0.001)
    shell, core = _shell(wide, long, high, form, n), _shell(wide, long, high, form, n, skin)
    split, low = m.number(-0.08, 0.06) * long, m.number(0.3, 0.5) * form[1] * high
    sides = [(-1.0, -gap), (gap, 1.0)]
    strip = m.pick(0.0, 0.0, 0.0035, 0.006)
    sides = [(-1.0, -gap - strip), (gap + strip, 1.0)]
    body = cut(shell, cut(box((-1, 1), (-1, split), (low, 1)), core))
    if strip:
        inner = _shell(wide, long, high, form, n, 0.4 * skin)
        body = cut(shell, *(cut(box(a, (-1, split), (low, 1)), core) for a in ((-1.0, -strip), (strip, 1.0))))
        body = cut(body, cut(box((-strip, strip), (-1, split), (low, 1)), inner))
    slot, top = m.number(-0.3, -0.24) * long, 0.0
    top = _height(shell, slot)
    hole = box((-0.006, 0.006), (slot - 0.013, slot + 0.013), (top - 0.02, 1))
    lifted = _shell(wide, long, high, form, n, 0.6 * skin)
    for k, a in enumerate(sides):
        region = box(a, (-1, split - 2 * gap), (low + 2 * gap, 1))
        button = cut(common(cut(shell, lifted), region), hole)
        part = f"{('left', 'right')[k]}_button"
        m.add(part, button)
        x = (-1, 1)[k] * 0.25 * wide
        m.hinge(part, (x, split - 2 * gap, _height(shell, split - 0.001, x) - 0.5 * skin), (1, 0, 0), m.pick(1.5, 2.5))
    if m.chance(0.9):
        body = cut(body, hole)
        _wheel(m, slot, top)
    if m.chance(0.4):
        y = min(split - 0.012, slot + 0.02)
        z = _height(shell, y)
        m.add("middle_button", prism(rounded((-0.003, 0.003), (y - 0.004, y + 0.004), 0.002), "z", (z - 0.003, z + 0.0012)))
        m.slide("middle_button", (0, 0, -1), 0.001)
    body = _side_buttons(m, body, (wide, long, high, form, n), split)
    m.add(BASE, body)
    _below(m, wide, long)
    if m.chance(0.5):
        _cable(m, -long / 2, 0.3 * form[1] * high)


def _side_buttons(m: Model, body: Trimesh, size: tuple, split: float) -> Trimesh:
    """Buttons above the thumb, pressed inwards; gives the body with their places cut out of it."""
    wide, long, high, form, n = size
    count, begin = m.pick(0, 0, 1, 2, 2), split + m.number(0.002, 0.01) - (0.02 if split > 0 else 0.0)
    if not count:
        return body
    outer, inner = _shell(wide, long, high, form, n, -0.0012), _shell(wide, long, high, form, n, 0.002)
    z, each = (0.48 * high, 0.48 * high + m.number(0.004, 0.006)), m.number(0.011, 0.018) * 2 / (count + 1)
    for k in range(count):
        place = box((-1, -0.2 * wide), (begin + k * each, begin + (k + 1) * each - 0.0006), z)
        m.add(f"side_button_{k}", common(cut(outer, inner), place))
        m.slide(f"side_button_{k}", (1, 0, 0), 0.001)
        body = cut(body, cut(place, inner))
    return body


def _box_mouse(m: Model) -> None:
    """An old or simple mouse: a slab that slopes, with one to three keys at its nose."""
    wide, long, high = m.number(0.055, 0.07), m.number(0.085, 0.11), m.number(0.026, 0.036)
    nose, y = m.number(0.5, 0.85) * high, (-long / 2, long / 2)
    reach = m.number(0.28, 0.45) * long
    split, t = y[0] + reach, 0.004
    at = nose + (high - nose) * 0.7
    side = [
        (y[0], 0.001),
        (y[1], 0.001),
        (y[1], m.number(0.5, 0.9) * high),
        (0.15 * long, high),
        (split, at),
        (split, at - t),
        (y[0], nose - t),
    ]
    body = prism(side, "x", (-wide / 2, wide / 2))
    corner = m.pick(0.001, 0.006, 0.012)
    outline = prism(rounded((-wide / 2, wide / 2), y, corner), "z", (0, 1))
    body = common(body, outline)
    count = m.pick(1, 2, 2, 3)
    each, over, wheel = wide / count, m.pick(0.0, 0.001), count == 2 and m.chance(0.6)
    slot, top = y[0] + 0.45 * reach, nose + (at - nose) * 0.45
    hole = box((-0.006, 0.006), (slot - 0.0125, slot + 0.0125), (top - 0.018, 1))
    for k in range(count):
        x = (-wide / 2 + k * each + (over if k else -over), -wide / 2 + (k + 1) * each - (over if k < count - 1 else -over))
        key = prism(
            [(y[0] - over, nose - t + 0.0012), (y[0] - over, nose), (split - 0.0006, at), (split - 0.0006, at - t + 0.0006)],
            "x",
            x,
        )
        key = key if over else common(key, outline)
        m.add(f"button_{k}", cut(key, hole) if wheel else key)
        m.hinge(f"button_{k}", ((x[0] + x[1]) / 2, split, at - 0.5 * t), (1, 0, 0), m.pick(1.5, 2.0))
    if wheel:
        body = cut(body, hole)
        _wheel(m, slot, top)
    m.add(BASE, body)
    if m.chance(0.8):
        _cable(m, y[0], 0.4 * nose)
    _below(m, wide, long)


def computer_mouse(m: Model) -> None:
    """A mouse, rounded or a slab: buttons hinged at their rear edge, a wheel, side buttons, a battery cover below."""
    _round_mouse(m) if m.chance(0.7) else _box_mouse(m)
