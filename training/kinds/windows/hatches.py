"""Tilting windows, roof hatches and framed shutters."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from shapely.geometry import Polygon

from training.kinds.joinery import alike, face, shrunk
from training.kinds.model import BASE, Model
from training.kinds.panels import OUT, glazed, hang, middle, opening, sheet
from training.kinds.solids import arch, box, cut, prism, rectangle, ring, rod, rounded, tube
from training.kinds.windows.glazing import wall


def tilt_window(m: Model) -> None:
    """Make a window that tilts inwards at its foot, with a handle that turns; or that turns about its middle."""
    wide, high, thick, width = m.number(0.6, 1.2), m.number(0.5, 1.4), m.number(0.05, 0.08), m.number(0.05, 0.08)
    gap, n, z0 = m.gap(0.6), m.sections(), m.number(0.8, 1.2)
    z, frame, how = (z0, z0 + high), m.number(0.04, 0.07), m.pick("tilt", "tilt", "middle", "upright")
    rebate = m.pick(0.0, 0.015)
    opening(m, (0, wide), (0, thick + 0.01 - rebate), z, frame)
    x, b = shrunk((0, wide), gap), shrunk(z, gap)
    y = (0.01, thick) if how != "tilt" else (rebate, thick + rebate)
    glazed(m, "sash", x, y, b, width, (m.pick(0, 0, 1), m.pick(0, 0, 1)))
    if how == "tilt":
        m.hinge("sash", (middle(x), y[1], b[0]), (-1, 0, 0), m.number(10, 40))
        for a in m.pick((), (x[0] + 0.06, x[1] - 0.06)):
            m.add(m.pick(BASE, "sash"), rod((a - 0.04, y[1] + 0.004, b[0]), (a + 0.04, y[1] + 0.004, b[0]), 0.008, 10))
    else:
        axis = (1, 0, 0) if how == "middle" else (0, 0, 1)
        m.hinge("sash", (middle(x), middle(y), middle(b)), axis, (0, m.number(60, 100)))
    side = m.pick(x[0] + width / 2, x[1] - width / 2)
    at = (side, y[1], middle(b)) if how == "tilt" else (middle(x), y[1], b[1] - width / 2)
    m.add(
        "sash", prism(rounded((at[0] - 0.015, at[0] + 0.015), (at[2] - 0.03, at[2] + 0.03), 0.014), "y", (at[1], at[1] + 0.008))
    )
    turns = m.chance(0.6)
    grip = "handle" if turns else "sash"
    m.add(
        grip,
        rod(at, (at[0], at[1] + 0.04, at[2]), 0.009, n),
        box((at[0] - 0.01, at[0] + 0.01), (at[1] + 0.03, at[1] + 0.045), (at[2] - 0.11, at[2] + 0.01)),
    )
    if turns:
        m.hinge("handle", at, (0, m.pick(-1, 1), 0), m.pick(90, 180), "sash")
    if m.chance(0.5):  # fixed lights beside it
        a = (wide + frame, wide + frame + m.number(0.4, 1.0))
        a = a if m.chance(0.5) else (wide - a[1], wide - a[0])
        opening(m, a, (0, thick), z, frame)
        glazed(m, BASE, a, (0.01, thick - 0.005), z, width)
    elif m.chance(0.5):
        wall(m, shrunk((0, wide), -frame), (-m.number(0.02, 0.2), thick + 0.01 - rebate), (z[0] - frame, z[1] + frame))


def roof_hatch(m: Model) -> None:
    """Make a hatch in a roof: a curb, a lid of metal, boards or glass, perhaps of two leaves, and a fixed ladder."""
    wide, deep, rise, curb = m.number(0.6, 1.2), m.number(0.6, 1.4), m.number(0.1, 0.35), m.number(0.04, 0.08)
    hollow, count, thick = m.chance(0.8), m.pick(1, 1, 1, 2), m.number(0.02, 0.06)
    outer = rectangle(shrunk((0, wide), -m.number(0.3, 0.8)), shrunk((0, deep), -m.number(0.3, 0.8)))
    ring_outline = rectangle((0, wide), (0, deep), curb)
    if hollow:
        m.add(
            BASE,
            prism(
                Polygon(outer.exterior.coords, [rectangle(shrunk((0, wide), curb), shrunk((0, deep), curb)).exterior.coords]),
                "z",
                (-0.2, 0),
            ),
        )
        m.add(BASE, prism(ring_outline, "z", (0, rise)))
    else:
        m.add(BASE, prism(outer, "z", (-0.1, 0)), box((0, wide), (0, deep), (0, rise)))
    over, up, how = m.pick(0.0, 0.02, 0.04), rise + abs(m.gap(0.6)), m.pick("plate", "cap", "glass", "boards", "dome")
    skirt = m.pick(0.0, 0.05, 0.08) if over and how in ("plate", "cap") else 0.0
    for k in range(count):
        part = f"lid_{k}"
        x = (-over, wide + over) if count == 1 else ((-over, wide / 2 - 0.002), (wide / 2 + 0.002, wide + over))[k]
        y, z = (-over, deep + over), (up, up + thick)
        if how == "glass":
            m.add(
                part,
                prism(rectangle(x, y, 0.06), "z", z),
                box(shrunk(x, 0.055), shrunk(y, 0.055), (up + thick / 2, up + thick / 2 + 0.008)),
            )
        elif how == "boards":
            edges = np.linspace(*y, m.pick(5, 8))
            m.add(part, *(box(x, (a, b - 0.004), z) for a, b in pairwise(edges)))
            m.add(part, *(box((a - 0.03, a + 0.03), shrunk(y, 0.05), (z[1], z[1] + 0.02)) for a in (x[0] + 0.1, x[1] - 0.1)))
        else:
            m.add(part, box(x, y, z))
            if how == "dome":
                m.add(part, prism(arch(shrunk(x, 0.05), (z[1], z[1] + 0.12), 0.11), "y", shrunk(y, 0.05)))
        if skirt:
            lip = box(x, y, (up - skirt, up))
            m.add(part, cut(lip, box(shrunk(x, over - 0.002), shrunk(y, over - 0.002), (up - 1, up + 1))))
        if count == 1:
            m.hinge(part, (wide / 2, y[1], up), (-1, 0, 0), m.number(60, 100))
            m.add(
                part,
                tube(
                    [
                        (wide / 2 - 0.08, 0.03, z[1]),
                        (wide / 2 - 0.08, 0.03, z[1] + 0.04),
                        (wide / 2 + 0.08, 0.03, z[1] + 0.04),
                        (wide / 2 + 0.08, 0.03, z[1]),
                    ],
                    0.008,
                    6,
                ),
            )
            pins = [(c * wide, y[1], up) for c in m.pick((0.2, 0.8), (0.1, 0.5, 0.9), ())]
            m.add(m.pick(part, BASE), *(rod((a - 0.04, b, c), (a + 0.04, b, c), 0.012, 10) for a, b, c in pins))
        else:
            m.hinge(part, (x[0] if k == 0 else x[1], deep / 2, up), (0, -1 if k == 0 else 1, 0), 95)
            m.add(part, ring((middle(x), deep / 2, z[1] + 0.01), (0, 0, 1), 0.04, 0.006, 12))
    if hollow and m.chance(0.5):
        a = wide / 2
        m.add(
            BASE,
            *(
                rod((a + s, deep - curb - 0.05, -1.5), (a + s, deep - curb - 0.05, rise - 0.02), 0.018, 8)
                for s in (-0.18, 0.18)
            ),
        )
        m.add(
            BASE,
            *(
                rod((a - 0.18, deep - curb - 0.05, c), (a + 0.18, deep - curb - 0.05, c), 0.012, 6)
                for c in np.arange(-1.4, rise - 0.05, 0.28)
            ),
        )
    if m.chance(0.4):  # pipes and vents on the roof
        m.add(
            BASE,
            rod((-0.2, -0.15, 0), (-0.2, -0.15, m.number(0.2, 0.5)), 0.05, 12),
            box((wide + 0.1, wide + 0.25), (0, 0.15), (0, 0.2)),
        )


def framed_shutters(m: Model) -> None:
    """Make louvred or panelled shutters shut in a frame before a window: two leaves, or four that fold in pairs."""
    half, high, thick, frame = m.number(0.3, 0.6), m.number(0.8, 1.8), m.number(0.025, 0.04), m.number(0.04, 0.08)
    count, gap, how, seed = (
        m.pick(2, 2, 4),
        abs(m.gap(0.4)),
        m.pick("louvre", "louvre", "framed", "planks", "raised"),
        int(m.rng.integers(1 << 30)),
    )
    wide, z0 = count * half, m.number(0.5, 1.0)
    z, rows = (z0, z0 + high), m.pick(1, 1, 2)
    opening(m, (0, wide), (-0.005, m.number(0.05, 0.15)), z, frame)
    glazed(m, BASE, (0, wide), (thick + 0.02, thick + 0.05), z, 0.05, (1, m.pick(0, 1, 2))) if m.chance(0.6) else m.add(
        BASE, sheet((0, wide), thick + 0.01, z)
    )
    for row in range(rows):
        b = shrunk((z[0] + row * high / rows, z[0] + (row + 1) * high / rows), gap)
        for k in range(count):
            part, x = f"leaf_{row}_{k}", shrunk((k * half, (k + 1) * half), gap / 2)
            face(alike(m, seed), part, x, (0, thick), b, how)
            left = k < count / 2
            if count == 4 and k in (1, 2):  # folds back on its neighbour
                at = x[0] - gap / 2 if left else x[1] + gap / 2
                m.hinge(part, (at, thick, b[0]), (0, 0, 1 if left else -1), 170, f"leaf_{row}_{0 if left else 3}")
            else:
                hang(alike(m, seed), part, x, (0, thick), b, "left" if left else "right", OUT, m.pick(90, 120, 170))
            if m.chance(0.3) and how == "louvre":
                m.add(part, rod((middle(x), -0.008, b[0] + 0.1), (middle(x), -0.008, b[1] - 0.1), 0.005, 6))
    if m.chance(0.5):
        wall(m, shrunk((0, wide), -frame), (0.0, m.number(0.15, 0.3)), (z[0] - frame, z[1] + frame))
