"""Numbers of the collision shapes. Lengths are shares of the object's diagonal unless said."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class CollisionConfig:
    """How near shapes are to the surface, and what counts as a contact that should not be."""

    gaps: tuple[float, ...] = (0.02, 0.006)  # a shape may stand off the surface; the next where contacts ask for it
    pieces: tuple[int, ...] = (24, 64)  # of an open component, at most, at each of these
    wall: float = 0.002  # thickness of open shells, and at most `wall_most`
    wall_most: float = 0.005  # [m]
    contact: float = 1e-4  # shapes deeper in each other than this touch; engines push them apart
    crossing: float = 0.003  # surfaces that go this deep through each other collide in truth: sweeps allow as much
    poses: int = 17  # of each joint over its range
    rounds: int = 10  # of planing and refining
    seconds: float = 5.0  # [s] of processor time for one division of one component; then the next method is tried
    most_components: int = 150  # per link with shapes of their own; smaller ones beyond them share hulls
