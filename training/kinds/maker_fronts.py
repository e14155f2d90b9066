"""What a maker puts on bodies: doors, lids, buttons, dials, screens, vents."""

from __future__ import annotations

import numpy as np
from trimesh import Trimesh
from trimesh.geometry import align_vectors

from training.kinds.maker_style import FRONT, Cell, Maker, only
from training.kinds.model import BASE
from training.kinds.solids import Point, Span, box, rod, vec

AXES = {"left": (0, 0, -1), "right": (0, 0, 1), "below": (1, 0, 0), "above": (-1, 0, 0)}


def door(k: Maker, part: str, x: Span, z: Span, y: Span, side: str, pane: Cell | None = None, parent: str = BASE) -> None:
    """A door in the span y whose hinge lies at a side; its handle lies across."""
    wide, high = x[1] - x[0], z[1] - z[0]
    k.m.add(part, *k.panel(x, z, y, pane))
    upright = side in ("left", "right")
    room = 0.06 * wide if upright else 0.07 * high
    at = {
        "left": vec(x[1] - room, y[0], k.m.number(z[0] + 0.45 * high, z[0] + 0.6 * high)),
        "right": vec(x[0] + room, y[0], k.m.number(z[0] + 0.45 * high, z[0] + 0.6 * high)),
        "below": vec((x[0] + x[1]) / 2, y[0], z[1] - room),
        "above": vec((x[0] + x[1]) / 2, y[0], z[0] + room),
    }[side]
    long = k.m.number(0.15, 0.55) * high if upright else k.m.number(0.4, 0.85) * wide
    k.m.add(part, *k.handle(at, long, upright))
    edge = {"left": x[0], "right": x[1], "below": z[0], "above": z[1]}[side]
    deep = y[0] if k.m.chance(0.4) else (y[0] + y[1]) / 2
    origin = vec(edge, deep, z[0]) if upright else vec(x[0], deep, edge)
    if k.way in ("cad", "old") and upright and k.m.chance(0.6):
        r = 0.25 * (y[1] - y[0])
        for s in (0.12, 0.88):
            k.m.add(
                part,
                rod((edge, y[0] - 0.4 * r, z[0] + (s - 0.03) * high), (edge, y[0] - 0.4 * r, z[0] + (s + 0.03) * high), r, 8),
            )
        origin = vec(edge, y[0] - 0.4 * r, z[0])
    k.m.hinge(part, origin, AXES[side], k.m.pick(90, 95, 110, 120) if upright else k.m.pick(80, 88, 90), parent)


def button(
    k: Maker, part: str, at: Point, half: Span, high: float, axis: Point = FRONT, parent: str = BASE, turn: bool = False
) -> None:
    """A key that stands out of a face at `at` along an axis and is pressed against it; turn: a round one."""
    a, out = np.asarray(at, float), np.asarray(axis, float)
    if turn:
        k.m.add(part, rod(a - 0.2 * high * out, a + high * out, half[0], k.n))
    else:
        solid = k.block((-half[0], half[0]), (-half[1], half[1]), (-0.2 * high, high))
        solid.apply_transform(_standing(out))
        solid.apply_translation(a)
        k.m.add(part, solid)
    k.m.slide(part, -out, 0.6 * high, parent)


def dial(k: Maker, part: str, at: Point, r: float, high: float, axis: Point = FRONT, parent: str = BASE) -> None:
    """A knob that turns, without end or from a stop to another; perhaps with a pointer."""
    k.m.add(part, k.knob(at, axis, r, high, k.m.chance(0.5)))
    if k.m.chance(0.5):
        k.m.spin(part, at, axis, parent)
    else:
        k.m.hinge(part, at, -np.asarray(axis, float), k.m.pick(180, 270, 300), parent)


def screen(k: Maker, x: Span, z: Span, y: float) -> Trimesh:
    """A display that stands a little out of a front."""
    solid = box(x, (y - 0.002, y + 0.002), z)
    return only(solid, FRONT) if k.way == "sheet" else solid


def wires(x: Span, y: Span, z: float, count: int, r: float = 0.003) -> list[Trimesh]:
    """A rack of wires: a frame and bars from front to back."""
    bars = [rod((u, y[0], z), (u, y[1], z), r, 6) for u in np.linspace(*x, count)]
    return bars + [rod((x[0], w, z), (x[1], w, z), 1.2 * r, 6) for w in y]


def _standing(axis: Point) -> np.ndarray:
    """The turn of a key drawn upwards: for the front its second side stays upright."""
    if np.allclose(axis, FRONT):
        return np.array([[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0], [0, 0, 0, 1]], float)
    return align_vectors([0, 0, 1], np.asarray(axis, float))
