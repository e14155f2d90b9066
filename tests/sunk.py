"""Closed bodies with fronts sunk into them, as low-poly packs are modelled: boxes, slabs and cylinders within solids [m, Z up].

The front is at -Y. Each object is a scene (part name -> pieces, the base first) and how its parts truly move.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from assets import box, mesh_of
from scenes import Piece, Scene

from anymesh.types import Joint, JointType, Mesh, Node, Part, Segmentation

OUT = np.array([0.0, -1.0, 0.0])


@dataclass(frozen=True)
class Sunk:
    """A scene and the motion of each of its parts: "out", "door" (about an upright line), "flap" (a level one) or "turn"."""

    scene: Scene
    moves: dict[str, str]

    def mesh(self, names: dict[str, str] | None = None, *, bare: bool = False) -> tuple[Mesh, Segmentation]:
        """Return the mesh and its true parts.

        names: of the nodes, by part; without them all is one node. bare: without the faces that lie within other pieces.
        """
        pieces = [p for some in self.scene.values() for p in some]
        part = np.repeat(np.arange(len(self.scene)), [len(some) for some in self.scene.values()])
        pieces = [_without_hidden(k, pieces) for k in range(len(pieces))] if bare else pieces
        mesh, piece = mesh_of(pieces)
        if names is not None:
            nodes = tuple(Node(names.get(name, name)) for name in self.scene)
            mesh = replace(mesh, nodes=nodes, face_node=part[piece])
        return mesh, Segmentation(part[piece], tuple(Part(name, "part") for name in self.scene))

    def is_right(self, part: str, joint: Joint) -> bool:
        """Return whether a joint moves a part as it truly moves, and to the front."""
        moves, along = self.moves[part], np.abs(joint.axis)
        if moves == "out":
            return joint.type is JointType.PRISMATIC and float(joint.axis @ OUT) > 0.98 and joint.limits[1] > 0.01
        if moves == "turn":
            return joint.type in (JointType.CONTINUOUS, JointType.REVOLUTE) and along[1] > 0.98
        if joint.type is not JointType.REVOLUTE or along[2 if moves == "door" else 0] < 0.98:
            return False
        corners = np.concatenate([v for v, _ in self.scene[part]])
        opens = np.cross(joint.axis, corners.mean(0) - joint.origin) @ OUT
        return bool(opens > 0 and joint.limits[1] > 0.5)


def _without_hidden(k: int, pieces: list[Piece]) -> Piece:
    """Return a piece without its faces of which all corners lie in the bounds of another piece, or on them."""
    v, f = pieces[k]
    hidden = np.zeros(len(f), bool)
    for n, (other, _) in enumerate(pieces):
        inside = ((v >= other.min(0) - 1e-9) & (v <= other.max(0) + 1e-9)).all(1)
        hidden |= inside[f].all(1) & (n != k)
    return v, f[~hidden]


def cylinder(radius: float, ends: tuple[float, float], x: float, z: float, axis: int = 1, sides: int = 12) -> Piece:
    """Return a closed prism along an axis (y, or x for 0), about x (or y) and z."""
    k, n = np.arange(sides), (np.arange(sides) + 1) % sides
    angle = k * 2 * np.pi / sides
    ring = np.c_[np.sin(angle), np.zeros(sides), np.cos(angle)] * radius
    v = np.concatenate([ring + np.array([x, e, z]) for e in ends] + [[(x, e, z)] for e in ends])
    a, b = np.full(sides, 2 * sides), np.full(sides, 2 * sides + 1)
    f = np.concatenate([np.c_[k, n, n + sides], np.c_[k, n + sides, k + sides], np.c_[a, n, k], np.c_[b, k + sides, n + sides]])
    return (v, f) if axis == 1 else (v[:, [1, 0, 2]], f[:, ::-1])


def pull(handle: str, x: tuple[float, float], z: tuple[float, float], y: float) -> list[Piece]:
    """Return the handle of a front that ends at y, "" for none: a knob or a bar that is sunk into it, at its middle."""
    cx, cz, w = sum(x) / 2, sum(z) / 2, x[1] - x[0]
    if handle == "knob":
        r = 0.12 * min(w, z[1] - z[0])
        return [box((cx - r, y - 0.03, cz - r), (cx + r, y + 0.005, cz + r))]
    if handle == "bar":
        return [box((cx - w / 5, y - 0.03, cz - 0.01), (cx + w / 5, y + 0.003, cz + 0.01))]
    return []


def chest(size=(0.8, 0.45, 0.9), grid=(3, 1), sunk=0.05, proud=0.02, handle="knob", gap=0.03, extra="") -> Sunk:
    """Return a solid case with drawers that reach `sunk` into it and stand `proud` before it.

    grid: rows and columns; extra: words "legs" and "top", of which the case has what they say.
    """
    (w, d, h), (rows, columns) = size, grid
    base = [box((0, 0, 0), size)]
    if "top" in extra:
        base += [box((-0.03, -0.04, h), (w + 0.03, d, h + 0.05))]
    if "legs" in extra:
        base += [box((x, y, -0.2), (x + 0.05, y + 0.05, 0.05)) for x in (0.02, w - 0.07) for y in (0.02, d - 0.07)]
    scene: Scene = {"base": base}
    for r in range(rows):
        for c in range(columns):
            x = (gap + c * (w - gap) / columns, (c + 1) * (w - gap) / columns)
            z = (gap + r * (h - gap) / rows, (r + 1) * (h - gap) / rows)
            scene[f"drawer_{r}{c}"] = [box((x[0], -proud, z[0]), (x[1], sunk, z[1])), *pull(handle, x, z, -proud)]
    return Sunk(scene, {name: "out" for name in scene if name != "base"})


def cupboard(size=(0.8, 0.4, 1.2), doors=2, sunk=0.01, proud=0.01, handle="bar", gap=0.03) -> Sunk:
    """Return a solid case with upright doors of which a part lies in it."""
    w, _, h = size
    scene: Scene = {"base": [box((0, 0, 0), size)]}
    for c in range(doors):
        x = (gap + c * (w - gap) / doors, (c + 1) * (w - gap) / doors)
        grip = []
        if handle:
            at = x[1] - 0.06 if doors == 1 or c == 0 else x[0] + 0.05
            tall = 0.05 if handle == "knob" else 0.2
            grip = [box((at, -proud - 0.03, h / 2 - tall / 2), (at + 0.015, -proud + 0.003, h / 2 + tall / 2))]
        scene[f"door_{c}"] = [box((x[0], -proud, gap), (x[1], sunk, h - gap)), *grip]
    return Sunk(scene, {name: "door" for name in scene if name != "base"})


def oven(size=(0.6, 0.6, 0.85), sunk=0.02, proud=0.015, knobs=4, knob_sunk=0.02) -> Sunk:
    """Return a solid stove with a flap and knobs that are sunk into it."""
    w, _, h = size
    scene: Scene = {"base": [box((0, 0, 0), size)]}
    bar = box((0.1 * w, -proud - 0.04, 0.66 * h), (0.9 * w, -proud + 0.003, 0.69 * h))
    scene["flap"] = [box((0.06, -proud, 0.12 * h), (w - 0.06, sunk, 0.72 * h)), bar]
    for k in range(knobs):
        x = w * (k + 1) / (knobs + 1)
        scene[f"knob_{k}"] = [cylinder(0.025, (-0.03, knob_sunk), x, 0.87 * h)]
    return Sunk(scene, {"flap": "flap", **{f"knob_{k}": "turn" for k in range(knobs)}})


def mixed(size=(1.0, 0.5, 0.9), sunk=0.03, proud=0.02, handle="knob") -> Sunk:
    """Return a solid sideboard with two drawers above two doors."""
    top = chest((size[0], size[1], size[2]), (3, 2), sunk, proud, handle)
    doors = cupboard((size[0], size[1], 0.6 * size[2]), 2, sunk, proud, handle)
    scene = {"base": top.scene["base"], **{k: v for k, v in top.scene.items() if k.startswith("drawer_2")}}
    scene |= {k: v for k, v in doors.scene.items() if k != "base"}
    return Sunk(scene, {k: m for k, m in (top.moves | doors.moves).items() if k in scene})


def cart(size=(1.0, 0.5, 0.3), radius=0.12, width=0.06, axle="") -> Sunk:
    """Return a solid body with wheels at its sides (along y): sunk into them, or on axles that are stuck into it."""
    w, d, _ = size
    scene: Scene = {"base": [box((0, 0, 0), size)]}
    for k, (x, side) in enumerate([(0.2 * w, -1), (0.8 * w, -1), (0.2 * w, 1), (0.8 * w, 1)]):
        edge = 0.0 if side < 0 else d
        inner, outer = (0.03, -width + 0.03) if not axle else (-0.02, -0.02 - width)
        pieces = [cylinder(radius, tuple(sorted(edge - side * v for v in (inner, outer))), x, 0.0, sides=16)]
        if axle:
            pieces += [cylinder(0.02, tuple(sorted(edge - side * v for v in (0.06, -0.03))), x, 0.0, sides=8)]
        scene[f"wheel_{k}"] = pieces
    return Sunk(scene, {name: "turn" for name in scene if name != "base"})


def objects() -> dict[str, Sunk]:
    """Return objects in several proportions, with and without handles."""
    make: dict[str, Callable[[], Sunk]] = {
        "chest": lambda: chest(),
        "chest plain": lambda: chest(handle=""),
        "chest bar": lambda: chest(handle="bar", sunk=0.03),
        "chest deep": lambda: chest(sunk=0.38),
        "chest deep plain": lambda: chest(sunk=0.38, handle=""),
        "chest low": lambda: chest((1.4, 0.45, 0.7), (3, 2), 0.04, 0.015),
        "chest low plain": lambda: chest((1.4, 0.45, 0.7), (3, 2), 0.04, 0.015, ""),
        "chest thin": lambda: chest(sunk=0.005, proud=0.01),
        "nightstand": lambda: chest((0.45, 0.4, 0.5), (2, 1), 0.02, 0.01, extra="legs"),
        "nightstand plain": lambda: chest((0.45, 0.4, 0.5), (2, 1), 0.1, 0.01, "", extra="legs"),
        "nightstand one": lambda: chest((0.45, 0.4, 0.3), (1, 1), 0.05, 0.01, extra="legs"),
        "topped": lambda: chest((0.9, 0.45, 0.5), (2, 2), 0.03, 0.02, extra="legs, top"),
        "topped plain": lambda: chest((0.5, 0.45, 0.5), (2, 1), 0.03, 0.02, "", extra="legs, top"),
        "topped close": lambda: chest((0.9, 0.45, 0.5), (2, 2), 0.03, 0.02, gap=0.004, extra="legs, top"),
        "files": lambda: chest((0.45, 0.6, 1.3), (4, 1), 0.06, 0.02, "bar"),
        "cupboard": lambda: cupboard(),
        "cupboard plain": lambda: cupboard(handle=""),
        "cupboard one": lambda: cupboard((0.5, 0.4, 0.8), 1, 0.02, 0.02, "knob"),
        "cupboard wide": lambda: cupboard((1.0, 0.5, 0.8), 2, 0.03, 0.02, "knob"),
        "wardrobe": lambda: cupboard((1.2, 0.6, 2.0), 2, 0.04, 0.02),
        "fridge": lambda: cupboard((0.7, 0.7, 1.8), 1, 0.05, 0.05),
        "oven": lambda: oven(),
        "oven deep": lambda: oven(sunk=0.06, knobs=5, knob_sunk=0.05),
        "dishwasher": lambda: oven(knobs=0),
        "sideboard": lambda: mixed(),
        "sideboard plain": lambda: mixed(handle=""),
        "cart": lambda: cart(),
        "cart axles": lambda: cart(axle="yes"),
    }
    return {name: of() for name, of in make.items()}
