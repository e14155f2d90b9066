"""Settings of the collision shapes. Lengths are relative to the object's diagonal unless stated otherwise."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class CollisionConfig:
    """Accuracy of shapes, and thresholds of false contacts."""

    # maximum distance of a shape from the surface; the next value is used at false contacts
    gaps: tuple[float, ...] = (0.02, 0.006)
    pieces: tuple[int, ...] = (24, 64)  # maximum number of pieces of an open component at each of these
    wall: float = 0.002  # thickness of open shells, at most `wall_most`
    wall_most: float = 0.005  # [m]
    contact: float = 1e-4  # penetration from which shapes touch; engines push them apart
    crossing: float = 0.003  # penetration from which surfaces really collide; sweeps tolerate the same
    poses: int = 17  # poses of each joint over its range
    rounds: int = 10  # rounds of trimming and refinement
    seconds: float = 20.0  # [s] processor time for one division of one component; then the next method is tried
    most_components: int = 150  # components per link with separate shapes; the smaller ones beyond share hulls
