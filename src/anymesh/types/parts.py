"""Parts: faces that belong to one link."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from jaxtyping import Int


@dataclass(frozen=True)
class Part:
    """One rigid part.

    label: standard term ("door", "knob"); name: unique link name.
    """

    name: str
    label: str
    confidence: float = 1.0  # 0..1, that this is a separate part
    reason: str = ""  # evidence in words

    def __post_init__(self) -> None:
        if not self.name:
            raise ValueError("a part needs a name")
        if not 0 <= self.confidence <= 1:
            raise ValueError(f"part {self.name!r}: confidence must lie in 0..1, found {self.confidence}")


@dataclass(frozen=True, eq=False)
class Segmentation:
    """Result of Stage A: one part index per face. Part 0 is the root (the base) and always exists.

    face_part: (F,) index into parts.
    """

    face_part: Int[np.ndarray, " F"]
    parts: tuple[Part, ...]

    def __post_init__(self) -> None:
        if not self.parts:
            raise ValueError("a segmentation needs at least the root part")
        names = [p.name for p in self.parts]
        if len(set(names)) != len(names):
            raise ValueError(f"part names must be unique, found {sorted(n for n in names if names.count(n) > 1)}")
        least, most = int(self.face_part.min()), int(self.face_part.max())
        if least < 0 or most >= len(self.parts):
            raise ValueError(f"face_part must lie in 0..{len(self.parts) - 1}, found {least if least < 0 else most}")
        missing = [p.name for i, p in enumerate(self.parts) if not (self.face_part == i).any()]
        if missing:
            raise ValueError(f"parts without faces: {missing}")

    def faces(self, part: int) -> Int[np.ndarray, " n"]:
        """Return the face indices of one part."""
        return np.flatnonzero(self.face_part == part)
