"""Pasta machines."""

from __future__ import annotations

import numpy as np
from shapely.geometry import Polygon

from training.kinds.kitchen_trims import dial, fluted
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, cut, moved, prism, rod, rounded, vec
from training.kinds.wheels import beam


def _side_plate(m: Model, style: str, deep: float, high: float) -> Polygon:
    """The outline of a side of a pasta machine in (y, z)."""
    half = deep / 2
    if style == "arch":
        t = np.linspace(0, np.pi, 13)
        return Polygon([(-half, 0), (half, 0), *np.c_[0.55 * half * np.cos(t), high - 0.55 * half + 0.55 * half * np.sin(t)]])
    if style == "waisted":
        return Polygon(
            [
                (-half, 0),
                (half, 0),
                (half, 0.2 * high),
                (0.5 * half, 0.35 * high),
                (0.5 * half, 0.8 * high),
                (0.25 * half, high),
                (-0.45 * half, high),
                (-0.6 * half, 0.35 * high),
                (-half, 0.2 * high),
            ]
        )
    if style == "slanted":
        return Polygon([(-half, 0), (half, 0), (0.75 * half, high), (-0.4 * half, high), (-half, 0.4 * high)])
    return rounded((-0.65 * half, 0.65 * half), (0, high), 0.02)


def _crank(m: Model, part: str, at: np.ndarray, reach: float, grip: float) -> None:
    """A crank on an axle along x: straight or cranked arm and a grip."""
    x = vec(1, 0, 0)
    down = vec(0, 0, -1) if m.chance(0.6) else vec(0, -0.7, -0.714)
    out = at + m.number(0.03, 0.05) * x
    end = out + reach * down + m.pick(0.0, 0.03) * x
    m.add(part, rod(at - 0.002 * x, out, 0.005, 10))
    m.add(part, rod(out, end, 0.005, 8) if m.chance(0.5) else beam(out, end, 0.005, 0.014))
    m.add(part, rod(end - 0.008 * x, end + grip * x, m.number(0.009, 0.013), m.sections()))
    if m.chance(0.5):
        m.add(part, ball(end + grip * x, (0.013,) * 3, 10))
    m.spin(part, at, (1, 0, 0))


def _clamp(m: Model, wide: float, deep: float) -> None:
    """A table clamp hooked into the base with a screw and its tommy bar."""
    c, low, y = m.pick(0.0, 0.25 * wide), -m.number(0.06, 0.08), -deep / 2
    shape = [
        (y - 0.012, 0.012),
        (y - 0.012, low),
        (y + 0.045, low),
        (y + 0.045, low + 0.01),
        (y - 0.004, low + 0.01),
        (y - 0.004, 0.004),
        (y + 0.03, 0.004),
        (y + 0.03, 0.012),
    ]
    at = vec(c, y + 0.032, low)
    m.add(BASE, cut(prism(shape, "x", (c - 0.012, c + 0.012)), rod(at - vec(0, 0, 0.1), at + vec(0, 0, 0.03), 0.0052, 10)))
    tip = at + vec(0, 0, m.number(0.02, 0.04))
    m.add("clamp_screw", rod(at - vec(0, 0, 0.03), tip, 0.005, 10), rod(tip - vec(0, 0, 0.004), tip, 0.012, 12))
    end = at - vec(0, 0, 0.03)
    bar = vec(0.025, 0, 0)
    if m.chance(0.6):
        m.add("clamp_screw", rod(end - bar, end + bar, 0.003, 8))
    else:
        m.add(
            "clamp_screw",
            prism(rounded((c - 0.02, c + 0.02), (at[1] - 0.005, at[1] + 0.005), 0.004), "z", (end[2] - 0.012, end[2])),
        )
    m.spin("clamp_screw", at, (0, 0, 1))


def _base_plate(m: Model, half: float, deep: float, inner: float) -> None:
    """What stands between and below the sides: a foot plate, a wooden block, a bent sheet or bars."""
    style = m.pick("plate", "block", "bars", "sheet")
    if style == "plate":
        m.add(BASE, prism(rounded((-half, half), (-0.55 * deep, 0.55 * deep), 0.01), "z", (-0.006, 0.006)))
    elif style == "block":
        m.add(BASE, box((-half - 0.015, half + 0.015), (-0.65 * deep, 0.65 * deep), (-0.012, 0.01)))
    elif style == "bars":
        m.add(BASE, *(rod((-inner, b, 0.02), (inner, b, 0.02), 0.006, 10) for b in (-0.4 * deep, 0.4 * deep)))
        m.add(BASE, box((-half, half), (-0.5 * deep, -0.1 * deep), (-0.002, 0.007)))
    else:
        m.add(BASE, box((-inner, inner), (-0.5 * deep, 0.5 * deep), (0, 0.004)))
    if m.chance(0.4):
        m.add(
            BASE,
            *(
                rod((a, b, -0.018), (a, b, 0.001), 0.01, 10)
                for a in (-0.8 * half, 0.8 * half)
                for b in (-0.4 * deep, 0.4 * deep)
            ),
        )


