"""Meshes that a robot description refers to, and errors of those that could not be read."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from jaxtyping import Float

from anymesh.checking.engines.locate import find_file
from anymesh.checking.engines.robot import Geometry, Robot, shape_triangles
from anymesh.errors import InputError
from anymesh.formats.in_metres import read_in_metres
from anymesh.types import Brief, Mesh


@dataclass(frozen=True, eq=False)
class Solid(Brief):
    """One shape of a link, in the link frame. shown: its file or its kind; warnings: of its reader."""

    shown: str
    triangles: Float[np.ndarray, "F 3 3"]
    mesh: Mesh | None = None
    warnings: tuple[str, ...] = ()

    @property
    def bounds(self) -> Float[np.ndarray, "2 3"]:
        points = self.triangles.reshape(-1, 3)
        return np.array([points.min(0), points.max(0)])


@dataclass(frozen=True, eq=False)
class Content:
    """A robot with the shapes of its links. missing, unread: (link, file or error) of files that are missing or unusable."""

    robot: Robot
    visuals: Mapping[str, tuple[Solid, ...]]
    collisions: Mapping[str, tuple[Solid, ...]]
    missing: tuple[tuple[str, str], ...] = ()
    unread: tuple[tuple[str, str], ...] = ()

    @cached_property
    def places(self) -> dict[str, Float[np.ndarray, "4 4"]]:
        """Poses of the links at rest, in the root's frame."""
        return self.robot.placements({})

    def shown(self, link: str) -> Float[np.ndarray, "F 3 3"]:
        """Return the visible surface of a link in its frame, else its collision shapes; empty if it has none [m]."""
        solids = self.visuals[link] or self.collisions[link]
        return np.concatenate([np.zeros((0, 3, 3)), *(s.triangles for s in solids)])

    def at_rest(self, links: frozenset[str]) -> Float[np.ndarray, "F 3 3"]:
        """Return the surface of several links in the root's frame [m]."""
        triangles = [np.zeros((0, 3, 3))]
        for link in sorted(links):
            T = self.places[link]
            triangles.append(self.shown(link) @ T[:3, :3].T + T[:3, 3])
        return np.concatenate(triangles)

    @cached_property
    def diagonal(self) -> float:
        """Diagonal of the whole object's box at rest [m]; 0 if it has no shape."""
        points = self.at_rest(frozenset(link.name for link in self.robot.links)).reshape(-1, 3)
        return float(np.linalg.norm(np.ptp(points, axis=0))) if len(points) else 0.0


def read_content(robot: Robot) -> Content:
    """Read every mesh once. References may lead anywhere below the description's folder, or above it for package://."""
    missing: list[tuple[str, str]] = []
    unread: list[tuple[str, str]] = []
    known: dict[str, tuple[Mesh, tuple[str, ...]] | None] = {}
    folder = robot.path.parent

    def solid(link: str, shape: Geometry) -> Solid | None:
        if shape.triangles is not None:
            return Solid(shape.file or shape.kind, shape.triangles)
        if shape.file is None:
            return Solid(shape.kind, shape_triangles(shape))
        if shape.file not in known:
            mesh_path = find_file(shape.file, folder)
            try:
                known[shape.file] = None if mesh_path is None else _read(mesh_path, folder)
            except InputError as error:
                known[shape.file] = None
                unread.append((link, str(error)))
            if mesh_path is None:
                missing.append((link, shape.file))
        content = known[shape.file]
        if content is None:
            return None
        mesh = content[0].transformed(shape.T_link_shape @ np.diag([*shape.scale, 1.0]))  # turns faces of a mirrored mesh
        return Solid(shape.file, mesh.triangles, mesh, content[1])

    def solids(link: str, shapes: tuple[Geometry, ...]) -> tuple[Solid, ...]:
        return tuple(s for shape in shapes if (s := solid(link, shape)) is not None)

    visuals = {b.name: solids(b.name, b.visuals) for b in robot.links}
    collisions = {b.name: solids(b.name, b.collisions) for b in robot.links}
    return Content(robot, visuals, collisions, tuple(missing), tuple(unread))


def _read(path: Path, folder: Path) -> tuple[Mesh, tuple[str, ...]]:
    inside = path.parent.resolve().is_relative_to(folder.resolve())
    return read_in_metres(path, folder if inside else path.parent.parent)


def rigid_groups(robot: Robot) -> dict[str, frozenset[str]]:
    """Map each link to the links that are rigidly connected to it, including itself."""
    group = {link.name: {link.name} for link in robot.links}
    for joint in robot.joints:
        if joint.type == "fixed":
            merged = group[joint.parent] | group[joint.child]
            for name in merged:
                group[name] = merged
    return {name: frozenset(names) for name, names in group.items()}


def joined(robot: Robot) -> frozenset[frozenset[str]]:
    """Return the pairs of links that are in the same rigid group, or whose groups are connected by a joint.

    Links without shapes between two joints, as joints with several axes are written, do not separate groups.
    """
    group = rigid_groups(robot)
    shaped = {link.name for link in robot.links if link.visuals or link.collisions}
    above = {name: j for j in robot.joints if j.type != "fixed" for name in group[j.child]}
    pairs = {frozenset((a, b)) for names in group.values() for a in names for b in names}
    for joint in robot.joints:
        parent, seen = joint.parent, 0
        while not group[parent] & shaped and parent in above and seen < len(robot.joints):
            parent, seen = above[parent].parent, seen + 1
        pairs |= {frozenset((a, b)) for a in group[parent] for b in group[joint.child]}
    return frozenset(pairs)


def siblings(robot: Robot, a: str, b: str) -> bool:
    """Return whether one joint each places two links relative to a common one, and no other joint does."""
    group = rigid_groups(robot)
    above = {name: j.parent for j in robot.joints if j.type != "fixed" for name in group[j.child]}
    return a in above and b in above and group[above[a]] == group[above[b]]
