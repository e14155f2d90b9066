"""Numbers of the export, once, with their units."""

from __future__ import annotations

from dataclasses import dataclass, field

from anymesh.collision.settings import CollisionConfig


@dataclass(frozen=True)
class ExportConfig:
    """Physics that a mesh does not tell, and sizes of what is written."""

    density: float = 500.0  # [kg/m^3] of closed solids of no known material; low enough for those that are hollow in truth
    shell_density: float = 700.0  # [kg/m^3] of the material of open shells; chipboard and plastics lie near
    shell_thickness: float = 0.005  # [m] of open shells
    shell_share: float = 0.02  # of the link's diagonal; no shell is thicker, since small objects have thin walls
    smallest_mass: float = 1e-3  # [kg] lighter links make solvers stiff
    smallest_moment: float = 1e-9  # [kg m^2]
    moment_ratio: float = 1e-3  # no principal moment below this share of the largest
    collision: CollisionConfig = field(default_factory=CollisionConfig)
    seconds_a_way: float = 2.0  # [s] of the animation: rest to one limit and back
    degrees_a_key: float = 15.0  # [deg] no two rotation keys further apart; slerp is unique below 180

    def wall(self, diagonal: float) -> float:
        """Thickness [m] of the walls of an open link with a diagonal [m]."""
        return min(self.shell_thickness, self.shell_share * diagonal)
