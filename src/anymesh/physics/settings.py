"""Settings of mass and inertia, with their units."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class InertiaConfig:
    """Physical properties that a mesh does not state."""

    density: float = 500.0  # [kg/m^3] of closed solids of unknown material; low enough for solids that are really hollow
    shell_density: float = 700.0  # [kg/m^3] of the material of open shells; close to chipboard and plastics
    shell_thickness: float = 0.005  # [m] of open shells
    shell_share: float = 0.02  # of the link's diagonal: maximum thickness of shells, since small objects have thin walls
    smallest_mass: float = 1e-3  # [kg] minimum mass, since lighter links make solvers stiff
    smallest_moment: float = 1e-9  # [kg m^2] minimum principal moment
    moment_ratio: float = 1e-3  # of the largest principal moment: minimum of the others

    def wall(self, diagonal: float) -> float:
        """Return the wall thickness [m] of an open link with a diagonal [m]."""
        return min(self.shell_thickness, self.shell_share * diagonal)
