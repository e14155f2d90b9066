"""Wheels, axles, steering wheels and seats of vehicles, in one artist's ways."""

from __future__ import annotations

import numpy as np
from jaxtyping import Float
from trimesh import Trimesh

from training.kinds.model import BASE, Model
from training.kinds.solids import Point, Span, box, cut, prism, rectangle, ring, rod, turned, vec
from training.kinds.wheeler_style import softened


def tyre_look(m: Model, style: str) -> dict[str, float | str | int]:
    """What all wheels of a vehicle share."""
    way = {"low": m.pick("disc", "hub"), "sheet": m.pick("disc", "spokes"), "cad": m.pick("bolted", "spokes")}
    return {
        "way": way.get(style, m.pick("bolted", "spokes", "hub", "dish")),
        "n": {"low": m.pick(8, 10, 12), "sheet": 16}.get(style, m.pick(20, 24, 32)),
        "spokes": m.pick(3, 5, 6, 8, 10),
        "rim": m.number(0.52, 0.72),
        "lugs": m.pick(0, 0, 12, 18) if style not in ("low", "sheet") else 0,
    }


def wheel_solids(look: dict, at: Float[np.ndarray, " 3"], s: int, r: float, w: float, lugs: bool = False) -> list[Trimesh]:
    """The solids of a wheel about the x axis; its face looks to the side s."""
    n, rim, way = int(look["n"]), float(look["rim"]) * r, look["way"]
    x = vec(s, 0, 0)
    done = []
    if way in ("disc", "hub"):
        done.append(rod(at - x * w / 2, at + x * w / 2, r, n))
        if way == "hub":
            done.append(rod(at + x * w * 0.45, at + x * w * 0.54, rim, n))
    else:
        hole = rod(at - x * w, at + x * w, rim, n)
        done.append(cut(rod(at - x * w / 2, at + x * w / 2, 0.95 * r, n), hole))
        if way != "dish":
            done.append(cut(rod(at - x * 0.36 * w, at + x * 0.36 * w, r, n), rod(at - x * w, at + x * w, 0.9 * r, n)))
        done += _wheel_middle(look, at, x, rim, w, n)
    if lugs or look["lugs"]:
        done += [
            turned(
                box(
                    (at[0] - w * 0.48, at[0] + w * 0.48),
                    (at[1] - 0.05 * r, at[1] + 0.05 * r),
                    (at[2] + 0.9 * r, at[2] + 1.04 * r),
                ),
                x,
                360 * k / 16,
                at,
            )
            for k in range(16)
        ]
    return done


def _wheel_middle(
    look: dict, at: Float[np.ndarray, " 3"], x: Float[np.ndarray, " 3"], rim: float, w: float, n: int
) -> list[Trimesh]:
    hub = rod(at - x * 0.3 * w, at + x * 0.42 * w, 0.25 * rim, n)
    if look["way"] == "spokes":
        barrel = cut(rod(at - x * 0.45 * w, at + x * 0.48 * w, 1.01 * rim, n), rod(at - x * w, at + x * w, 0.9 * rim, n))
        depth = sorted((at[0] + x[0] * 0.22 * w, at[0] + x[0] * 0.36 * w))
        spoke = box((depth[0], depth[1]), (at[1] - 0.09 * rim, at[1] + 0.09 * rim), (at[2], at[2] + 0.95 * rim))
        count = int(look["spokes"])
        return [barrel, hub, *(turned(spoke.copy(), (1, 0, 0), 360 * k / count, at) for k in range(count))]
    disc = rod(at + x * 0.1 * w, at + x * 0.3 * w, 1.01 * rim, n)
    if look["way"] == "dish":
        return [disc, hub]
    bolts = [at + 0.5 * rim * vec(0, np.cos(t), np.sin(t)) for t in np.linspace(0, 2 * np.pi, 5, endpoint=False)]
    return [disc, hub, *(rod(b + x * 0.28 * w, b + x * 0.36 * w, 0.07 * rim, 6) for b in bolts)]


def wheel(m: Model, look: dict, part: str, at: Point, s: int, size: Span, parent: str = BASE, lugs: bool = False) -> None:
    """A wheel of a size (radius, width) that spins about x."""
    center = np.asarray(at, float)
    m.add(part, *wheel_solids(look, center, s, *size, lugs=lugs))
    m.spin(part, center, (1, 0, 0), parent)


def axle(m: Model, look: dict, name: str, y: float, track: float, size: Span, stub: float = 0.0) -> None:
    """Two wheels on an axle that is part of the body; stub: where the axle ends if it is in halves."""
    for s, side in ((-1, "left"), (1, "right")):
        wheel(m, look, f"wheel_{name}_{side}", (s * track, y, size[0]), s, size)
        if stub:
            m.add(BASE, rod((s * stub, y, size[0]), (s * (track - 0.2 * size[1]), y, size[0]), 0.12 * size[0], 10))
    if not stub:
        m.add(BASE, rod((-track, y, size[0]), (track, y, size[0]), 0.12 * size[0], 10))


def steering(m: Model, at: Point, lean: float, radius: float, parent: str = BASE, part: str = "steering_wheel") -> None:
    """A steering wheel on a column that leans; its driver sits behind it (+y)."""
    center = np.asarray(at, float)
    axis = vec(0, np.cos(np.deg2rad(lean)), np.sin(np.deg2rad(lean)))
    m.add(
        part,
        ring(center, axis, radius, 0.08 * radius, 16),
        rod(center - 0.3 * radius * axis, center + 0.05 * radius * axis, 0.25 * radius, 12),
    )
    for k in range(m.pick(2, 3, 4)):
        t = 2 * np.pi * k / 3 + np.pi / 2
        way = np.cos(t) * vec(1, 0, 0) + np.sin(t) * np.cross(axis, vec(1, 0, 0))
        m.add(part, rod(center, center + radius * way, 0.09 * radius, 6))
    m.add(parent, rod(center - 0.25 * radius * axis, center - 3.2 * radius * axis, 0.16 * radius, 8))
    m.spin(part, center, axis, parent)


def seat(m: Model, style: str, at: Point, wide: float = 0.48, part: str = BASE) -> None:
    """A seat that looks to -y and stands on the floor at its point."""
    x, y, z = at
    if style in ("low", "sheet"):
        m.add(part, box((x - wide / 2, x + wide / 2), (y - 0.25, y + 0.25), (z, z + 0.35)))
        m.add(part, box((x - wide / 2, x + wide / 2), (y + 0.2, y + 0.32), (z, z + 0.9)))
        return
    m.add(part, prism(softened(rectangle((y - 0.27, y + 0.25), (z + 0.2, z + 0.36)), 0.05), "x", (x - wide / 2, x + wide / 2)))
    m.add(part, box((x - 0.35 * wide, x + 0.35 * wide), (y - 0.2, y + 0.2), (z - 0.01, z + 0.22)))
    back = prism(softened(rectangle((x - wide / 2, x + wide / 2), (z + 0.25, z + 0.88)), 0.08), "y", (y + 0.2, y + 0.3))
    m.add(part, turned(back, (1, 0, 0), -8, (x, y + 0.22, z + 0.3)))
