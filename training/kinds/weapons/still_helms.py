"""Helmets of one mass that suits of armour of which nothing moves wear [m, Z up, front at -Y]."""

from __future__ import annotations

import numpy as np

from training.kinds.buildings.still_buildings import stage
from training.kinds.clay import curve, skin
from training.kinds.model import BASE, Model
from training.kinds.solids import ball, box, prism, ring, rod
from training.kinds.still.still_plants import UP
from training.kinds.wheels import lathe


def _crest(m: Model, z: float, r: float) -> None:
    """A crest, horns, a plume or a knob on a helmet."""
    top = m.pick("crest", "horns", "plume", "knob", "none")
    if top == "crest":
        m.add(
            BASE,
            prism(
                [
                    (np.cos(a) * c * r, z + r + 1.05 * np.sin(a) * c * r)
                    for c, span in ((1.5, (0.2, 2.6)), (0.9, (2.6, 0.2)))
                    for a in np.linspace(*span, 9)
                ],
                "x",
                (-0.08 * r, 0.08 * r),
            ),
        )
    elif top == "horns":
        m.add(
            BASE,
            *(
                skin(
                    curve((s * 0.8 * r, 0, z + 1.4 * r), (s * 1.9 * r, 0, z + 1.4 * r), (s * 1.6 * r, 0, z + 2.6 * r)),
                    np.linspace(0.22, 0.03, 6) * r,
                    8,
                )
                for s in (-1, 1)
            ),
        )
    elif top == "plume":
        m.add(
            BASE,
            skin(
                curve((0, 0, z + 1.9 * r), (0, 0.3 * r, z + 3.2 * r), (0, 1.6 * r, z + 1.6 * r)),
                [0.1 * r, 0.25 * r, 0.35 * r, 0.35 * r, 0.25 * r, 0.08 * r],
                8,
            ),
        )
    elif top == "knob":
        m.add(BASE, lathe([(0, 0), (0.2 * r, 0), (0.06 * r, 0.3 * r), (0, 0.8 * r)], 8, (0, 0, z + 1.9 * r)))


def _brim(m: Model, form: str, z: float, r: float, n: int) -> None:
    """What goes round the dome of a helmet: a brim, a neck guard with horns or a band with a nose piece."""
    if form == "kettle":
        m.add(
            BASE,
            lathe(
                [(0.8 * r, 0.1 * r), (1.6 * r, -0.2 * r), (1.6 * r, -0.15 * r), (0.8 * r, 0.25 * r), (0.8 * r, 0.1 * r)],
                n,
                (0, 0, z + 1.2 * r),
            ),
        )
    if form == "samurai":
        for k in range(m.pick(2, 3, 4)):
            band = stage(
                [((1.3 + 0.12 * k) * r, z + (0.75 - 0.25 * k) * r), ((1.0 + 0.1 * k) * r, z + (1.1 - 0.25 * k) * r)], n
            )
            m.add(BASE, band)
        m.add(
            BASE,
            *(
                skin(
                    curve(
                        (s * 0.2 * r, -0.95 * r, z + 1.5 * r),
                        (s * 1.2 * r, -1.2 * r, z + 1.8 * r),
                        (s * 0.9 * r, -1.1 * r, z + 2.8 * r),
                    ),
                    np.linspace(0.1, 0.03, 6) * r,
                    6,
                )
                for s in (-1, 1)
            ),
        )
    if form == "dome":
        m.add(
            BASE,
            ring((0, 0, z + 1.1 * r), UP, 0.95 * r, 0.08 * r, 16),
            box((-0.09 * r, 0.09 * r), (-1.12 * r, -0.8 * r), (z + 0.5 * r, z + 1.2 * r)),
        )


def helm(m: Model, z: float, r: float, n: int) -> None:
    """A helmet of one mass with crest, horns, plume, brim or slit, or a bare wooden head."""
    form = m.pick("great", "dome", "kettle", "samurai", "bare")
    m.add(BASE, rod((0, 0, z - 0.12), (0, 0, z + 0.05), 0.5 * r, n))
    if form == "great":
        m.add(BASE, lathe([(0, 0), (0.95 * r, 0), (r, 0.9 * r), (0.9 * r, 1.8 * r), (0, 2 * r)], n, (0, 0, z)))
        m.add(
            BASE,
            box((-0.75 * r, 0.75 * r), (-1.03 * r, -0.6 * r), (z + 1.05 * r, z + 1.15 * r)),
            box((-0.06 * r, 0.06 * r), (-1.08 * r, -0.6 * r), (z + 0.1 * r, z + 1.8 * r)),
        )
        m.add(
            BASE,
            *(
                rod((x * r, -1.03 * r, z + q * r), (x * r, -0.5 * r, z + q * r), 0.05 * r, 6)
                for x in (-0.4, 0.25, 0.4)
                for q in (0.4, 0.6)
            ),
        )
    else:
        m.add(BASE, ball((0, 0, z + r), (0.9 * r, r, 1.15 * r), max(n, 10)))
    _brim(m, form, z, r, n)
    _crest(m, z, r)
