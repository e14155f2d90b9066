"""Settings of the export, with their units."""

from __future__ import annotations

from dataclasses import dataclass, field

from anymesh.physics.collision import CollisionConfig
from anymesh.physics.inertia import InertiaConfig


@dataclass(frozen=True)
class ExportConfig(InertiaConfig):
    """Physical properties that a mesh does not state, and sizes in the output."""

    collision: CollisionConfig = field(default_factory=CollisionConfig)
    seconds_a_way: float = 2.0  # [s] of the animation: from rest to one limit and back
    degrees_a_key: float = 15.0  # [deg] maximum angle between two rotation keys; slerp is unique below 180
