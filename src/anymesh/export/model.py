"""Input of all format writers: links with inertia and collision shapes, joints, and a base."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from jaxtyping import Int

from anymesh.export.links import Link
from anymesh.physics.inertia import Inertia
from anymesh.types import Asset, Hull, Shape

FOLDER = "meshes"


class Base(StrEnum):
    """Whether the root link is fixed to the world or moves freely in it."""

    FIXED = "fixed"
    FREE = "free"


class Driven(StrEnum):
    """Whether drives leave joints passive, or move them to a commanded position."""

    PASSIVE = "passive"
    POSITION = "position"


@dataclass(frozen=True, eq=False)
class ExportLink:
    """A link with its physical properties.

    shapes: convex collision shapes, in the link frame.
    """

    link: Link
    inertia: Inertia
    shapes: tuple[Shape, ...]

    @property
    def name(self) -> str:
        return self.link.name

    def visual_path(self) -> str:
        """Return the path relative to the asset folder, with forward slashes."""
        return f"{FOLDER}/{self.name}.obj"

    def faces_path(self) -> str:
        """Return the path of the link's face indices in the source (an int64 .npy), relative to the asset folder."""
        return f"{FOLDER}/{self.name}.faces.npy"

    def source_faces(self, source_face: Int[np.ndarray, " F"] | None) -> Int[np.ndarray, " n"]:
        """Return the source-file indices of the link's faces, without those added by Stage C."""
        if source_face is None:
            return self.link.faces
        faces = source_face[self.link.faces]
        return faces[faces >= 0]

    def hull_paths(self) -> tuple[str | None, ...]:
        """Return a path relative to the asset folder for each shape; None for boxes and cylinders, which need no file."""
        hulls = sum(isinstance(s, Hull) for s in self.shapes)
        paths: list[str | None] = []
        for shape in self.shapes:
            number = f"_{len(paths) - paths.count(None)}" if hulls > 1 else ""
            paths.append(f"{FOLDER}/{self.name}_collision{number}.obj" if isinstance(shape, Hull) else None)
        return tuple(paths)


@dataclass(frozen=True)
class Exclusion:
    """Two links whose contact engines should ignore, and why."""

    a: str
    b: str
    why: str


@dataclass(frozen=True, eq=False)
class Model:
    """An asset with legal names, ready for export.

    bodies: in the order of the parts, the root first.
    """

    asset: Asset
    bodies: tuple[ExportLink, ...]
    base: Base = Base.FIXED
    exclusions: tuple[Exclusion, ...] = ()
    driven: Driven = Driven.PASSIVE

    @property
    def links(self) -> Sequence[Link]:
        return tuple(body.link for body in self.bodies)
