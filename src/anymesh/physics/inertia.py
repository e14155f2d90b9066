"""Mass, center of mass and inertia of a link from its triangles, always physically valid.

Densities follow from the words of a material's name. Steel, aluminium, brass, bronze, copper, iron, glass, stone, concrete,
rubber, water and oak are within the ranges of the table of mass densities in Gere, Mechanics of Materials (5th edition). The
others are rounded typical values, and vary by a tenth and more. The maximum thickness of solid components, and the wall
thickness of thicker ones, are estimates from typical household objects.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from jaxtyping import Float

from anymesh.geometry.topology import components
from anymesh.types.triangles import face_cross, unshared

DENSITIES = {  # [kg/m^3] by the thickness of solids and of walls [m]: those of `Substance`
    (0.015, 0.0012): {
        "steel": 7850, "stainless": 7900, "inox": 7900, "iron": 7200, "metal": 7850, "chrome": 7850,
        "aluminium": 2700, "aluminum": 2700, "brass": 8500, "bronze": 8800, "copper": 8900, "zinc": 7140,
        "silver": 10490, "gold": 19300,
    },
    (0.012, 0.003): {"plastic": 1050, "abs": 1050, "acrylic": 1180, "pvc": 1380, "nylon": 1140},
    (0.08, 0.016): {
        "wood": 650, "oak": 720, "pine": 510, "walnut": 640, "beech": 720, "birch": 650, "maple": 700, "bamboo": 700,
        "plywood": 600, "mdf": 750, "chipboard": 680,
    },
    (0.04, 0.006): {"ceramic": 2300, "porcelain": 2400, "clay": 1900, "tile": 2200},
    (float("inf"), 0.01): {
        "stone": 2600, "marble": 2700, "granite": 2700, "concrete": 2400, "brick": 1900, "cork": 200, "fabric": 300,
        "cloth": 300, "foam": 40, "cushion": 60, "paper": 750, "water": 1000, "ice": 917,
    },
    (0.012, 0.004): {"glass": 2500, "mirror": 2500},
    (0.02, 0.004): {"rubber": 1100},
    (0.004, 0.002): {"leather": 860},
    (0.01, 0.004): {"cardboard": 690},
}  # fmt: skip


@dataclass(frozen=True)
class Substance:
    """Density and wall thickness of a material.

    density [kg/m^3]; solid_to: a closed component with a greater mean thickness [m] is hollow; sheet: thickness of the walls of
    hollow components and open shells [m].
    """

    density: float
    solid_to: float
    sheet: float


SUBSTANCES = {
    name: Substance(float(density), *thickness) for thickness, named in DENSITIES.items() for name, density in named.items()
}


def substance_of(name: str) -> Substance | None:
    """Return the substance of a material from the last known word of its name ("Black_Steel.001" is steel), else None."""
    words = re.findall(r"[A-Z]?[a-z]+|[A-Z]+(?![a-z])", name)
    known = [SUBSTANCES[w.lower()] for w in words if w.lower() in SUBSTANCES]
    return known[-1] if known else None


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


MadeOf = Sequence[Substance | None]


@dataclass(frozen=True, eq=False)
class Inertia:
    """Mass properties of a link. mass [kg]; center: center of mass [m]; tensor: about it, symmetric [kg m^2]."""

    mass: float
    center: Float[np.ndarray, " 3"]
    tensor: Float[np.ndarray, "3 3"]


def link_inertia(triangles: Float[np.ndarray, "n 3 3"], config: InertiaConfig, made_of: MadeOf | None = None) -> Inertia:
    """Return the mass properties of a link: closed components are solids, open ones shells, overlaps are added.

    made_of: the substance of each triangle, None if unknown.

    The result is made physically valid: the mass has a minimum, and principal moments are positive, each at most the sum of the
    other two.
    """
    return physical(raw_inertia(triangles, config, made_of), config)


def raw_inertia(triangles: Float[np.ndarray, "n 3 3"], config: InertiaConfig, made_of: MadeOf | None = None) -> Inertia:
    """Return the exact integrals over solids and shells.

    Solids are sums of signed tetrahedra, where inside-out ones count as positive. A closed component that is thicker than solid
    objects of its substance is treated as hollow.
    """
    corners = triangles.reshape(-1, 3)
    base = corners.mean(0)  # near the link, so that large coordinates lose no digits
    t = triangles - base
    cross = face_cross(t)
    volumes = np.einsum("ij,ij->i", t[:, 0], cross) / 6
    areas = np.linalg.norm(cross, axis=1) / 2
    surface_components = components(*unshared(triangles))
    volume = np.bincount(surface_components.label, volumes, surface_components.count)
    flat = np.abs(volume) <= 1e-9 * np.bincount(surface_components.label, np.abs(volumes), surface_components.count)
    wall = config.wall(float(np.linalg.norm(np.ptp(corners, axis=0))))
    body, sheet_density, closed = _densities(
        surface_components.label, areas, np.abs(volume), surface_components.solid & ~flat, wall, config, made_of
    )
    solid = closed[surface_components.label]
    filled = np.where(solid, (body * np.sign(volume))[surface_components.label] * volumes, 0.0)
    sheet = np.where(solid, 0.0, sheet_density[surface_components.label] * areas)
    mass = float(filled.sum() + sheet.sum())
    if mass <= 0:
        return Inertia(0.0, base, np.zeros((3, 3)))
    # Over a tetrahedron with the base: x -> sum / 4, x x^T -> (.. + ..) / 20; over a triangle: / 3 and / 12.
    total = t.sum(1)
    center = (total * (filled / 4 + sheet / 3)[:, None]).sum(0) / mass
    weights = filled / 20 + sheet / 12
    second = np.einsum("n,nki,nkj->ij", weights, t, t) + np.einsum("n,ni,nj->ij", weights, total, total)
    covariance = second - mass * np.outer(center, center)
    tensor = np.trace(covariance) * np.eye(3) - covariance
    return Inertia(mass, center + base, (tensor + tensor.T) / 2)


def _densities(
    label: np.ndarray,
    areas: np.ndarray,
    volume: np.ndarray,
    closed: np.ndarray,
    wall: float,
    config: InertiaConfig,
    made_of: MadeOf | None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return for each component its density [kg/m^3], the area density of its shell [kg/m^2], and whether it is solid."""
    count = len(volume)
    body, sheet, solid = np.full(count, config.density), np.full(count, config.shell_density * wall), closed.copy()
    if made_of is None or not any(made_of):
        return body, sheet, solid
    kinds = sorted({m for m in made_of if m is not None}, key=lambda m: (m.density, m.solid_to, m.sheet))
    number = np.array([len(kinds) if m is None else kinds.index(m) for m in made_of])
    covered = np.zeros((count, len(kinds) + 1))
    np.add.at(covered, (label, number), areas)
    area = np.maximum(covered.sum(1), 1e-300)
    for k in np.flatnonzero(covered.argmax(1) < len(kinds)):
        substance = kinds[int(covered[k].argmax())]
        body[k], sheet[k] = substance.density, substance.density * min(substance.sheet, wall)
        if 2 * volume[k] / area[k] > substance.solid_to:  # the area includes both sides of the wall
            solid[k], sheet[k] = False, substance.density * substance.sheet
    return body, sheet, solid


def physical(body: Inertia, config: InertiaConfig) -> Inertia:
    """Return the closest mass properties that a simulator accepts, with the same center and principal axes."""
    mass = max(body.mass, config.smallest_mass)
    tensor = body.tensor * (mass / body.mass) if body.mass > 0 else body.tensor
    moments, axes = np.linalg.eigh(tensor)
    moments = np.maximum(moments, max(config.smallest_moment, config.moment_ratio * float(moments.max())))
    # A flat link just meets the bound; the margin is for rounding.
    short = moments[2] * (1 + 1e-6) - (moments[0] + moments[1])
    if short > 0:
        moments[:2] += short / 2
    tensor = (axes * moments) @ axes.T
    return Inertia(mass, body.center, (tensor + tensor.T) / 2)
