"""Cool boxes."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh

from training.kinds.containers.cases import drop_handle
from training.kinds.joinery import shrunk
from training.kinds.kitchen_trims import dial, feet
from training.kinds.model import BASE, Model
from training.kinds.solids import Span, box, cut, loft, prism, rod, rounded, tube


def _vessel(x: Span, y: Span, z: Span, r: float, wall: float, taper: float) -> Trimesh:
    """An open tub with round corners, narrower below."""

    def outline(by: float, level: float) -> np.ndarray:
        edge = np.array(rounded(shrunk(x, by), shrunk(y, by), r, 3).exterior.coords)[:-1]
        return np.c_[edge, np.full(len(edge), level)]

    low = z[0] + wall
    return loft(np.stack([outline(taper, z[0]), outline(0, z[1]), outline(wall, z[1]), outline(taper + wall, low)]))


def cool_box(m: Model) -> None:
    """A cool box: small with a swinging bail, or a chest with end handles; the lid hinges, parts or lifts off; a drain."""
    chest = m.chance(0.5)
    wide, high = (m.number(0.55, 0.9), m.number(0.33, 0.42)) if chest else (m.number(0.28, 0.42), m.number(0.24, 0.34))
    deep, foot, wall = wide * m.number(0.5, 0.72), m.pick(0.0, 0.015), m.number(0.02, 0.03)
    x, y, r = (-wide / 2, wide / 2), (-deep / 2, deep / 2), m.number(0.02, 0.05)
    top, taper = foot + high, m.pick(0.0, 0.01, 0.02)
    m.add(BASE, _vessel(x, y, (foot, top), r, wall, taper) if m.chance(0.8) else prism(rounded(x, y, r), "z", (foot, top)))
    if foot:
        feet(m, shrunk(x, taper + 0.02), shrunk(y, taper + 0.02), foot)
    if m.chance(0.5):
        band = rounded(shrunk(x, -0.006), shrunk(y, -0.006), r).difference(rounded(shrunk(x, 0.004), shrunk(y, 0.004), r))
        m.add(BASE, prism(band, "z", (top - 0.03, top - 0.003)))
    thick = m.number(0.03, 0.06)
    how = m.pick("hinged", "hinged", "parted" if chest else "hinged", "lift")
    _cool_lid(m, x, y, (top, top + thick), r, how)
    if chest:
        still = m.chance(0.4)
        for name, s in (("handle_left", -1), ("handle_right", 1)):
            m.add(BASE, box((s * (wide / 2 - taper - 0.004), s * (wide / 2 + 0.004)), (-0.13, 0.13), (top - 0.075, top - 0.03)))
            drop_handle(m, name, s, s * (wide / 2 + 0.004), top - 0.06, 0.13, still)
    else:
        _bail(m, x, y, (top, top + thick))
    if (chest and m.chance(0.6)) or m.chance(0.2):
        _drain(m, wide / 2 - 0.9 * taper, foot + 0.035, m.pick(0.0, 0.25 * deep))
    if how != "lift":
        for k, c in enumerate(m.pick((), (0.0,), (-0.28, 0.28)) if how == "hinged" else (-0.25, 0.25)):
            lid = "lid" if how == "hinged" else ("lid_left", "lid_right")[k]
            _catch(m, f"catch_{k}", lid, c * wide, y[0] - 0.006, top + 0.4 * thick)


def _catch(m: Model, name: str, lid: str, x: float, front: float, z: float) -> None:
    """A rubber tongue that hangs from the lid over a stud on the body."""
    m.add(name, box((x - 0.015, x + 0.015), (front - 0.008, front), (z - 0.07, z)))
    m.add(name, box((x - 0.024, x + 0.024), (front - 0.01, front), (z - 0.085, z - 0.065)))
    m.add(lid, box((x - 0.025, x + 0.025), (front - 0.004, front + 0.02), (z - 0.004, z + 0.01)))
    m.add(BASE, box((x - 0.022, x + 0.022), (front, front + 0.02), (z - 0.08, z - 0.03)))
    m.hinge(name, (x, front - 0.004, z), (-1, 0, 0), m.pick(60, 90, 120), lid)


def _cool_lid(m: Model, x: Span, y: Span, z: Span, r: float, how: str) -> None:
    """One lid or two halves side by side, with a step, cup hollows or a grip; hinged at the back or lifted off."""
    g = m.pick(0.0, 0.001, 0.003)
    parts = [("lid_left", (x[0], -0.001)), ("lid_right", (0.001, x[1]))] if how == "parted" else [("lid", x)]
    style, plug, grip = m.pick("plain", "step", "cups", "grooves"), m.chance(0.5), m.chance(0.5)
    for name, a in parts:
        c, level = (a[0] + a[1]) / 2, (z[0] + g, z[1])
        solid = prism(rounded(a, y, 0.7 * r), "z", level)
        if style == "cups":
            spots = [(c + s * 0.3 * (a[1] - a[0]), t * 0.45 * y[1]) for s in (-1, 1) for t in (-1, 1)][: m.pick(2, 4)]
            solid = cut(solid, *(rod((*s, z[1] - 0.012), (*s, z[1] + 1), 0.036, 12) for s in spots))
        elif style == "grooves":
            solid = cut(
                solid,
                *(box(shrunk(a, 0.06), (b - 0.006, b + 0.006), (z[1] - 0.005, 2)) for b in np.linspace(-0.5, 0.5, 3) * y[1]),
            )
        m.add(name, solid)
        if style == "step":
            m.add(name, prism(rounded(shrunk(a, 0.025), shrunk(y, 0.025), 0.6 * r), "z", (z[1], z[1] + 0.012)))
        if plug:
            m.add(name, prism(rounded(shrunk(a, 0.034), shrunk(y, 0.034), 0.3 * r), "z", (z[0] - 0.012, level[0])))
        if grip:
            m.add(name, box((c - 0.05, c + 0.05), (y[0] - 0.012, y[0] + 0.01), (z[0] + 0.012, z[0] + 0.024)))
        if how == "lift":
            m.slide(name, (0, 0, 1), m.number(0.12, 0.25))
        else:
            m.hinge(name, (c, y[1], z[0]), (-1, 0, 0), m.pick(80, 95, 110))
            span = 0.3 * (a[1] - a[0])
            m.add(
                m.pick(name, BASE),
                *(rod((b - 0.03, y[1], z[0]), (b + 0.03, y[1], z[0]), 0.007, 10) for b in (c - span, c + span)),
            )


def _bail(m: Model, x: Span, y: Span, z: Span) -> None:
    """A handle on pivots at both ends that stands over the lid or lies behind it."""
    s, t, n = x[1] + m.number(0.008, 0.014), m.number(0.006, 0.01), m.sections()
    low = z[0] - m.number(0.03, 0.06)
    clear = float(np.hypot(y[1], z[1] + 0.012 - low)) + 1.8 * t
    m.add(BASE, *(rod((k * (x[1] - 0.02), 0, low), (k * (s + t), 0, low), 0.02, n) for k in (-1, 1)))
    if m.chance(0.6):
        up = low + clear + m.number(0.0, 0.03)
        path, grip, swing = [(-s, 0, low), (-s, 0, up), (s, 0, up), (s, 0, low)], (0, up), m.pick((-90, 90), (-70, 70), (0, 90))
    else:
        far = clear + m.number(0.0, 0.02)
        path, grip, swing = [(-s, 0, low), (-s, far, low), (s, far, low), (s, 0, low)], (far, low), m.pick((0, 90), (0, 180))
    style = m.pick("round", "round", "flat")
    m.add("bail", tube(path, t, 8 if style == "round" else 4))
    if m.chance(0.7):
        m.add("bail", rod((-0.45 * s, *grip), (0.45 * s, *grip), 1.7 * t, n))
    m.hinge("bail", (0, 0, low), (1, 0, 0), swing)


def _drain(m: Model, x: float, z: float, y: float) -> None:
    """A drain low on the right end: a boss with a cap that screws."""
    m.add(BASE, rod((x - 0.02, y, z), (x + 0.008, y, z), 0.021, 12))
    style = m.pick("wing", "ribbed", "dial")
    if style == "dial":
        dial(m, "drain_plug", (x + 0.008, y, z), (1, 0, 0), 0.016)
        return
    m.add("drain_plug", rod((x + 0.008, y, z), (x + 0.018, y, z), 0.016, m.pick(6, 8, 12)))
    if style == "wing":
        m.add("drain_plug", box((x + 0.018, x + 0.03), (y - 0.015, y + 0.015), (z - 0.003, z + 0.003)))
    m.spin("drain_plug", (x + 0.008, y, z), (1, 0, 0))
