"""Things that clean floors, by one artist: canister, upright and robot vacuum cleaners."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Point as Spot

from training.kinds.model import BASE, Model
from training.kinds.product_style import FRONT, UP, Look, lathe, outline, tapered
from training.kinds.solids import ball, box, cut, loft, prism, ring, rod, tube, vec


def floor_vacuum(m: Model) -> None:
    """A vacuum cleaner: a canister on wheels with its hose, an upright with a tilting stick, or a robot disc."""
    look = Look.of(m)
    m.pick(_canister, _canister, _upright, _upright, _robot)(look)


def _wheel(look: Look, part: str, at: np.ndarray, r: float, thick: float, side: float) -> None:
    """A wheel on an axle along X, drawn simply or with a tread and a cap."""
    m, n, out = look.m, max(look.n, 10), vec(side, 0, 0)
    m.add(part, lathe([(0.9 * r, 0), (r, 0.2 * thick), (r, 0.8 * thick), (0.85 * r, thick)], n, at, out))
    if m.chance(0.6):
        m.add(part, lathe([(0.5 * r, 0), (0.4 * r, 0.12 * thick)], n, at + out * thick, out))
    if m.chance(0.3):
        m.add(part, *(rod(at + out * thick + 0.65 * r * vec(0, np.cos(t), np.sin(t)) - 0.1 * thick * out,
                          at + out * thick * 1.1 + 0.65 * r * vec(0, np.cos(t), np.sin(t)), 0.08 * r, 6)
                      for t in np.linspace(0, 5.03, 5)))  # fmt: skip
    m.spin(part, at, (1, 0, 0))


def _canister(look: Look) -> None:
    """A low body with two big wheels and a castor, a lid or a clear bin, keys, a hose and a nozzle on the floor."""
    m, n = look.m, max(look.n, 10)
    w, long, high, lift = m.number(0.1, 0.14), m.number(0.17, 0.23), m.number(0.12, 0.17), 0.03
    body = ((-w, w), (-long, long), (lift, lift + high))
    drum = m.chance(0.35)
    m.add(BASE, look.block(*body))
    r = m.number(0.5, 0.75) * high
    for k, s in enumerate((-1, 1)):
        _wheel(look, f"wheel_{k}", vec(s * (w - 0.004), 0.55 * long, r), r, m.number(0.025, 0.045), s)
    m.add(BASE, rod((0, -0.75 * long, 0.02), (0, -0.75 * long, lift + 0.005), 0.016, n))
    m.add("castor", rod((-0.012, -0.75 * long, 0.018), (0.012, -0.75 * long, 0.018), 0.018, n))
    m.spin("castor", (0, -0.75 * long, 0.018), (1, 0, 0))
    top = lift + high
    if drum:
        m.add("bin", lathe([(0.62 * w, -0.04), (0.66 * w, 0.0), (0.66 * w, 0.11), (0.5 * w, 0.13)], n, (0, -0.45 * long, top)))
        bow = [(-0.3, 0.125), (-0.2, 0.16), (0.2, 0.16), (0.3, 0.125)]
        m.add("bin", tube([(0, -0.45 * long + a * w, top + b) for a, b in bow], 0.007))
        m.slide("bin", UP, 0.12)
    else:
        lid_y = (-0.96 * long, m.number(0.0, 0.3) * long)
        m.add("lid", look.block((-0.9 * w, 0.9 * w), lid_y, (top + 0.0005, top + m.number(0.02, 0.045))))
        m.hinge("lid", (0, lid_y[1], top + 0.001), (-1, 0, 0), m.pick(60, 80))
    key_y = 0.62 * long
    for k, a in enumerate((-0.45 * w, 0.45 * w)[: m.pick(1, 2)]):
        look.key(f"pedal_{k}", (a, key_y, top), UP, (0.035, 0.03, 0.008))
    if m.chance(0.4):
        look.dial("dial", (0, key_y, top), UP, 0.016, 0.012)
    if m.chance(0.6):
        path = [
            (-0.5 * w, 0.97 * long, top - 0.035),
            (-0.5 * w, long + 0.03, top - 0.03),
            (0.5 * w, long + 0.03, top - 0.03),
            (0.5 * w, 0.97 * long, top - 0.035),
        ]
        m.add("handle", tube(path, 0.007))
        m.hinge("handle", (0, 0.98 * long, top - 0.035), (1, 0, 0), m.pick(60, 80))
    if m.chance(0.6):
        _hose(look, vec(0, -long + 0.005, lift + 0.5 * high))
    slots = np.linspace(lift + 0.25 * high, lift + 0.6 * high, 4)
    m.add(BASE, *(box((-0.4 * w, 0.4 * w), (long - 0.004, long + 0.002), (h, h + 0.005)) for h in slots[: m.pick(0, 3, 4)]))


def _hose(look: Look, at: np.ndarray) -> None:
    """A hose, a pipe and a floor nozzle, all lying still."""
    m = look.m
    t = np.linspace(0, np.pi, 9)
    path = [at + vec(0.12 * (1 - np.cos(a)) * 0.5, -0.25 * np.sin(a), -(at[2] - 0.04) * a / np.pi) for a in t]
    path += [path[-1] + vec(0, 0.12, 0), path[-1] + vec(0.1, 0.35, 0)]
    m.add(BASE, tube(path, 0.017, max(6, look.n // 2)))
    if look.style != "prop":
        m.add(BASE, *(ring(p, b - a, 0.017, 0.004, 10) for a, p, b in zip(path[:-2], path[1:-1], path[2:], strict=True)))
    end = path[-1]
    m.add(
        BASE,
        rod(end, end + vec(0.0, 0.12, 0), 0.014, look.n),
        look.block((end[0] - 0.12, end[0] + 0.12), (end[1] + 0.1, end[1] + 0.17), (0.002, 0.055)),
    )


def _upright(look: Look) -> None:
    """A floor head with wheels and a brush roll; a body on a tilting stick; a bin, a trigger and a swivel."""
    m, n = look.m, max(look.n, 10)
    w, deep, high = m.number(0.12, 0.16), m.number(0.1, 0.14), m.number(0.05, 0.075)
    m.add(BASE, look.block((-w, w), (-deep, -0.02), (0.012, high)))
    for k, s in enumerate((-1, 1)):
        _wheel(look, f"wheel_{k}", vec(s * 0.35 * w, 0.0, 0.028), 0.028, 0.02, s)
    m.add(BASE, look.block((-0.33 * w, 0.33 * w), (-0.03, 0.03), (0.012, 0.045)))
    if m.chance(0.6):
        brush = lathe([(0.018, -0.9 * w), (0.018, 0.9 * w)], n, (0, -deep + 0.015, 0.021), (1, 0, 0))
        m.add(
            "brush",
            brush,
            *(box((-0.85 * w + a, -0.82 * w + a), (-deep - 0.006, -deep), (0.016, 0.026)) for a in np.linspace(0, 1.6 * w, 6)),
        )
        m.spin("brush", (0, -deep + 0.015, 0.021), (1, 0, 0))
    pivot, top, slim = vec(0, 0.0, 0.05), m.number(0.95, 1.15), m.chance(0.5)
    m.add("stick", rod(pivot - vec(0.25 * w, 0, 0), pivot + vec(0.25 * w, 0, 0), 0.02, n))
    m.hinge("stick", pivot, (-1, 0, 0), m.pick(50, 65, 80))
    z0, z1 = (0.72, 0.9) if slim else (0.12, m.number(0.45, 0.6))
    half = 0.05 if slim else 0.7 * w
    m.add("stick", rod(pivot, (0, 0, top), m.number(0.013, 0.02), n))
    m.add("stick", look.block((-half, half), (-0.03, 0.06), (z0, z1), leave=""))
    bin_r = 0.04 if slim else 0.55 * half
    if m.chance(0.8):
        shape = [
            (0.9 * bin_r, z0 + 0.02),
            (bin_r, z0 + 0.03),
            (bin_r, z0 + 0.65 * (z1 - z0)),
            (0.8 * bin_r, z0 + 0.7 * (z1 - z0)),
        ]
        m.add("bin", lathe(shape, n, (0, -0.03 - 0.7 * bin_r, 0)))
        m.slide("bin", m.pick(FRONT, UP) if not slim else FRONT, 0.05, "stick")
    grip = [(0, 0, top - 0.02), (0, 0.03, top + 0.05), (0, -0.03, top + 0.11), (0, -0.08, top + 0.08)]
    m.add("stick", tube(grip if m.chance(0.5) else [*grip, grip[0]], 0.013, 8))
    if m.chance(0.6):
        m.add("trigger", box((-0.006, 0.006), (-0.022, -0.008), (top - 0.06, top - 0.03)))
        m.slide("trigger", (0, 1, 0), 0.006, "stick")
    look.key("power_key", (0, -0.03, z1 - 0.04), FRONT, (0.02, 0.02, 0.006), "stick")
    if m.chance(0.4) and not slim:
        hook = [(0, 0.018, 0.0), (0, 0.045, 0.0), (0, 0.045, 0.02)]
        for k, h in enumerate((z1 + 0.06, z1 + 0.2)):
            m.add(
                f"cord_hook_{k}",
                tube([np.array(p) + vec(0, -0.006, h) for p in hook], 0.005),
                rod((0, 0.008, h), (0, 0.024, h), 0.009, n),
            )
            m.hinge(f"cord_hook_{k}", (0, 0.02, h), (0, 1, 0), 180, "stick")


def _robot(look: Look) -> None:
    """A disc with a bumper, two wheels, a castor, side brushes, keys and a lid over its dust box."""
    m, n = look.m, max(look.n, 16)
    r, high, lift = m.number(0.15, 0.18), m.number(0.07, 0.085), 0.012
    square = m.chance(0.3)
    plan = (
        (lambda s, z: outline((-s, s), (-s, s), 0.3 * s, z, 5))
        if square
        else (lambda s, z: outline((-s, s), (-s, s), 0.999 * s, z, n // 3))
    )
    m.add(BASE, loft(np.array([plan(0.94 * r, lift), plan(r, lift + 0.01), plan(r, high - 0.008), plan(0.95 * r, high)])))
    if not square:
        band = Spot(0, 0).buffer(r + 0.009, quad_segs=n // 2).difference(Spot(0, 0).buffer(r + 0.001, quad_segs=n // 2))
        half = [(-2 * r, -0.1 * r), (-2 * r, -2 * r), (2 * r, -2 * r), (2 * r, -0.1 * r)]
        shell = prism(band, "z", (lift + 0.008, high - 0.01))
        m.add("bumper", cut(shell, prism([(a, b + 2.2 * r) for a, b in half], "z", (-1, 1))))
        m.slide("bumper", (0, 1, 0), 0.006)
    for k, s in enumerate((-1, 1)):
        at = vec(s * 0.62 * r, 0, 0.026)
        _wheel(look, f"wheel_{k}", at, 0.026, 0.018, s)
    m.add("castor", ball((0, -0.7 * r, 0.014), (0.014, 0.014, 0.014), 10))
    m.spin("castor", (0, -0.7 * r, 0.014), (1, 0, 0))
    for k, s in enumerate((-1, 1)[: m.pick(0, 1, 2)]):
        at = vec(s * 0.6 * r, -0.55 * r, 0.0)
        m.add(f"side_brush_{k}", rod(at + vec(0, 0, 0.005), at + vec(0, 0, 0.013), 0.012, n))
        m.add(
            f"side_brush_{k}",
            *(
                rod(at + vec(0, 0, 0.007), at + vec(0.09 * np.cos(t), 0.09 * np.sin(t), 0.003), 0.0022, 5)
                for t in (0.3, 2.4, 4.5)
            ),
        )
        m.spin(f"side_brush_{k}", at, UP)
    for k, a in enumerate(np.linspace(-0.025, 0.025, 3)[: m.pick(1, 2, 3)]):
        look.key(f"key_{k}", (a, -0.6 * r, high), UP, (0.014, 0.014, 0.003))
    if m.chance(0.6):
        m.add(
            "lid",
            tapered(
                ((-0.5 * r, 0.5 * r), (-0.1 * r, 0.7 * r)),
                ((-0.49 * r, 0.49 * r), (-0.09 * r, 0.69 * r)),
                (high + 0.0003, high + 0.005),
                0.02,
            ),
        )
        m.hinge("lid", (0, 0.7 * r, high + 0.0003), (-1, 0, 0), m.pick(60, 80))
    else:
        m.add(BASE, lathe([(0.25 * r, 0), (0.25 * r, 0.018), (0.22 * r, 0.02)], n, (0, 0.2 * r, high - 0.001)))
