"""Windmill, wind turbine and wind pump."""

from __future__ import annotations

import numpy as np

from training.kinds.model import BASE, Model
from training.kinds.solids import box, prism, rod, turned, vec
from training.kinds.wheels import beam, lathe


def windmill(m: Model) -> None:
    """A Dutch mill with lattice sails, a wind turbine or a farm pump: a cap that turns and a rotor."""
    form, n = m.pick("mill", "turbine", "pump"), m.pick(6, 8, 16, 24)
    high = {"mill": m.number(6, 10), "turbine": m.number(10, 20), "pump": m.number(5, 9)}[form]
    turns = m.chance(0.7)
    cap, r = ("cap" if turns else BASE), {"mill": 2.0, "turbine": 0.5, "pump": 0.25}[form]
    if form == "pump":
        m.add(BASE, *(beam((a, b, 0), (0.15 * a, 0.15 * b, high), 0.08, 0.08) for a in (-1, 1) for b in (-1, 1)))
        for k in range(1, 6):
            s, z = 1 - 0.85 * k / 6, high * k / 6
            m.add(
                BASE,
                *(beam((a * s, -s, z), (a * s, s, z), 0.05, 0.05) for a in (-1, 1)),
                *(beam((-s, b * s, z), (s, b * s, z), 0.05, 0.05, (0, 1, 0)) for b in (-1, 1)),
            )
        m.add(BASE, rod((0, 0, high - 0.1), (0, 0, high), 0.2, 12))
    else:
        m.add(BASE, lathe([(0, 0), (1.5 * r, 0), (0.9 * r, high), (0, high)], n))
    at = vec(0, 0, high + (0.8 * r if form == "mill" else 0.35))
    if form == "mill":
        m.add(
            cap,
            lathe([(0, 0), (1.02 * r, 0.0), (0.95 * r, 0.7 * r), (0.4 * r, 1.3 * r), (0, 1.45 * r)], n, (0, 0, high + 0.02)),
        )
        width = 0.8
        if m.chance(0.7):
            m.add("door", box((-width / 2, width / 2), (-1.5 * r - 0.06, -1.5 * r + 0.02), (0.05, 1.9)))
            m.add(
                BASE,
                *(
                    box((x - 0.08, x + 0.08), (-1.5 * r - 0.05, -1.3 * r), (0, 2.0))
                    for x in (-width / 2 - 0.1, width / 2 + 0.1)
                ),
            )
            m.hinge("door", (-width / 2, -1.5 * r - 0.06, 1), (0, 0, -1), 100)
        if m.chance(0.5):
            m.add(
                BASE, lathe([(1.2 * r, 0), (1.9 * r, 0), (1.9 * r, 0.1), (1.2 * r, 0.1), (1.2 * r, 0)], n, (0, 0, 0.35 * high))
            )
        m.add(cap, beam((0, r, at[2]), (0, 2.4 * r, 0.3 * high), 0.15, 0.15))
    else:
        m.add(
            cap,
            box((-0.3, 0.3), (-0.4, 1.2), (high, high + 0.6))
            if form == "turbine"
            else box((-0.15, 0.15), (-0.3, 0.4), (high, high + 0.5)),
        )
        if form == "pump":
            m.add(
                cap,
                rod((0, 0.3, at[2]), (0, 1.6, at[2]), 0.03, 6),
                prism([(1.4, at[2] - 0.1), (2.4, at[2] - 0.4), (2.4, at[2] + 0.4), (1.4, at[2] + 0.1)], "x", (-0.01, 0.01)),
            )
    if turns:
        m.spin(cap, (0, 0, high), (0, 0, 1))
    hub = vec(0, -{"mill": 1.25 * r, "turbine": 0.6, "pump": 0.45}[form], at[2])
    reach = {"mill": 0.75 * high, "turbine": 0.55 * high, "pump": m.number(1.0, 1.5)}[form]
    m.add(
        "rotor",
        rod(hub, hub + vec(0, abs(hub[1]) * 0.6, 0), 0.08 * r + 0.05, 10),
        rod(hub - vec(0, 0.12, 0), hub + vec(0, 0.12, 0), 0.07 * reach, 12),
    )
    count = {"mill": 4, "turbine": m.pick(2, 3), "pump": m.pick(12, 18)}[form]
    phase = m.number(0, 90)
    for k in range(count):
        if form == "mill":
            arm = [box((-0.1, 0.1), (-0.06, 0.06), (0, reach))] + [
                box((0, 0.9), (-0.02, 0.02), (z, z + 0.05)) for z in np.linspace(0.25 * reach, reach - 0.05, m.pick(6, 9))
            ]
            arm += (
                [box((x, x + 0.05), (-0.025, 0.025), (0.25 * reach, reach)) for x in (0.42, 0.87)]
                if m.chance(0.6)
                else [box((0, 0.9), (-0.01, 0.01), (0.25 * reach, reach))]
            )
        elif form == "turbine":
            arm = [
                prism(
                    [(-0.12, 0), (0.12, 0), (0.35, 0.2 * reach), (0.06, reach), (-0.06, reach), (-0.14, 0.2 * reach)],
                    "y",
                    (-0.05, 0.05),
                )
            ]
            turned(arm[0], (0, 0, 1), 12, (0, 0, 0))
        else:
            arm = [
                turned(
                    prism([(-0.05, 0.3 * reach), (0.05, 0.3 * reach), (0.14, reach), (-0.14, reach)], "y", (-0.008, 0.008)),
                    (0, 0, 1),
                    25,
                    (0, 0, 0),
                ),
                rod((0, 0, 0), (0, 0, 0.6 * reach), 0.015, 5),
            ]
        for piece in arm:
            m.add("rotor", turned(piece, (0, 1, 0), phase + 360 * k / count, (0, 0, 0)).apply_translation(hub))
    m.spin("rotor", hub, (0, -1, 0), cap)
