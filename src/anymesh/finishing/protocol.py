"""Interface between Stage C and completers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Asset, Brief


@dataclass(frozen=True, eq=False)
class PartMesh(Brief):
    """The surface of one part. vertices: (V, 3) [m, asset frame at rest]; faces: (F, 3) into them, wound outwards."""

    vertices: Float[np.ndarray, "V 3"]
    faces: Int[np.ndarray, "F 3"]

    def __post_init__(self) -> None:
        if not np.isfinite(self.vertices).all():
            raise ValueError("vertices of a completed part must be finite")
        if len(self.faces) and (self.faces.min() < 0 or self.faces.max() >= len(self.vertices)):
            raise ValueError(
                f"faces of a completed part must lie in 0..{len(self.vertices) - 1}, found "
                f"{int(self.faces.min())}..{int(self.faces.max())}"
            )

    @property
    def triangles(self) -> Float[np.ndarray, "F 3 3"]:
        """Corner positions of every face."""
        return self.vertices[self.faces]


@runtime_checkable
class Completer(Protocol):
    """Protocol of a completer of an asset's parts, such as a generative model."""

    @property
    def name(self) -> str:
        """Name in notes and reports."""
        ...

    def complete(self, asset: Asset) -> Mapping[str, PartMesh]:
        """Return part name -> its whole surface; omitted parts stay as they are. Raise AnymeshError without a result."""
        ...


@dataclass(frozen=True, eq=False)
class Finished(Brief):
    """An asset with new faces.

    source_face: (F,) index of the face before, -1 for new faces; notes: part name -> what was done, in words. A part without
    notes is unchanged.
    """

    asset: Asset
    source_face: Int[np.ndarray, " F"]
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)


@dataclass(frozen=True)
class ShapeConfig:
    """Settings of the built-in shape completer (paper, 3.4). Lengths are shares of the object's diagonal unless stated."""

    watertight: bool = True  # also close surfaces that no motion uncovers
    wall: float = 0.02  # thickness given to open shells, inwards; furniture boards have 1.5 %, appliance walls 2 to 4 %
    sheet: float = 0.001  # the same if both sides are visible: the visible surface must not move
    clearance: float = 0.002  # left between parts that move against each other
    plate: float = 0.35  # maximum thickness over width of a door, drawer front, lid or board; others are shells
    flat: float = 0.02  # share of its size by which a hole's border may leave a plane
    shown: float = 0.1  # minimum share of visible points for a side, or for the cover of a hole, to count as visible
    drawer_height: float = 0.8  # of a drawer's box, as a share of the free height behind its front
    drawer_keep: float = 0.1  # share of a drawer's depth that stays inside when it is open
