"""Interface between Stage C and completers."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol, runtime_checkable

import numpy as np
from jaxtyping import Float, Int

from anymesh.types import Asset


@dataclass(frozen=True, eq=False)
class PartMesh:
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
class Finished:
    """An asset with new faces.

    source_face: (F,) index of the face before, -1 for new faces; notes: part name -> what was done, in words. A part without
    notes is unchanged.
    """

    asset: Asset
    source_face: Int[np.ndarray, " F"]
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
