"""Lighters as several artists model them: with a flip top, of plastic with a lever, for candles, for the table."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.cad_style import around_y, band, bar, bevelled, convention, gear_plate, lathed, open_box, rounds, slab
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, ball, box, cut, loft, prism, rod, rounded, vec


def _wheel(m: Model, style: str, parent: str, x: float, z: float, r: float, half: float, n: int) -> None:
    """A toothed striker about y."""
    wheel = [gear_plate(r, 10 if style == "prop" else 18, (-half, half))]
    if style in ("assembly", "antique", "product"):
        wheel = [gear_plate(r, 20, (-0.5 * half, 0.5 * half))]
        wheel += [rod((0, 0, s * 0.5 * half), (0, 0, s * half), 0.9 * r, n) for s in (-1, 1)]
    m.add("wheel", *around_y(wheel, (x, 0, z)))
    m.add(parent, rod((x, -1.3 * half, z), (x, 1.3 * half, z), 0.2 * r, 8))
    m.spin("wheel", (x, 0, z), (0, 1, 0), parent)


def _case(style: str, x: Span, y: Span, z: Span, bare: str) -> Trimesh:
    """A case with round upright edges, hollow at one end."""
    if style == "sheet":
        return open_box(x, y, z, bare)
    outline = rounded(
        x, y, 0.0025 if style in ("prop", "hollow", "assembly") else 0.28 * (y[1] - y[0]), 2 if style == "prop" else 5
    )
    hollow = prism(outline.buffer(-0.0008), "z", (z[0] + 0.001, 1) if bare == "+z" else (-1, z[1] - 0.001))
    return cut(prism(outline, "z", z), hollow)


def _flip_top(m: Model, style: str, n: int) -> None:
    """A case whose top swings aside; an insert with a chimney, a wheel and a cam; or two electrodes and a button."""
    w, d, tall = m.number(0.017, 0.021), m.number(0.005, 0.008), m.number(0.05, 0.062)
    split = tall * m.number(0.6, 0.68)
    m.add(BASE, _case(style, (-w, w), (-d, d), (0, split), "+z"))
    m.add("lid", _case(style, (-w, w), (-d, d), (split + 0.0003, tall), "-z"))
    if style in ("antique", "assembly") and m.chance(0.7):
        m.add(
            BASE, *(box((-0.8 * w, 0.8 * w), (-d - 0.0006, -d + 0.0003), (split * f, split * f + 0.002)) for f in (0.1, 0.85))
        )
        m.add(BASE, bevelled((-0.35 * w, 0.35 * w), (-d - 0.001, -d + 0.0003), (0.35 * split, 0.65 * split), 0.0005))
    pin = vec(-w, 0, split)
    for k, y in enumerate(np.linspace(-0.45 * d, 0.45 * d, 6)[:-1]):
        m.add("lid" if k % 2 else BASE, rod((-w, y, split), (-w, y + 0.17 * d, split), 0.0012, 8))
    m.hinge("lid", pin, (0, -1, 0), m.pick(110, 135, 170))
    inner = (-w + 0.0015, w - 0.0015), (-d + 0.0012, d - 0.0012)
    m.add(BASE, slab("prop", *inner, (0.1 * split if style == "assembly" else split - 0.006, split + 0.0015)))
    if m.chance(0.25):
        m.add(
            BASE,
            *(rod((x, y, split), (x, y, split + 0.005), 0.0012, 8) for x in (-0.3 * w, 0.3 * w) for y in (-0.4 * d, 0.4 * d)),
        )
        z, front = 0.7 * split, -d
        m.add("button", *around_y([rod((0, 0, -0.001), (0, 0, 0.001), 0.003, n)], (0, front, z)))
        m.slide("button", (0, 1, 0), 0.001)
        return
    chimney = box((-0.35 * w, 0.4 * w), (-0.7 * d, 0.7 * d), (split + 0.001, split + 0.012))
    holes = [rod((x * w, -1, split + z), (x * w, 1, split + z), 0.0012, 8) for x in (-0.15, 0.2) for z in (0.004, 0.0085)]
    m.add(BASE, chimney if style in ("prop", "sheet") else cut(chimney, *holes))
    x, r = 0.4 * w + 0.0048, 0.0038
    m.add(BASE, *(box((0.38 * w, x + 0.001), (s * 0.45 * d, s * 0.62 * d), (split + 0.001, split + 0.009)) for s in (-1, 1)))
    _wheel(m, style, BASE, x, split + 0.0075, r, 0.4 * d, n)
    if m.chance(0.5):
        a = vec(-0.4 * w - 0.002, 0, split + 0.003)
        m.add(
            "cam",
            rod(a - vec(0, 0.3 * d, 0), a + vec(0, 0.3 * d, 0), 0.0018, 10),
            bar(a, a + vec(-0.3 * w, 0, 0.004), 0.5 * d, 0.001, (0, 1, 0)),
        )
        m.hinge("cam", a, (0, 1, 0), (-20, 35))


def _gas(m: Model, style: str, n: int) -> None:
    """A tank with a hood, a wheel, a lever pressed with the thumb, a slide for the flame."""
    w, d, tall = m.number(0.011, 0.014), m.number(0.005, 0.0075), m.number(0.055, 0.07)
    t = np.linspace(0, 2 * np.pi, max(n, 8), endpoint=False)
    power = m.pick(1.0, 0.6)
    rim = np.c_[w * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** power, d * np.sign(np.sin(t)) * np.abs(np.sin(t)) ** power]
    levels = [(0.9, 0), (1.0, 0.003), (1.0, tall)] if style != "prop" else [(1.0, 0), (1.0, tall)]
    m.add(BASE, loft(np.array([np.c_[k * rim, np.full(len(rim), z)] for k, z in levels]), style != "sheet"))
    m.add(BASE, slab("prop", (-0.9 * w, 0.8 * w), (-0.8 * d, 0.8 * d), (tall - 0.001, tall + 0.001)))
    high = tall + 0.012
    hood = [(-0.9 * w, tall), (0.1 * w, tall), (0.15 * w, high), (-0.7 * w, high)]
    if style in ("prop", "product"):
        m.add(BASE, prism(hood, "y", (-0.8 * d, 0.8 * d)))
    else:
        m.add(BASE, *(prism(hood, "y", (s * 0.7 * d, s * 0.8 * d)) for s in (-1, 1)))
        m.add(
            BASE,
            bar((-0.87 * w, 0, tall), (-0.68 * w, 0, high), 1.5 * d, 0.0006, (0, 1, 0)),
            rod((-0.35 * w, 0, tall), (-0.35 * w, 0, high - 0.003), 0.001, 8),
        )
    x, z, r = 0.3 * w + 0.0018, tall + 0.0062, 0.0036
    m.add(BASE, *(box((0.0, x + 0.001), (s * 0.62 * d, s * 0.78 * d), (tall, z + 0.001)) for s in (-1, 1)))
    _wheel(m, style, BASE, x, z, r, 0.5 * d, n)
    lever = [(x + 0.0005, tall + 0.0012), (1.02 * w, tall + 0.0012), (1.04 * w, tall + 0.0042), (x + 0.0033, tall + 0.0032)]
    m.add("lever", prism(lever, "y", (-0.55 * d, 0.55 * d)))
    if m.chance(0.5):
        m.hinge("lever", (x + 0.0005, 0, tall + 0.0015), (0, 1, 0), 12)
    else:
        m.slide("lever", (0, 0, -1), 0.002)
    if m.chance(0.5):
        m.add("flame_slide", box((-0.3 * w, -0.05 * w), (-0.85 * d - 0.001, -0.7 * d), (tall + 0.002, tall + 0.004)))
        m.slide("flame_slide", (1, 0, 0), (-0.002, 0.002))


def _candle(m: Model, style: str, n: int) -> None:
    """A long nozzle on a grip with a trigger, a catch and a window."""
    grip, h, d, reach = m.number(0.1, 0.13), m.number(0.022, 0.03), m.number(0.007, 0.01), m.number(0.08, 0.16)
    hole = rounded((0.5 * grip, 0.75 * grip), (0.0, 0.75 * h), 0.006)
    outline = (
        rounded((0, grip), (0, h), 0.4 * h).union(rounded((0.4 * grip, 0.95 * grip), (-0.3 * h, h), 0.3 * h)).difference(hole)
    )
    if style == "hollow":
        outline = outline.buffer(0.002).buffer(-0.002)
    m.add(BASE, prism(outline, "y", (-d, d)))
    if style in ("assembly", "product", "antique"):
        m.add(BASE, *(prism(outline.buffer(-0.0015), "y", (s * d, s * (d + 0.001))) for s in (-1, 1)))
    z = 0.82 * h
    tip = vec(grip + reach, 0, z)
    m.add(BASE, rod((grip - 0.006, 0, z), tip, 0.0035, n), rod((grip - 0.003, 0, z), (grip + 0.008, 0, z), 0.005, n))
    m.add(BASE, rod(tip - vec(0.012, 0, 0), tip + vec(0.001, 0, 0), 0.0042, n))
    trigger = [
        (0.69 * grip, 0.1 * h),
        (0.77 * grip, 0.05 * h),
        (0.77 * grip, 0.72 * h),
        (0.69 * grip, 0.72 * h),
        (0.67 * grip, 0.4 * h),
    ]
    m.add("trigger", prism(trigger, "y", (-0.6 * d, 0.6 * d)))
    if m.chance(0.6):
        m.slide("trigger", (-1, 0, 0), 0.01)
    else:
        m.hinge("trigger", (0.73 * grip, 0, 0.72 * h), (0, 1, 0), 15)
    if m.chance(0.6):
        m.add("catch", bevelled((0.55 * grip, 0.65 * grip), (-0.4 * d, 0.4 * d), (h - 0.001, h + 0.003), 0.0008))
        m.slide("catch", (1, 0, 0), 0.008)
    if m.chance(0.5):
        m.add(BASE, *(box((0.12 * grip, 0.4 * grip), (s * d, s * (d + 0.0012)), (0.35 * h, 0.6 * h)) for s in (-1, 1)))


def _table(m: Model, style: str, n: int) -> None:
    """A heavy turned body with a cap that swings off the wick, a wheel and a lever for the thumb."""
    r, tall = m.number(0.025, 0.04), m.number(0.04, 0.07)
    shape = [(0, 0), (0.8, 0), (0.85, 0.08), (0.5, 0.2), (1.0, 0.6), (0.7, 0.95), (0.4, 1.0), (0, 1.0)]
    if style in ("hollow", "prop", "assembly"):
        m.add(BASE, slab("prop", (-r, r), (-0.7 * r, 0.7 * r), (0, tall)))
    else:
        m.add(BASE, lathed([(r * a, tall * b) for a, b in shape], n))
    m.add(BASE, rod((0, 0, tall - 0.001), (0, 0, tall + 0.008), 0.38 * r, n), rod((0, 0, tall), (0, 0, tall + 0.013), 0.003, 8))
    x, z = 0.38 * r + 0.003, tall + 0.008
    m.add(BASE, *(box((0.25 * r, x + 0.001), (s * 0.0032, s * 0.0045), (tall - 0.001, z + 0.001)) for s in (-1, 1)))
    _wheel(m, style, BASE, x, z, 0.0042, 0.0028, n)
    hinge = vec(-0.4 * r - 0.001, 0, tall + 0.009)
    m.add("cap", lathed([(0, 0.0133), (0.008, 0.0133), (0.008, 0.02), (0.003, 0.023), (0, 0.023)], n, (0, 0, tall)))
    m.add(
        "cap",
        bar(hinge, vec(-0.002, 0, tall + 0.016), 0.005, 0.002, (0, 1, 0)),
        rod(hinge - vec(0, 0.004, 0), hinge + vec(0, 0.004, 0), 0.0018, 8),
    )
    m.add(
        BASE, *(box((hinge[0] - 0.002, -0.3 * r), (s * 0.0042, s * 0.0055), (tall + 0.002, hinge[2] + 0.0015)) for s in (-1, 1))
    )
    m.hinge("cap", hinge, (0, -1, 0), m.pick(70, 100))
    if style == "antique" or m.chance(0.4):
        m.add(
            BASE,
            *(ball((0.75 * r * np.cos(t), 0.6 * r * np.sin(t), 0), (0.005, 0.005, 0.005), 8) for t in (0.7, 2.4, 3.9, 5.5)),
        )
        m.add(BASE, band(0.3 * r, 0.42 * r, (tall - 0.002, tall + 0.002), max(n, 12)))


def gas_lighter(m: Model) -> None:
    """A lighter with a flip top, a plain one with a lever, a long one with a trigger, or one for the table."""
    style = convention(m)
    m.pick(_flip_top, _flip_top, _gas, _gas, _candle, _table)(m, style, rounds(m, style))
