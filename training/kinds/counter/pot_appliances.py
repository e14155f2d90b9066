"""Electric pots: slow cookers and deep fryers."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.counter.counter_appliances import back_hinge, bar, tower
from training.kinds.joinery import shrunk
from training.kinds.kitchen_parts import tray
from training.kinds.kitchen_trims import button, cable, dial, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, prism, ring, rod, rounded, vec


def wide(solid: Trimesh, share: float) -> Trimesh:
    """A solid stretched along x."""
    solid.apply_scale((share, 1, 1))
    return solid


def _controls(m: Model, y: float, z: float, r: float) -> None:
    """A dial, buttons with a display, or a lever switch on a small panel at the front."""
    style = m.pick("dial", "dial", "dial", "buttons", "display")
    m.add(BASE, box((-0.05, 0.05), (y, y + 0.05), (z - 1.5 * r, z + 1.5 * r)))
    if style == "dial":
        dial(m, "dial", (0, y, z), (0, -1, 0), r)
    for k in range(3) if style != "dial" else ():
        at = (0.028 * (k - 1), y, z - 0.7 * r)
        if style == "buttons":
            button(m, f"button_{k}", at, (0, -1, 0), 0.014)
        else:
            m.add(BASE, rod(at, (at[0], y - 0.002, at[2]), 0.007, 10))
    if style != "dial":
        m.add(BASE, box((-0.035, 0.035), (y - 0.002, y + 0.01), (z, z + r)))


def slow_cooker(m: Model) -> None:
    """Make a slow cooker: round, oval or square, a lid that lifts off or is hinged, clips at its sides, a dial or buttons."""
    r, h, n = m.number(0.11, 0.15), m.number(0.11, 0.2), m.pick(20, 28, 36)
    shape, oval = m.pick("round", "oval", "square"), m.number(1.2, 1.4)
    s = 1.0 if shape == "round" else oval
    half, low = s * r, 0.012
    if shape == "square":
        span = (-half, half), (-r, r)
        shell = tower(*span, 0.5 * r, [(0.88, low), (0.97, low + 0.03), (1, h)])
        room = tower(*span, 0.5 * r, [(0.82, low + 0.02), (0.95, h + 0.01)])
        m.add(BASE, cut(shell, room) if m.chance(0.7) else shell)
        m.add(
            BASE,
            prism(rounded(*span, 0.5 * r).buffer(0.004).difference(rounded(*span, 0.5 * r).buffer(-0.01)), "z", (h, h + 0.01)),
        )
    else:
        outer = [(0.88 * r, low), (0.97 * r, low + 0.03), (r, h)]
        inner = [(0.95 * r, h), (0.85 * r, low + 0.02)]
        m.add(BASE, wide(lathe([*outer, *inner] if m.chance(0.7) else outer, n), s))
        m.add(BASE, wide(ring((0, 0, h + 0.002), (0, 0, 1), r, 0.008, n), s))
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.02), 0.012, 8) for a in (-0.5 * half, 0.5 * half) for b in (-0.5 * r, 0.5 * r)))
    _slow_lid(m, shape, half, r, s, h + 0.011, n)
    _controls(m, -0.97 * r - 0.012, 0.45 * h, m.number(0.018, 0.026))
    clips = m.chance(0.35)
    for side in (-1, 1):
        _ear(m, side, half, (0.4 if clips else 0.72) * h)
    if clips:
        _clips(m, half, h)
    if m.chance(0.3):
        cable(m, (0, 0.9 * r, 0.03), 0.2)


def _slow_lid(m: Model, shape: str, half: float, r: float, s: float, low: float, n: int) -> None:
    top, hinged = low + m.number(0.015, 0.055), m.chance(0.4)
    if shape == "square":
        m.add("lid", tower((-half, half), (-r, r), 0.5 * r, [(0.98, low), (0.98, low + 0.006), (0.75, top)]))
    else:
        m.add("lid", wide(lathe([(0.99 * r, low), (0.99 * r, low + 0.006), (0.75 * r, top - 0.004), (0.3 * r, top)], n), s))
    grip = m.pick("knob", "bow", "bar")
    if grip == "knob":
        m.add(
            "lid",
            rod((0, 0, top - 0.004), (0, 0, top + 0.02), 0.01, 10),
            rod((0, 0, top + 0.015), (0, 0, top + 0.027), 0.022, n),
        )
    elif grip == "bow":
        path = [(-0.05, 0, top - 0.006), (-0.04, 0, top + 0.028), (0.04, 0, top + 0.028), (0.05, 0, top - 0.006)]
        m.add("lid", bar(path, 0.006, 8))
    else:
        m.add("lid", box((-0.05, 0.05), (-0.01, 0.01), (top - 0.004, top + 0.016)))
    if not hinged:
        m.slide("lid", (0, 0, 1), m.number(0.08, 0.13))
        return
    m.add(BASE, box((-0.03, 0.03), (0.9 * r, r + 0.024), (low - 0.05, low - 0.001)))
    m.add("lid", box((-0.024, 0.024), (0.88 * r, r + 0.022), (low, low + 0.01)))
    back_hinge(m, "lid", (0, r + 0.016, low), 0.03, m.pick(80, 95))


def _ear(m: Model, side: int, half: float, z: float) -> None:
    if m.chance(0.5):
        m.add(BASE, box(tuple(sorted((side * 0.95 * half, side * (half + 0.035)))), (-0.045, 0.045), (z, z + 0.018)))
        return
    a, b = side * 0.96 * half, side * (half + 0.035)
    m.add(BASE, bar([(a, -0.05, z), (b, -0.045, z + 0.005), (b, 0.045, z + 0.005), (a, 0.05, z)], 0.008, 8))


def _clips(m: Model, half: float, h: float) -> None:
    for side, name in ((-1, "clip_left"), (1, "clip_right")):
        x, low = side * (1.03 * half + 0.006), h - 0.03
        m.add(BASE, box(tuple(sorted((side * 0.94 * half, x))), (-0.02, 0.02), (low - 0.01, low + 0.004)))
        m.add(name, box(tuple(sorted((x, x + side * 0.005))), (-0.015, 0.015), (low - 0.006, h + 0.03)))
        m.add(name, box(tuple(sorted((side * 0.9 * half, x + side * 0.004))), (-0.012, 0.012), (h + 0.026, h + 0.031)))
        m.add(name, rod((x, -0.02, low), (x, 0.02, low), 0.005, 10))
        m.hinge(name, (x, 0, low), (0, side, 0), m.pick(60, 75, 90))


def deep_fryer(m: Model) -> None:
    """Make a deep fryer: one basket under a hinged lid, or one or two open tanks with a control box at their back; a tap."""
    m.pick(_closed_fryer, _open_fryer)(m)


def _closed_fryer(m: Model) -> None:
    w, d, h = m.number(0.24, 0.3), m.number(0.28, 0.38), m.number(0.18, 0.23)
    x, y, corner = (-w / 2, w / 2), (-d / 2, d / 2), m.pick(0.15, 0.3, 0.46) * w
    shell = tower(x, y, corner, [(0.92, 0.01), (1, 0.04), (1, h)])
    room = prism(rounded(shrunk(x, 0.02), shrunk(y, 0.02), max(corner - 0.02, 0.01)), "z", (0.05, h + 1))
    hollow, low, top = m.chance(0.8), h + m.pick(0.0, 0.002), h + m.number(0.04, 0.07)
    m.add(BASE, cut(shell, room) if hollow else shell)
    m.add(BASE, *(rod((a, b, 0), (a, b, 0.015), 0.014, 8) for a in (-0.3 * w, 0.3 * w) for b in (-0.36 * d, 0.36 * d)))
    lid = tower(x, y, corner, [(1.01, low), (1.01, low + 0.012), (0.92, top - 0.01), (0.8, top)])
    spread = (-0.2 * w, 0.2 * w), (-0.28 * d, 0.02 * d)
    if m.chance(0.4):
        lid = cut(lid, prism(rounded(*spread, 0.015), "z", (h - 1, h + 1)))
        m.add("lid", prism(rounded(*spread, 0.015), "z", (top - 0.008, top - 0.004)))
    elif m.chance(0.6):
        m.add("lid", prism(rounded(*spread, 0.015), "z", (top - 0.002, top + 0.002)))
    m.add(
        "lid",
        lid,
        *(box((-0.1 * w, 0.1 * w), (c, c + 0.006), (top - 0.004, top + 0.003)) for c in (0.12 * d, 0.17 * d, 0.22 * d)),
    )
    if m.chance(0.7):
        m.add("lid", box((-0.04, 0.04), (-d / 2 - 0.02, -0.44 * d), (low + 0.004, low + 0.018)))
    m.add(BASE, box((-0.3 * w, 0.3 * w), (0.4 * d, d / 2 + 0.018), (0.5 * h, h - 0.001)))
    m.add("lid", box((-0.24 * w, 0.24 * w), (0.4 * d, d / 2 + 0.016), (low, low + 0.016)))
    back_hinge(m, "lid", (0, d / 2 + 0.012, low), 0.2 * w, m.pick(70, 85, 95))
    if hollow and m.chance(0.85):
        tray(m, "basket", shrunk(x, 0.042), shrunk(y, 0.05), (0.07, h - 0.015), m.pick("wire", "wire", "tub"))
        m.slide("basket", (0, 0, 1), m.number(0.08, 0.15))
    _controls(m, -d / 2 - 0.012, 0.5 * h, m.number(0.018, 0.026))
    for side in (-1, 1) if m.chance(0.7) else ():
        _ear(m, side, w / 2, 0.75 * h)
    if m.chance(0.3):
        cable(m, (0, d / 2, 0.04), 0.2)


def _open_fryer(m: Model) -> None:
    tanks, one, d, h = m.pick(1, 1, 2), m.number(0.2, 0.28), m.number(0.34, 0.42), m.number(0.17, 0.24)
    tap, foot = m.chance(0.4), m.pick(0.015, 0.06)
    for k in range(tanks):
        x = ((one + 0.01) * k, (one + 0.01) * k + one)
        shell, back = box(x, (0, d), (foot, foot + h)), d - 0.08
        m.add(BASE, cut(shell, box(shrunk(x, 0.015), (0.05, back), (foot + 0.03, foot + h + 1))) if m.chance(0.8) else shell)
        m.add(BASE, *(rod((a, b, 0), (a, b, foot), 0.014, 10) for a in shrunk(x, 0.03) for b in (0.03, d - 0.03)))
        top = foot + h
        box_top = top + m.number(0.07, 0.13)
        m.add(BASE, prism([(back, top), (d, top), (d, box_top), (back + 0.03, box_top)], "x", shrunk(x, 0.02)))
        heater = [
            (x[0] + 0.05, back + 0.02, top + 0.02),
            (x[0] + 0.05, back - 0.02, top + 0.01),
            (x[0] + 0.05, back - 0.02, foot + 0.05),
        ]
        m.add(BASE, bar(heater, 0.006, 6))
        side = sum(x) / 2
        spots = m.pick((0.0,), (-0.06, 0.06))
        front = m.chance(0.5)
        for i, c in enumerate(spots):
            dial(
                m,
                f"dial_{k}_{i}",
                (side + c, 0, foot + 0.6 * h) if front else (side + c, back + 0.05, box_top),
                (0, -1, 0) if front else (0, 0, 1),
                0.02,
            )
        _fry_basket(m, f"basket_{k}", shrunk(x, 0.03), (0.065, back - 0.05), (foot + 0.05, top + 0.005))
        if tap:
            _drain(m, f"tap_{k}", vec(x[0] + 0.06, 0, foot + 0.045))
        elif m.chance(0.4):
            m.add(BASE, box((x[0] + 0.03, x[0] + 0.1), (-0.002, 0), (foot + 0.02, foot + 0.05)))
    if m.chance(0.5):
        m.add(BASE, box((0, (one + 0.01) * tanks), (d, d + 0.01), (foot + 0.02, foot + h - 0.02)))


def _fry_basket(m: Model, part: str, x: Span, y: Span, z: Span) -> None:
    tray(m, part, x, y, z, m.pick("wire", "wire", "tub"))
    c, out = sum(x) / 2, m.number(0.12, 0.18)
    for s in (-0.012, 0.012):
        m.add(part, bar([(c + s, y[0], z[1] - 0.03), (c + s, y[0], z[1]), (c + s, y[0] - out, z[1] + 0.04)], 0.0025, 6))
    m.add(part, rod((c, y[0] - 0.5 * out, z[1] + 0.02), (c, y[0] - out - 0.02, z[1] + 0.045), m.pick(0.014, 0.017), 10))
    m.slide(part, (0, 0, 1), m.number(0.1, 0.16))


def _drain(m: Model, part: str, at: np.ndarray) -> None:
    end = at - vec(0, 0.05, 0)
    m.add(BASE, rod(at + vec(0, 0.004, 0), end, 0.01, 12), rod(end + vec(0, 0, 0.012), end - vec(0, 0, 0.022), 0.01, 12))
    top = at + vec(0, -0.025, 0.011)
    m.add(part, rod(top - vec(0, 0, 0.004), top + vec(0, 0, 0.006), 0.006, 8))
    m.add(part, box((top[0] - 0.005, top[0] + 0.05), (top[1] - 0.006, top[1] + 0.006), (top[2] + 0.004, top[2] + 0.009)))
    m.hinge(part, top, (0, 0, -1), 90)
