"""Mixer taps as several artists model them: one lever on top or beside, a bridge, a bar on the wall."""

from __future__ import annotations

import numpy as np

from training.kinds.cad_style import aimed, bar, convention, knob, lathed, rounds, slab
from training.kinds.household.cad_taps import HANDLES, deck_plate, hose, post, spout, tap_handle
from training.kinds.model import BASE, Model
from training.kinds.solids import around, ball, box, ring, rod, vec


def _top_lever(m: Model, style: str, z: float, r: float, n: int) -> None:
    """A cap that turns and a lever on it that lifts."""
    two, tall = m.chance(0.6), 1.3 * r
    if two:
        m.add("cap", lathed([(0, z), (r, z), (0.95 * r, z + tall), (0, z + 1.1 * tall)], n))
        m.hinge("cap", (0, 0, z), (0, 0, 1), (-50, 50))
    parent = "cap" if two else BASE
    low = z + (1.1 * tall if two else 0.001)
    long, rise = m.number(3, 6) * r, m.number(0, 1.2) * r
    begin, end = vec(0, 0.6 * r, low + 0.25 * r), vec(0, -long, low + 0.35 * r + rise)
    if style in ("antique", "sheet") and m.chance(0.6):
        m.add(
            "lever", hose([begin, 0.5 * (begin + end), end], (0.3 * r, 0.2 * r), max(n // 2, 6)), ball(end, (0.4 * r,) * 3, 10)
        )
    else:
        m.add("lever", bar(begin, end, m.pick(0.5, 0.9, 1.5) * r, 0.35 * r))
    m.add("lever", lathed([(0, low), (0.95 * r, low), (0.85 * r, low + 0.5 * r), (0, low + 0.6 * r)], n))
    m.hinge("lever", (0, 0.4 * r, low), (-1, 0, 0), m.pick(20, 30), parent)


def _side_lever(m: Model, z: float, r: float, n: int) -> None:
    """A lever at the right that tips about the axis across."""
    m.add(BASE, rod((0.8 * r, 0, z), (1.5 * r, 0, z), 0.75 * r, n))
    at, long = vec(1.5 * r, 0, z), m.number(3, 5) * r
    m.add("lever", rod(at, at + vec(0.6 * r, 0, 0), 0.7 * r, n))
    tip = m.pick(vec(0, 0, long), vec(0.6 * long, 0, 0.8 * long), vec(0, -long, 0.2 * long))
    root = at + vec(0.35 * r, 0, 0)
    m.add(
        "lever",
        rod(root, root + tip, 0.2 * r, max(n // 2, 6))
        if m.chance(0.5)
        else bar(root, root + tip, 0.3 * r, 0.6 * r, (1, 0.1, 0)),
    )
    m.hinge("lever", at, (1, 0, 0), (-10, 45))


def _single(m: Model, style: str, r: float, n: int) -> None:
    """One hole: the spout turns on the post or comes out of it; a spray head is drawn out in some."""
    low = deck_plate(m, style, m.pick(0.0, 0.0, 0.11), 1.7 * r, n)
    tall = m.chance(0.6)
    top = m.number(0.08, 0.16)
    post(m, style, BASE, (low - 0.001, top), 1.2 * r, n)
    if not tall:
        spout(m, style, BASE, m.number(0.45, 0.6) * top, 0.8 * r, False, n, 0.15 * top)
        _top_lever(m, style, top + 0.0005, 1.15 * r, n)
        return
    part = "spout" if m.chance(0.75) else BASE
    if part == "spout":
        m.add(part, lathed([(0, top), (1.15 * r, top), (1.15 * r, top + 0.012), (0.7 * r, top + 0.02), (0, top + 0.02)], n))
        m.hinge(part, (0, 0, top), (0, 0, 1), (-m.pick(60, 90, 120), m.pick(60, 90, 120)))
    end, way = spout(m, style, part, top + 0.01, 0.75 * r, True, n)
    _side_lever(m, m.number(0.5, 0.7) * top + low, r, n)
    if m.chance(0.5):
        head = m.number(0.05, 0.09)
        profile = [(0, 0.001), (0.7 * r, 0.001), (0.85 * r, 0.6 * head), (m.pick(0.85, 1.3) * r, head), (0, head)]
        m.add("spray_head", aimed(lathed(profile, n), way, end))
        m.slide("spray_head", way, 0.12, part)
        if m.chance(0.5):
            c = np.asarray(end) + 0.5 * head * np.asarray(way) - vec(0, 0.8 * r, 0)
            m.add("spray_button", box((-0.3 * r, 0.3 * r), (c[1] - 0.003, c[1] + 0.003), (c[2] - 0.6 * r, c[2] + 0.6 * r)))
            m.slide("spray_button", (0, 1, 0), 0.002, "spray_head")
    if style in ("prop", "antique", "assembly") and m.chance(0.3):
        coil = [ring((0, 0, top + 0.02 + 0.008 * k), (0, 0, 1), 0.95 * r, 0.003, 10) for k in range(8)]
        m.add(part, *coil)


def _bridge(m: Model, style: str, r: float, n: int) -> None:
    """Two posts with a bar between them, a spout that turns on its middle, two handles."""
    spread, high, shape = m.number(0.08, 0.11), m.number(0.07, 0.12), m.pick(*HANDLES)
    for s, name in ((-1, "left"), (1, "right")):
        m.add(BASE, lathed([(0, 0), (1.9 * r, 0), (1.6 * r, 0.012), (0, 0.012)], n, (s * spread, 0, 0)))
        post(m, style, BASE, (0.01, high + 0.8 * r), 1.1 * r, n, (s * spread, 0, 0))
        tap_handle(m, style, f"handle_{name}", (s * spread, 0, high + 0.8 * r), (0, 0, 1), r, n, shape, s)
    m.add(BASE, rod((-spread, 0, high - 0.4 * r), (spread, 0, high - 0.4 * r), 0.65 * r, n))
    m.add(BASE, rod((0, 0, high - 1.3 * r), (0, 0, high + 0.8 * r), 1.1 * r, n))
    m.add("spout", rod((0, 0, high + 0.8 * r), (0, 0, high + 1.6 * r), r, n))
    spout(m, style, "spout", high + 1.2 * r, 0.75 * r, True, n)
    m.hinge("spout", (0, 0, high + 0.8 * r), (0, 0, 1), (-90, 90))


def _bar(m: Model, style: str, r: float, n: int) -> None:
    """A bar on a wall with a turning end each side, a spout or a rail on which the shower's holder slides."""
    long, out, big = m.number(0.11, 0.15), -m.number(0.05, 0.07), 1.5 * r
    m.add(
        BASE,
        slab(style, (-long, long), (out - big, out + big), (-big, big))
        if style == "hollow"
        else rod((-long, out, 0), (long, out, 0), big, n),
    )
    for s, name in ((-1, "left"), (1, "right")):
        x = s * 0.65 * long
        m.add(BASE, rod((x, 0, 0), (x, out, 0), 0.8 * r, n), rod((x, 0, 0), (x, -0.008, 0), 2 * r, n))
        m.add(f"knob_{name}", *knob(style, (s * (long + 0.001), out, 0), (s, 0, 0), big, m.number(0.03, 0.045), n))
        if style in ("assembly", "antique"):
            grips = around(rod((big, 0, 0.006), (big, 0, 0.024), 0.12 * big, 6), 12)
            m.add(f"knob_{name}", *(aimed(g, (s, 0, 0), (s * (long + 0.001), out, 0)) for g in grips))
        m.spin(f"knob_{name}", (s * (long + 0.001), out, 0), (s, 0, 0))
    if m.chance(0.5):
        path = [vec(0, out, 0.0), vec(0, 0.5 * out - 0.06, -0.02), vec(0, out - 0.09, -0.03), vec(0, out - 0.1, -0.06)]
        m.add(BASE, hose(path, (r, 0.8 * r), n, style != "sheet"))
        m.add(
            "diverter",
            rod((0, out, big - 0.002), (0, out, big + 0.02), 0.3 * r, 8),
            rod((0, out, big + 0.02), (0, out, big + 0.028), 0.7 * r, n),
        )
        m.slide("diverter", (0, 0, 1), 0.012)
        return
    tall = m.number(0.5, 0.8)
    m.add(
        BASE,
        rod((0, out, big - 0.002), (0, out, tall), 0.6 * r, n),
        rod((0, 0, tall - 0.02), (0, out, tall - 0.02), 0.6 * r, n),
    )
    m.add(BASE, rod((0, 0, tall - 0.02), (0, -0.008, tall - 0.02), 1.5 * r, n))
    z = m.number(0.5, 0.7) * tall
    m.add(
        "holder",
        rod((0, out, z - 0.02), (0, out, z + 0.02), 1.2 * r, n),
        bar((0, out, z), (0, out - 0.05, z + 0.01), 0.02, 0.016),
    )
    m.slide("holder", (0, 0, 1), (-0.6 * z, tall - 0.05 - z))
    if m.chance(0.7):
        top = vec(0, out - 0.07, z + 0.12)
        m.add("holder", hose([(0, out - 0.05, z - 0.06), (0, out - 0.055, z + 0.03), top], (0.6 * r, 0.8 * r), n))
        m.add("holder", aimed(lathed([(0, -0.012), (0.045, 0), (0.045, 0.012), (0, 0.012)], n), (0, -1, -0.5), top))


def mixer_faucet(m: Model) -> None:
    """A mixer with a lever that lifts and turns, a swivelling spout, a spray head; a bridge; a thermostatic bar."""
    style, r = convention(m), m.number(0.013, 0.022)
    n, form = rounds(m, style), m.pick("single", "single", "single", "bridge", "bar")
    {"single": _single, "bridge": _bridge, "bar": _bar}[form](m, style, r, n)
