"""An object in the making: its pieces by part, its joints, the ways in which artists leave a mesh, and its URDF."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypeVar
from xml.etree import ElementTree

import numpy as np
import trimesh
from jaxtyping import Bool, Float
from trimesh import Trimesh

from anymesh.geometry.triangle_set import spread_directions
from training.kinds.solids import Point, together

BASE = "base"
Option = TypeVar("Option")
SPREAD = 48  # directions in which a face is looked at from outside


@dataclass(frozen=True, eq=False)
class Link:
    """The joint of a part, in the object's coordinates; positive opens. limits [rad or m], None: endless."""

    type: str
    parent: str
    origin: Float[np.ndarray, " 3"]
    axis: Float[np.ndarray, " 3"]
    limits: tuple[float, float] | None


@dataclass
class Model:
    """Pieces (part, solid) and the joint of every part but the base; rng decides all that varies."""

    rng: np.random.Generator
    pieces: list[tuple[str, Trimesh]] = field(default_factory=list)
    joints: dict[str, Link] = field(default_factory=dict)

    def number(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def pick(self, *options: Option) -> Option:
        return options[int(self.rng.integers(len(options)))]

    def chance(self, share: float) -> bool:
        return bool(self.rng.random() < share)

    def sections(self) -> int:
        """How finely something round is drawn."""
        return self.pick(8, 12, 16, 24)

    def gap(self, size: float) -> float:
        """Clearance of a part of a size [m]: none, a little, much, or less than none."""
        return size * self.pick(0.0, 0.002, 0.005, 0.01, -0.003)

    def add(self, part: str, *solids: Trimesh) -> None:
        self.pieces += [(part, s) for s in solids]

    def hinge(self, part: str, origin: Point, axis: Point, degrees: float | tuple[float, float], parent: str = BASE) -> None:
        low, high = degrees if isinstance(degrees, tuple) else (0.0, degrees)
        self._join(part, "revolute", parent, origin, axis, (float(np.deg2rad(low)), float(np.deg2rad(high))))

    def slide(self, part: str, axis: Point, travel: float | tuple[float, float], parent: str = BASE) -> None:
        low, high = travel if isinstance(travel, tuple) else (0.0, travel)
        self._join(part, "prismatic", parent, (0.0, 0.0, 0.0), axis, (low, high))

    def spin(self, part: str, origin: Point, axis: Point, parent: str = BASE) -> None:
        self._join(part, "continuous", parent, origin, axis, None)

    def _join(self, part: str, kind: str, parent: str, origin: Point, axis: Point, limits: tuple[float, float] | None) -> None:
        direction = np.asarray(axis, float)
        self.joints[part] = Link(kind, parent, np.asarray(origin, float), direction / np.linalg.norm(direction), limits)

    def of(self, part: str) -> Trimesh:
        """All pieces of a part as one mesh."""
        return together([s for p, s in self.pieces if p == part])


def left_by_an_artist(model: Model) -> Model:
    """The same object the way files come: turned, coarse or fine, corners shared or not, unseen faces kept or deleted."""
    yaw = model.pick(0, 90, 180, 270, model.number(0, 360))
    unseen, fine, split = model.chance(0.3), model.chance(0.3), model.chance(0.3)
    if unseen:
        model = without_hidden(model)
    turn = trimesh.transformations.rotation_matrix(np.deg2rad(yaw), [0, 0, 1])
    size = float(np.linalg.norm(np.ptp(np.concatenate([s.bounds for _, s in model.pieces]), axis=0)))
    pieces = []
    for part, solid in model.pieces:
        done = solid.copy()
        if fine:
            points, faces = trimesh.remesh.subdivide_to_size(done.vertices, done.faces, size / 25, max_iter=12)
            done = Trimesh(points, faces, process=False)
        if split:
            done = Trimesh(done.triangles.reshape(-1, 3), np.arange(3 * len(done.faces)).reshape(-1, 3), process=False)
        done.apply_transform(turn)
        pieces.append((part, done))
    joints = {
        name: Link(j.type, j.parent, turn[:3, :3] @ j.origin, turn[:3, :3] @ j.axis, j.limits)
        for name, j in model.joints.items()
    }
    return Model(model.rng, pieces, joints)


def without_hidden(model: Model) -> Model:
    """Without the faces that are not visible from outside, as models for games and houses come."""
    seen = _seen(together([s for _, s in model.pieces]))
    pieces, begin = [], 0
    for part, solid in model.pieces:
        mine = seen[begin : begin + len(solid.faces)]
        begin += len(solid.faces)
        if mine.any():
            pieces.append((part, Trimesh(solid.vertices, solid.faces[mine], process=False)))
    left = {part for part, _ in pieces}
    return Model(model.rng, pieces, model.joints) if left == {part for part, _ in model.pieces} else model


def _seen(mesh: Trimesh) -> Bool[np.ndarray, " F"]:
    """Which faces a ray reaches from outside, at their middle or near a corner."""
    middle = mesh.triangles.mean(1, keepdims=True)
    points = np.concatenate([middle, middle + 0.8 * (mesh.triangles - middle)], axis=1)
    points = points + 1e-5 * mesh.scale * mesh.face_normals[:, None]
    seen = np.zeros(len(mesh.faces), bool)
    for direction in spread_directions(SPREAD):
        todo = np.flatnonzero(~seen & (mesh.face_normals @ direction > 0.02))
        start = points[todo].reshape(-1, 3)
        if len(start):
            stopped = mesh.ray.intersects_any(start, np.repeat(direction[None], len(start), 0))
            seen[todo] = ~stopped.reshape(-1, 4).all(1)
    return seen


def write_urdf(model: Model, name: str, folder: Path, suffix: str = "obj") -> Path:
    """Writes folder/NAME.urdf with a mesh a link beside it; every link's frame lies at its joint, unturned."""
    folder.mkdir(parents=True, exist_ok=True)
    origin = {BASE: np.zeros(3), **{part: j.origin for part, j in model.joints.items()}}
    robot = ElementTree.Element("robot", name=name)
    for k, part in enumerate([BASE, *model.joints]):
        mesh = model.of(part)
        mesh.apply_translation(-origin[part])
        mesh.export(folder / f"mesh_{k}.{suffix}")
        link = ElementTree.SubElement(robot, "link", name=part)
        geometry = ElementTree.SubElement(ElementTree.SubElement(link, "visual"), "geometry")
        ElementTree.SubElement(geometry, "mesh", filename=f"mesh_{k}.{suffix}")
    for part, j in model.joints.items():
        joint = ElementTree.SubElement(robot, "joint", name=f"{part}_joint", type=j.type)
        ElementTree.SubElement(joint, "parent", link=j.parent)
        ElementTree.SubElement(joint, "child", link=part)
        ElementTree.SubElement(joint, "origin", xyz=_text(j.origin - origin[j.parent]), rpy="0 0 0")
        ElementTree.SubElement(joint, "axis", xyz=_text(j.axis))
        if j.limits is not None:
            low, high = (f"{at:.9g}" for at in j.limits)
            ElementTree.SubElement(joint, "limit", lower=low, upper=high, effort="10", velocity="1")
    ElementTree.indent(robot)
    path = folder / f"{name}.urdf"
    ElementTree.ElementTree(robot).write(path, encoding="utf-8", xml_declaration=True)
    return path


def _text(values: Sequence[float] | Float[np.ndarray, " 3"]) -> str:
    return " ".join(f"{v:.9g}" for v in values)