def _feed(m: Model, inner: float, high: float, r: float, deep: float) -> None:
    """Sheet metal round the rollers: a chute on top, a slope to the front, a housing."""
    y0 = 0.8 * r
    if m.chance(0.7):
        m.add(
            BASE,
            prism(
                [(y0 + 0.012, high - 0.02), (y0 + 0.014, high - 0.02), (y0 + 0.062, high + 0.025), (y0 + 0.06, high + 0.026)],
                "x",
                (-inner, inner),
            ),
        )
    if m.chance(0.5):
        m.add(
            BASE,
            prism(
                [
                    (-0.7 * r - 0.01, high - 0.04),
                    (-0.7 * r - 0.008, high - 0.038),
                    (-0.48 * deep, 0.02),
                    (-0.48 * deep - 0.003, 0.02),
                ],
                "x",
                (-inner, inner),
            ),
        )
    if m.chance(0.6):
        m.add(BASE, box((-inner, inner), (0.47 * deep - 0.004, 0.47 * deep), (0, 0.6 * high)))


def pasta_machine(m: Model) -> None:
    """Two rollers between side plates, a crank or a motor, a dial for the thickness; cutters in front, a clamp to the table."""
    half, deep, high = m.number(0.075, 0.11), m.number(0.11, 0.16), m.number(0.11, 0.15)
    t, style, r = m.number(0.006, 0.022), m.pick("arch", "waisted", "slanted", "box"), m.number(0.015, 0.019)
    inner, outline = half - t, _side_plate(m, style, deep, high)
    m.add(BASE, *(prism(outline, "x", s) for s in ((-half, -inner), (inner, half))))
    _base_plate(m, half, deep, inner)
    zr = high - 1.6 * r
    for k, b in enumerate((-r - 0.0005, r + 0.0005)):
        part = f"roller_{k}"
        m.add(part, rod((-inner + 0.002, b, zr), (inner - 0.002, b, zr), r, m.pick(16, 24)))
        m.add(part, rod((-inner - 0.002, b, zr), (inner + 0.002, b, zr), 0.3 * r, 8))
        m.spin(part, (0, b, zr), (1, 0, 0))
    _feed(m, inner, high, r, deep)
    if m.chance(0.55):  # cutters before the body
        y, z = -deep / 2 - 0.028, 0.6 * high
        m.add(
            BASE,
            *(
                prism(rounded((y - 0.024, deep * -0.28), (z - 0.025, z + 0.025), 0.008), "x", s)
                for s in ((-half, -half + 0.008), (half - 0.008, half))
            ),
        )
        for k, b in enumerate((z + 0.0105, z - 0.0105)):
            cutter = moved(fluted(0.0105, m.pick(12, 20), (-half + 0.009, half - 0.009)), (0, 0, 0))
            cutter.apply_transform(np.array([[0, 0, 1, 0], [1, 0, 0, y], [0, 1, 0, b], [0, 0, 0, 1.0]]))
            m.add(f"cutter_{k}", cutter)
            m.spin(f"cutter_{k}", (0, y, b), (1, 0, 0))
        m.add(BASE, box((-half + 0.008, half - 0.008), (y + 0.02, y + 0.022), (z - 0.02, z + 0.024)))
    if m.chance(0.75):
        _crank(
            m,
            "crank",
            vec(half, m.pick(-r, r), zr if m.chance(0.6) else 0.5 * high),
            m.number(0.08, 0.12),
            m.number(0.04, 0.07),
        )
    else:
        m.add(
            BASE,
            prism(rounded((-0.4 * deep, 0.4 * deep), (0.1 * high, 0.95 * high), 0.02), "x", (half, half + m.number(0.06, 0.1))),
        )
    dial(m, "thickness_dial", (-half, r, zr), (-1, 0, 0), m.number(0.016, 0.024), style=m.pick("plain", "stepped", "bar"))
    if m.chance(0.6):
        _clamp(m, half, deep)
    if m.chance(0.5):
        m.add(BASE, box((-0.03, 0.03), (-0.5 * deep - 0.001, -0.5 * deep + 0.003), (0.0, 0.02)))
