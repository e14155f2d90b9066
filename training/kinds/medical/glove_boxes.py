"""Glove boxes of laboratories and workshops."""

from __future__ import annotations

import numpy as np

from training.kinds.kitchen_trims import dial, feet
from training.kinds.model import BASE, Model
from training.kinds.panels import middle
from training.kinds.solids import Span, box, cut, prism, ring, rod, tube, vec
from training.kinds.wheels import beam


def _round_door(m: Model, name: str, at: np.ndarray, r: float, clamp: str) -> None:
    """A round door against the end (towards +x) of a chamber, hinged at its back or front, with a clamp on it."""
    s, n = m.pick(-1, 1), m.sections() + 4
    toward = vec(0, -s, 0)
    m.add(name, rod(at + vec(0.002, 0, 0), at + vec(0.022, 0, 0), 1.12 * r, n))
    hinge = at + vec(0.012, s * 1.25 * r, 0)
    m.add(name, beam(at + vec(0.022, 0, 0), at + vec(0.022, s * 1.25 * r, 0), 0.05, 0.014, (0, 0, 1)))
    m.add(BASE, rod(hinge - vec(0, 0, 0.045), hinge + vec(0, 0, 0.045), 0.011, 10))
    m.add(BASE, beam(hinge - vec(0.05, 0, 0), hinge, 0.05, 0.012, (0, 0, 1)))
    m.add(BASE, beam(at + vec(-0.04, s * 0.9 * r, 0), hinge - vec(0.04, 0, 0), 0.05, 0.014, (0, 0, 1)))
    m.hinge(name, hinge, np.cross(toward, (1, 0, 0)), m.number(95, 150))
    hub, part = at + vec(0.03, 0, 0), f"{name}_clamp"
    if clamp == "wheel":
        m.add(part, rod(hub, hub + vec(0.04, 0, 0), 0.012, 8), ring(hub + vec(0.04, 0, 0), (1, 0, 0), 0.55 * r, 0.009))
        for c in np.pi * np.arange(3) / 3:
            way = 0.55 * r * vec(0, np.cos(c), np.sin(c))
            m.add(part, rod(hub + vec(0.04, 0, 0) - way, hub + vec(0.04, 0, 0) + way, 0.006, 6))
        m.spin(part, hub, (1, 0, 0), name)
    elif clamp == "lever":
        m.add(part, rod(hub, hub + vec(0.03, 0, 0), 0.014, 10))
        m.add(part, beam(hub + vec(0.025, 0, 0), hub + vec(0.03, 0, 0.9 * r), 0.02, 0.012, (0, 1, 0)))
        m.hinge(part, hub, (1, 0, 0), m.pick(60, 90), name)


def glove_box(m: Model) -> None:
    """A chamber with a sloping window, ports with gloves, an airlock or a side door; on a stand or on feet."""
    wide, deep, tall = m.number(0.8, 1.5), m.number(0.55, 0.8), m.number(0.55, 0.85)
    low, t = m.pick(0.02, 0.05, 0.75, 0.9), 0.014
    lean, chin = m.number(0.15, 0.4) * deep, low + m.number(0.06, 0.45) * tall
    outline = [(0, low), (deep, low), (deep, low + tall), (lean, low + tall), (0, chin)]
    inner = [
        (t, low + t),
        (deep - t, low + t),
        (deep - t, low + tall - t),
        (lean + 0.4 * t, low + tall - t),
        (t, chin + 0.1 * t),
    ]
    a, b = np.array([0, 0.0, chin]), np.array([0, lean, low + tall])
    up = (b - a) / np.linalg.norm(b - a)
    out = np.cross((1, 0, 0), up) * -1
    out = out if out[1] < 0 else -out
    long = float(np.linalg.norm(b - a))
    c, rim = vec(wide / 2, 0, 0), m.number(0.04, 0.08)
    hole = beam(a + c + rim * up, b + c - rim * up, wide - 2 * rim, 0.2)
    m.add(BASE, cut(prism(outline, "x", (0, wide)), prism(inner, "x", (t, wide - t)), hole))
    opens = m.chance(0.45)
    part = "window" if opens else BASE
    s, e = a + c + 0.4 * rim * up + 0.008 * out, b + c - 0.4 * rim * up + 0.008 * out
    m.add(part, beam(s, e, wide - 0.8 * rim, 0.012))
    for k in np.linspace(-0.44, 0.44, m.pick(4, 6)):
        m.add(
            part,
            *(
                rod(p + vec(k * wide, 0, 0), p + vec(k * wide, 0, 0) + 0.022 * out, 0.012, 8)
                for p in (s + 0.3 * rim * up, e - 0.3 * rim * up)
            ),
        )
    if opens:
        m.hinge("window", e + 0.006 * out, (-1, 0, 0), m.number(60, 90))
    _glove_ports(m, wide, chin, low, out, part, a, up, long, deep, lean, tall)


