"""Electric kettles as several artists model them: of sheet, turned, with a gooseneck, on a heating base."""

from __future__ import annotations

import numpy as np
import trimesh

from training.kinds.cad_style import band, bar, bolt, convention, knob, lathed, rounds, slab
from training.kinds.household.cad_taps import hose
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, rod, vec


def _plate(m: Model, style: str, r: float, n: int) -> float:
    """The heating base with its dial, keys or display; returns its height."""
    tall, wide = m.number(0.015, 0.03), 1.12 * r
    if m.chance(0.5):
        m.add(BASE, lathed([(0, 0), (wide, 0), (wide, 0.6 * tall), (0.95 * wide, tall), (0, tall)], n))
        return tall
    front = -wide - m.pick(0.0, 0.05)
    m.add(BASE, slab(style, (-wide, wide), (front, wide), (0, tall)))
    if front < -wide - 0.01:
        y = 0.5 * (front - r)
        if m.chance(0.5):
            m.add("dial", *knob(style, (0, y, tall - 0.001), (0, 0, 1), 0.014, 0.012, n))
            m.spin("dial", (0, y, tall), (0, 0, 1))
        else:
            for k, x in enumerate(np.linspace(-0.5, 0.5, m.pick(2, 4, 5)) * wide):
                m.add(f"button_{k}", rod((x, y, tall - 0.002), (x, y, tall + 0.0015), 0.007, n))
                m.slide(f"button_{k}", (0, 0, -1), 0.0015)
    return tall


def _body(m: Model, style: str, r: float, low: float, tall: float, n: int) -> tuple[float, float, list[tuple[float, float]]]:
    """The vessel; returns the radius and height of its mouth and its outline."""
    form = m.pick("cone", "drum", "round", "bell")
    outline = {
        "cone": [(1, 0), (1, 0.06), (0.68, 1)],
        "drum": [(0.95, 0), (1, 0.05), (1, 0.9), (0.85, 1)],
        "round": [(0.8, 0), (1, 0.2), (1.0, 0.5), (0.85, 0.85), (0.6, 1)],
        "bell": [(1, 0), (1, 0.1), (0.75, 0.5), (0.7, 0.9), (0.72, 1)],
    }[form]
    points = [(r * a, low + tall * b) for a, b in outline]
    mouth = points[-1][0]
    deep = low + 0.2 * tall
    inside = [(0.9 * mouth, points[-1][1]), (0.8 * mouth, deep), (0, deep)]
    if style == "sheet":
        m.add(BASE, lathed([(0, low), *points], n))
    elif style in ("prop", "assembly") and m.chance(0.5):
        m.add(BASE, lathed([(0, low), *points, (0, points[-1][1])], n))
    else:
        m.add(BASE, lathed([(0, low), *points, *inside], n))
    if style in ("assembly", "antique") or m.chance(0.3):
        z = low + 0.05 * tall
        m.add(BASE, band(0.9 * r, 1.02 * r, (z, z + 0.012), n))
    return mouth, points[-1][1], points


def _lid(m: Model, style: str, mouth: float, z: float, n: int) -> None:
    """A lid hung near the handle, or lifted by its knob; a button that frees it in some."""
    rise = m.number(0.006, 0.03)
    curve = [(0, z + 0.0005), (0.98 * mouth, z + 0.0005), (0.95 * mouth, z + 0.005), (0.3 * mouth, z + rise), (0, z + rise)]
    m.add("lid", lathed(curve[1:] if style == "sheet" else curve, n))
    lifts = m.chance(0.3)
    if lifts or m.chance(0.4):
        m.add(
            "lid",
            rod((0, 0, z + rise - 0.004), (0, 0, z + rise + 0.01), 0.006, 8),
            ball((0, 0, z + rise + 0.015), (0.013, 0.013, 0.009), 12),
        )
    if lifts:
        m.slide("lid", (0, 0, 1), 0.06)
        return
    back = vec(0, 0.97 * mouth, z + 0.003)
    m.add(m.pick(BASE, "lid"), rod(back - vec(0.012, 0, 0), back + vec(0.012, 0, 0), 0.0035, 8))
    m.hinge("lid", back, (-1, 0, 0), m.pick(70, 90, 100))


