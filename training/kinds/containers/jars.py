"""Jars and bottles with lids that screw, and with wire bails."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.containers.buckets import band, circle, oblong, vessel
from training.kinds.kitchen_trims import fluted, lathe
from training.kinds.model import BASE, Model
from training.kinds.solids import prism, ring, rod, tube, vec


def _body(m: Model, outline: np.ndarray, r: float, high: float, neck: tuple[float, float], style: str, n: int) -> None:
    """A vessel of an outline (about radius r) that narrows to a round neck of (radius, height); hollow or solid."""
    shoulder = {"jar": 0.86, "bottle": m.number(0.5, 0.68), "low": 0.8}[style] * high
    wall = m.pick(0.002, 0.004)
    foot = m.pick(0.0, 0.12)
    m.add(
        BASE, vessel(outline, [(1 - foot, 0), (1, 0.05 * high + 0.5 * foot * r), (1, shoulder), (0.97, shoulder + 0.02 * high)])
    )
    base = float(np.linalg.norm(outline, axis=1).min()) * 0.97
    low = shoulder + 0.02 * high - 0.0005
    bend = m.pick("cone", "round", "round")
    rise = np.linspace(0, 1, 5 if bend == "round" else 2)
    curve = [
        (
            neck[0] + (base - neck[0]) * np.cos(0.5 * np.pi * t) if bend == "round" else base + (neck[0] - base) * t,
            low + t * (high - low),
        )
        for t in rise
    ]
    curve.append((neck[0], high + neck[1]))
    if m.chance(0.7):
        curve += [(neck[0] - wall, high + neck[1]), (neck[0] - wall, high - 0.01 * high)]
    m.add(BASE, lathe(curve, n))
    for k in range(m.pick(0, 2, 3)):
        z = high + neck[1] * (0.35 + 0.2 * k)
        m.add(BASE, ring((0, 0, z), (0.05, 0, 1), neck[0], 0.0008, n))
    if m.chance(0.4):  # a label
        a = (0.25 * high, 0.62 * high)
        m.add(BASE, vessel(outline, [(0.98, a[0]), (1.012, a[0]), (1.012, a[1]), (0.98, a[1])]))
    elif m.chance(0.4):
        m.add(BASE, vessel(outline, [(0.99, 0.7 * high), (1.03, 0.71 * high), (1.03, 0.74 * high), (0.99, 0.75 * high)]))


def _grooves(m: Model, r: float, z: tuple[float, float]) -> None:
    """Ribs round a lid for the hand, many thin or a few broad."""
    count = m.pick(12, 18, 24)
    thin = 0.9 * np.pi * r / count / m.pick(1, 2)
    for t in 2 * np.pi * np.arange(count) / count:
        at = r * vec(np.cos(t), np.sin(t), 0)
        m.add("lid", rod(at + vec(0, 0, z[0]), at + vec(0, 0, z[1]), min(thin, 0.0015), 5))


def _screw_lid(m: Model, neck: tuple[float, float], high: float, n: int) -> float:
    """A lid over a neck that turns about the upright; gives its top."""
    style, gap = m.pick("plain", "ribs", "fluted", "dome", "step", "band"), m.pick(0.0004, 0.001, 0.002)
    r, tall = neck[0] + m.number(0.0015, 0.004), neck[1] + m.pick(0.001, 0.002, 0.004)
    z = (high + m.number(0.05, 0.3) * neck[1], high + tall)
    inside = [(neck[0] + gap, z[1] - 0.0008), (neck[0] + gap, z[0])] if m.chance(0.6) else []
    if style == "fluted":
        m.add("lid", fluted(1.06 * r, m.pick(12, 18, 26), z))
    else:
        top = {
            "dome": [(0.75 * r, z[1] + 0.1 * r), (0.3 * r, z[1] + 0.16 * r)],
            "step": [(0.9 * r, z[1]), (0.88 * r, z[1] + 0.1 * r)],
        }.get(style, [(0.97 * r, z[1] + 0.001)])
        profile = [(r, z[0]), (r, z[1] - 0.001), *top]
        m.add("lid", lathe([*inside, *profile], n))
    if style == "ribs":
        _grooves(m, r, (z[0] + 0.001, z[1] - 0.001))
    elif style == "band":
        m.add("lid", ring((0, 0, z[0] + 0.0015), (0, 0, 1), r, 0.0015, n), rod((0, 0, z[1]), (0, 0, z[1] + 0.0018), 0.8 * r, n))
    m.spin("lid", (0, 0, (z[0] + z[1]) / 2), (0, 0, 1))
    return z[1] + (0.16 * r if style == "dome" else 0.1 * r if style == "step" else 0.001)


def _screwed(m: Model) -> None:
    style, n = m.pick("jar", "jar", "bottle", "bottle", "low"), m.pick(10, 16, 24, 32)
    r = m.number(0.025, 0.055) if style != "low" else m.number(0.025, 0.045)
    high = r * {"jar": m.number(1.6, 3.2), "bottle": m.number(3.0, 5.0), "low": m.number(0.6, 1.1)}[style]
    square = m.chance(0.3)
    outline = (
        oblong(2 * r, m.pick(2.0, 2.0, 1.4) * r, m.pick(0.2, 0.5), 3)
        if square
        else circle(m.pick(n, 6, 8) if m.chance(0.3) else n, r)
    )
    least = float(np.linalg.norm(outline, axis=1).min())
    wide = least * (m.number(0.3, 0.5) if style == "bottle" else m.number(0.78, 0.92))
    neck = (max(wide, 0.008), m.number(0.012, 0.02) if style != "low" else m.number(0.01, 0.016))
    _body(m, outline, r, high, neck, style, n)
    top = _screw_lid(m, neck, high, n)
    if style == "bottle" and m.chance(0.3):  # a loop for a finger, or a rubber bulb
        if m.chance(0.5):
            z, x = 0.75 * high, r
            m.add(
                BASE,
                tube(
                    [
                        (neck[0], 0, high - 0.002),
                        (x + 0.022, 0, high - 0.004),
                        (x + 0.022, 0, z - 0.02),
                        (0.95 * x, 0, 0.45 * high),
                    ],
                    0.004,
                    8,
                ),
            )
        else:
            m.add("lid", lathe([(0.8 * neck[0], top - 0.002), (0.75 * neck[0], top + 0.02), (0.4 * neck[0], top + 0.03)], n))
    elif style == "jar" and m.chance(0.15):  # a hole for a straw
        m.add("lid", tube([(0.3 * r, 0, top - 0.004), (0.32 * r, 0, top + 0.05), (0.5 * r, 0, top + 0.09)], 0.003, 8))


def _clip_jar(m: Model) -> None:
    """A jar whose lid is hinged behind on a wire and held down by a wire bail in front."""
    n, r = m.pick(12, 20, 32), m.number(0.035, 0.06)
    high, square, t = r * m.number(1.5, 3.2), m.chance(0.35), m.pick(0.003, 0.005)
    outline = oblong(2 * r, 2 * r, m.pick(0.25, 0.5), 3) if square else circle(n, r)
    rim, wire = 0.86 * r, m.pick(0.0012, 0.002)
    m.add(BASE, vessel(outline, [(0.94, 0), (1, 0.05 * high), (1, 0.82 * high), (0.9, 0.88 * high)]))
    profile = [(rim, 0.87 * high), (rim, high), (rim - t, high), (rim - t, 0.86 * high)]
    m.add(BASE, lathe(profile, max(n, 16)), ring((0, 0, 0.94 * high), (0, 0, 1), rim + wire, wire, 24))
    seal, thick = m.pick(0.001, 0.0025), m.number(0.008, 0.014)
    if seal > 0.002:
        m.add(m.pick(BASE, "lid"), band(circle(max(n, 16), rim), (0.9, 1.03), (high, high + seal)))
    z = high + seal
    m.add(
        "lid",
        lathe(
            [(1.04 * rim, z), (1.06 * rim, z + 0.4 * thick), (0.95 * rim, z + thick), (0.6 * rim, z + 1.15 * thick)], max(n, 16)
        ),
    )
    back, up = rim + 0.008, z + 0.35 * thick
    m.add("lid", ring((0, 0, up), (0, 0, 1), 1.06 * rim, wire, 24), rod((0, 1.04 * rim, up), (0, back, up - 0.004), wire, 6))
    pivot = vec(0, back, up - 0.004)
    m.add("lid", rod(pivot - vec(0.012, 0, 0), pivot + vec(0.012, 0, 0), 1.3 * wire, 8))
    for s in (-0.015, 0.015):
        m.add(BASE, tube([(s, rim, 0.94 * high), (s, back, 0.94 * high), (s, back, up - 0.003)], wire, 6))
    m.hinge("lid", pivot, (-1, 0, 0), m.pick(100, 120, 150))
    front, half = -rim - 0.004, m.number(0.28, 0.4) * r
    low, top = 0.94 * high, z + 1.05 * thick + 2 * wire
    m.add(
        BASE, *(rod((s * (half + 0.004), -0.9 * rim * 0.95, low), (s * (half + 0.004), front, low), wire, 6) for s in (-1, 1))
    )
    a, b = vec(half, front, low), vec(0.8 * half, front - 0.002, top)
    over = vec(0.6 * half, -0.78 * rim, top)
    flip = (-1, 1, 1)
    m.add(
        "bail",
        tube([a * flip, b * flip, over * flip, over, b, a], wire, 6),
        rod((-half - 0.006, front, low), (half + 0.006, front, low), wire, 6),
    )
    if m.chance(0.6):
        m.add("bail", _tongue(half, front, top, wire))
    m.hinge("bail", (0, front, low), (1, 0, 0), m.pick(100, 140))


def _tongue(half: float, y: float, z: float, wire: float) -> Trimesh:
    """A plate on a bail to push it up with."""
    return prism(
        [(y - 0.002, z - 0.004), (y - 0.008, z - 0.016), (y - 0.007, z - 0.017), (y - 0.0005, z - 0.005)],
        "x",
        (-0.8 * half - wire, 0.8 * half + wire),
    )


def _swing_top(m: Model) -> None:
    """A bottle with a stopper on a wire bail that swings to a side of its neck."""
    n, r = m.pick(12, 20, 32), m.number(0.03, 0.048)
    high, neck = r * m.number(4.2, 6.0), m.number(0.011, 0.015)
    outline = oblong(2 * r, 2 * r, 0.4, 3) if m.chance(0.3) else circle(n, r)
    body = m.number(0.45, 0.62) * high
    least = float(np.linalg.norm(outline, axis=1).min())
    m.add(BASE, vessel(outline, [(0.92, 0), (1, 0.03 * high), (1, body), (0.96, body + 0.01 * high)]))
    curve = [
        (0.96 * least, body + 0.009 * high),
        (0.75 * least, body + 0.1 * high),
        (1.2 * neck, 0.82 * high),
        (neck, 0.86 * high),
        (neck, high),
    ]
    if m.chance(0.6):
        curve += [(0.7 * neck, high), (0.7 * neck, 0.9 * high)]
    lip = [(1.0 * neck, high - 0.012), (1.25 * neck, high - 0.008), (1.25 * neck, high - 0.002), (neck, high)]
    m.add(BASE, lathe(curve, n), lathe(lip, n))
    wire, pivot = m.pick(0.001, 0.0016), vec(0, 0, high - m.number(0.026, 0.034))
    m.add(BASE, ring(pivot, (0, 0, 1), 1.0 * neck + wire, wire, 20))
    half, top = 1.25 * neck + 3 * wire, high + m.number(0.014, 0.02)
    ends = [pivot + vec(s * half, 0, 0) for s in (-1, 1)]
    m.add(
        "stopper",
        tube([ends[0], vec(-half, 0, high + 0.007), vec(0, 0, high + 0.008), vec(half, 0, high + 0.007), ends[1]], wire, 6),
    )
    m.add("stopper", *(rod(e, pivot + np.sign(e[0]) * vec(neck, 0, 0), wire, 6) for e in ends))
    m.add(
        "stopper",
        lathe([(0.95 * neck, high + 0.0005), (1.15 * neck, high + 0.004), (0.9 * neck, top - 0.004), (0.4 * neck, top)], n),
    )
    if m.chance(0.5):
        m.add("stopper", rod((0, 0, high), (0, 0, high + 0.002), 1.05 * neck, n))
    m.hinge("stopper", pivot, (m.pick(-1, 1), 0, 0), m.pick(100, 120))
    if m.chance(0.5):
        down, out = pivot[2] - 0.03, neck + 0.008
        reach = half + 2.2 * wire
        lever = [
            (-reach, 0, pivot[2]),
            (-reach, -out, pivot[2] - 0.012),
            (-0.5 * reach, -out - 0.004, down),
            (0.5 * reach, -out - 0.004, down),
            (reach, -out, pivot[2] - 0.012),
            (reach, 0, pivot[2]),
        ]
        m.add("lever", tube([vec(*p) for p in lever], wire, 6))
        m.add("lever", *(rod(pivot + vec(s * reach, 0, 0), pivot + vec(s * (half - wire), 0, 0), wire, 6) for s in (-1, 1)))
        m.hinge("lever", pivot, (-1, 0, 0), m.pick(60, 90))


def screw_jar(m: Model) -> None:
    """A jar or bottle: a lid that screws, or with a wire bail a hinged lid or a stopper that swings off."""
    m.pick(_screwed, _screwed, _screwed, _clip_jar, _swing_top)(m)
