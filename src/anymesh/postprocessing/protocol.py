"""What Stage C takes from whoever completes shapes, and what it gives."""

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
    """Whoever completes the shapes of an asset's parts, such as a generative model."""

    @property
    def name(self) -> str:
        """As in notes and reports."""
        ...

    def complete(self, asset: Asset) -> Mapping[str, PartMesh]:
        """Part name -> its whole surface; a part that is left out stays as it is. AnymeshError where nothing comes back."""
        ...


@dataclass(frozen=True, eq=False)
class Finished:
    """An asset with new faces. source_face: (F,) the face's number before, -1 where it is new; notes: part name -> what was
    done, in words; a part without notes was left as it was."""

    asset: Asset
    source_face: Int[np.ndarray, " F"]
    notes: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