def electric_kettle(m: Model) -> None:
    """A vessel on a heating base with a hinged or loose lid, a switch, a button for the lid, a dial."""
    style = convention(m)
    n, r, tall = max(rounds(m, style), 8), m.number(0.06, 0.085), m.number(0.14, 0.22)
    low = _plate(m, style, r, n) - 0.0005
    mouth, top, points = _body(m, style, r, low, tall, n)
    _lid(m, style, mouth, top, n)
    at = [np.interp(f * tall + low, [p[1] for p in points], [p[0] for p in points]) for f in (0.15, 0.25, 0.8, 0.9)]
    if m.chance(0.35):
        goose = [
            (0, -0.95 * at[1], low + 0.25 * tall),
            (0, -1.5 * r, low + 0.3 * tall),
            (0, -1.6 * r, low + 0.7 * tall),
            (0, -2.1 * r, low + 0.95 * tall),
        ]
        m.add(BASE, hose(goose, (0.013, 0.008, 0.007), max(n // 2, 6), style != "sheet"))
    else:
        reach = -max(1.35 * mouth, 1.2 * at[2])
        lip = np.array([[(s * 0.5 * mouth, -0.8 * mouth, top - 0.002), (0, reach, top - 0.002)] for s in (-1, 1)])
        beak = [lip[0, 0], lip[1, 0], lip[0, 1], vec(0, -0.9 * at[2], low + 0.6 * tall)]
        m.add(BASE, trimesh.convex.convex_hull(np.array(beak)))
    out = max(r, at[3]) + m.number(0.03, 0.045)
    form = m.pick("bow", "bow", "open") if style != "antique" else "bow"
    thick = m.number(0.009, 0.013)
    end = (0, 0.92 * at[3], low + 0.9 * tall)
    if form == "open":
        grip = [end, (0, out, low + 0.93 * tall), (0, out + 0.01, low + 0.6 * tall), (0, out, low + 0.3 * tall)]
    else:
        grip = [end, (0, out, low + 0.9 * tall), (0, out, low + 0.25 * tall), (0, 0.92 * at[0], low + 0.15 * tall)]
    m.add(BASE, hose(grip, (thick, 0.85 * thick, thick), 4 if style in ("prop", "hollow") else max(n // 2, 8)))
    if style == "assembly":
        m.add(BASE, *(b for z in (0.25, 0.8) for b in bolt((0, out + 0.8 * thick, low + z * tall), (0, 1, 0), 0.003)))
    _switches(m, form, r, low, tall, grip, thick)


def _switches(m: Model, form: str, r: float, low: float, tall: float, grip: list[tuple[float, ...]], thick: float) -> None:
    """A rocker at the foot of the handle, a key on top of the grip that frees the lid, a gauge."""
    if m.chance(0.7):
        y, z = 1.0 * r, low + 0.06 * tall
        m.add(BASE, slab("prop", (-0.014, 0.014), (y - 0.015, y + 0.012), (z - 0.008, z + 0.004)))
        lever = bar((0, y + 0.004, z + 0.002), (0, y + 0.026, z + 0.008), 0.018, 0.005)
        m.add("switch", lever)
        m.hinge("switch", (0, y + 0.006, z + 0.003), (-1, 0, 0), m.pick((-20, 0), (-25, 5)))
    if form == "bow" and "lid" in m.joints and m.joints["lid"].type == "revolute" and m.chance(0.6):
        _, y, z = grip[1]
        m.add("lid_button", slab("prop", (-0.006, 0.006), (y - 0.012, y + 0.004), (z + 0.4 * thick, z + thick + 0.003)))
        m.slide("lid_button", (0, 0, -1), 0.003)
    if m.chance(0.4):
        m.add(BASE, *(box((s * 0.99 * r, s * 0.6 * r), (-0.006, 0.006), (low + 0.1 * tall, low + 0.2 * tall)) for s in (-1, 1)))
