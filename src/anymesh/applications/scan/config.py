"""Validated options of a scan."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypedDict

import numpy as np

from anymesh.errors import OptionError

FINEST = 0.0002  # [m] smallest voxel; finer than any depth camera resolves


class Options(TypedDict, total=False):
    """Options of `scan`; see `ScanConfig`."""

    voxel: float | None
    scale: float | None
    depth_scale: float | None
    depth_max: float
    crop: tuple[float, ...] | None
    keep_floor: bool
    faces: int
    seed: int


@dataclass(frozen=True)
class ScanConfig:
    """Options of a scan.

    voxel: [m], None for automatic; scale: metres per unit of the poses; depth_scale: metres per unit of the depth maps (both
    None: as defined by the layout); depth_max: [m], larger depth is ignored; crop: x0, y0, z0, x1, y1, z1 [m] in the world of
    the recording; keep_floor: do not detect and cut off the floor; faces: approximate number of faces after simplification;
    seed: of the floor detection. Raise OptionError for a value that is not valid.
    """

    voxel: float | None = None
    scale: float | None = None
    depth_scale: float | None = None
    depth_max: float = 5.0
    crop: tuple[float, ...] | None = None
    keep_floor: bool = False
    faces: int = 100_000
    seed: int = 0

    def __post_init__(self) -> None:
        for name, value in (("voxel", self.voxel), ("scale", self.scale), ("depth-scale", self.depth_scale)):
            if value is not None and not (np.isfinite(value) and value > 0):
                raise OptionError(f"--{name}: found {value}; valid are numbers above 0")
        if self.voxel is not None and self.voxel < FINEST:
            raise OptionError(f"--voxel: found {self.voxel} m; valid are {FINEST} m and more")
        if not self.depth_max > 0:
            raise OptionError(f"--depth-max: found {self.depth_max}; valid are metres above 0")
        if self.faces < 1000:
            raise OptionError(f"--faces: found {self.faces}; valid are 1000 and more")
        if self.seed < 0:
            raise OptionError(f"--seed: found {self.seed}; valid are integers from 0 up")
        if self.crop is not None and len(self.crop) != 6:
            raise OptionError(f"--crop: found {len(self.crop)} numbers; valid are six: x0,y0,z0,x1,y1,z1 [m]")