def _glove_ports(
    m: Model,
    wide: float,
    chin: float,
    low: float,
    out: np.ndarray,
    part: str,
    a: np.ndarray,
    up: np.ndarray,
    long: float,
    deep: float,
    lean: float,
    tall: float,
) -> None:
    """Ports with or without gloves, in the window or below it, and the stand."""
    ports = m.pick((0.28, 0.72), (0.22, 0.42, 0.62, 0.82)) if wide > 1.2 else (0.3, 0.7)
    r, n = m.number(0.07, 0.09) if len(ports) == 2 else 0.07, m.sections() + 4
    gloves = m.chance(0.7)
    for f in ports:
        if chin - low > 2.6 * r + 0.02:
            p, way, q = vec(f * wide, 0, (low + chin) / 2), vec(0, -1, 0), BASE
        else:
            p, way, q = a + vec(f * wide, 0, 0) + (0.3 * long + 0.01) * up + 0.014 * out, out, part
        m.add(q, ring(p + 0.012 * way, way, r, 0.014, n), rod(p - 0.01 * way, p + 0.012 * way, 0.9 * r, n))
        if gloves:
            m.add(q, beam(p + 0.01 * way, p + 0.16 * way - vec(0, 0, 0.12), 1.3 * r, 1.3 * r, taper=0.6))
    _glove_box_sides(m, wide, deep, (low, low + tall), lean)
    if low > 0.5:
        m.add(BASE, *(box((k, k + 0.04), (j, j + 0.04), (0, low)) for k in (0.0, wide - 0.04) for j in (0.0, deep - 0.04)))
        m.add(BASE, *(box((0.04, wide - 0.04), (j, j + 0.03), (0.15, 0.18)) for j in (0.005, deep - 0.035)))
    else:
        feet(m, (0, wide), (0, deep), low)


def _glove_box_sides(m: Model, wide: float, deep: float, z: Span, lean: float) -> None:
    """What the side walls, the top and the back carry: an airlock, a door, filters, a gauge, valves, a lamp."""
    tall, n = z[1] - z[0], m.sections() + 4
    y = 0.55 * deep
    if m.chance(0.65):
        r, long = min(m.number(0.12, 0.2), 0.3 * deep, 0.4 * tall), m.number(0.15, 0.45)
        at = vec(wide + long, y, z[0] + 0.45 * tall)
        tunnel = cut(rod(at - vec(long, 0, 0), at, r, n), rod(at - vec(long - 0.005, 0, 0), at + vec(1, 0, 0), 0.92 * r, n))
        m.add(
            BASE,
            tunnel,
            *(
                cut(
                    rod(at - vec(q, 0, 0), at - vec(q - 0.02, 0, 0), 1.12 * r, n),
                    rod(at - vec(1, 0, 0), at + vec(1, 0, 0), 0.95 * r, n),
                )
                for q in (0.02, long)
            ),
        )
        _round_door(m, "airlock", at, r, m.pick("wheel", "lever", "none"))
    else:
        a, b = (lean + 0.05, deep - 0.04), (z[0] + 0.08, z[1] - 0.08)
        back = m.chance(0.6)
        m.add("side_door", box((wide + 0.001, wide + 0.02), a, b))
        e = a[0] + 0.03 if back else a[1] - 0.03
        m.add(
            "side_door",
            tube(
                [
                    (wide + 0.02, e, middle(b) - 0.06),
                    (wide + 0.06, e, middle(b) - 0.06),
                    (wide + 0.06, e, middle(b) + 0.06),
                    (wide + 0.02, e, middle(b) + 0.06),
                ],
                0.007,
                8,
            ),
        )
        m.add(
            BASE,
            *(
                rod((wide + 0.01, a[1] if back else a[0], h), (wide + 0.01, a[1] if back else a[0], h + 0.06), 0.012, 8)
                for h in (b[0] + 0.03, b[1] - 0.09)
            ),
        )
        m.hinge(
            "side_door", (wide + 0.01, a[1] if back else a[0], middle(b)), (0, 0, 1) if back else (0, 0, -1), m.number(95, 160)
        )
    _glove_box_fittings(m, wide, n, y, z, lean, tall, deep)


def _glove_box_fittings(m: Model, wide: float, n: int, y: float, z: Span, lean: float, tall: float, deep: float) -> None:
    """Filters, a lamp, valves and a gauge."""
    for k in range(m.pick(0, 1, 2)):
        c = wide * (0.3 + 0.4 * k)
        m.add(BASE, rod((c, y, z[1] - 0.004), (c, y, z[1] + m.number(0.06, 0.15)), 0.05, n))
    if m.chance(0.5):
        m.add(BASE, box((0.2 * wide, 0.8 * wide), (lean + 0.02, lean + 0.1), (z[1], z[1] + 0.05)))
    for k in range(m.pick(0, 1, 2)):
        at = vec(-0.001, y, z[0] + (0.3 + 0.3 * k) * tall)
        m.add(BASE, rod(at, at - vec(0.05, 0, 0), 0.01, 8))
        dial(m, f"valve_{k}", at - vec(0.05, 0, 0), (-1, 0, 0), 0.025)
    if m.chance(0.5):
        m.add(
            BASE,
            rod((0.12, deep - 0.06, z[1]), (0.12, deep - 0.06, z[1] + 0.08), 0.008, 8),
            rod((0.12, deep - 0.08, z[1] + 0.11), (0.12, deep - 0.05, z[1] + 0.11), 0.04, n),
        )
