"""Mass, center of mass and inertia of a link from its triangles, always physically valid."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from jaxtyping import Float, Int

from anymesh.geometry.topology import components
from anymesh.physics.substances import Substance
from anymesh.types import Brief
from anymesh.types.triangles import face_cross, unshared

WALLS = (0.5, 2.0)  # least and most of a wall's thickness relative to the one taken; an estimate
UNKNOWN = (0.2, 3.0)  # the same of the mass of a component of unknown material; an estimate


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
class Inertia(Brief):
    """Mass properties of a link.

    mass [kg]; center: center of mass [m]; tensor: about it, symmetric [kg m^2]; spread: least and greatest mass over it;
    wall: mean thickness of the walls of closed components that are hollow, 0 without any [m].
    """

    mass: float
    center: Float[np.ndarray, " 3"]
    tensor: Float[np.ndarray, "3 3"]
    spread: tuple[float, float] = (1.0, 1.0)
    wall: float = 0.0

    def scaled(self, factor: float, config: InertiaConfig) -> Inertia:
        """Return the properties with a multiple of the mass, which is then known."""
        light = replace(config, smallest_mass=0.0)
        return replace(physical(replace(self, mass=self.mass * factor, tensor=self.tensor * factor), light), spread=(1.0, 1.0))


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
    body, sheet_density, closed, spread, walls = _densities(
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
    least, most = (filled + sheet) @ spread[surface_components.label] / mass
    thickness = walls[surface_components.label]
    mean = float(thickness @ areas / max(areas[thickness > 0].sum(), 1e-300))
    return Inertia(mass, center + base, (tensor + tensor.T) / 2, (float(least), float(most)), mean)


def _densities(
    label: np.ndarray,
    areas: np.ndarray,
    volume: np.ndarray,
    closed: np.ndarray,
    wall: float,
    config: InertiaConfig,
    made_of: MadeOf | None,
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Return for each component its density [kg/m^3], the area density of its shell [kg/m^2], if it is solid, its spread.

    The last are the walls of closed components that are hollow, else 0 [m].
    """
    count = len(volume)
    body, sheet, solid = np.full(count, config.density), np.full(count, config.shell_density * wall), closed.copy()
    spread, walls = np.tile(UNKNOWN, (count, 1)), np.zeros(count)
    if made_of is None or not any(made_of):
        return body, sheet, solid, spread, walls
    substances, number = numbered(made_of)
    kinds = sorted((m for m in substances if m is not None), key=lambda m: (m.density, m.solid_to, m.sheet, m.name))
    number = np.array([len(kinds) if m is None else kinds.index(m) for m in substances])[number]
    covered = np.zeros((count, len(kinds) + 1))
    np.add.at(covered, (label, number), areas)
    area = np.maximum(covered.sum(1), 1e-300)
    for k in np.flatnonzero(covered.argmax(1) < len(kinds)):
        substance = kinds[int(covered[k].argmax())]
        body[k], sheet[k] = substance.density, substance.density * min(substance.sheet, wall)
        if 2 * volume[k] / area[k] > substance.solid_to:  # the area includes both sides of the wall
            solid[k], sheet[k], walls[k] = False, substance.density * substance.sheet, substance.sheet * closed[k]
        spread[k] = np.array([1 - substance.spread, 1 + substance.spread]) * (1.0 if solid[k] else WALLS)
    return body, sheet, solid, spread, walls


def numbered(made_of: MadeOf) -> tuple[list[Substance | None], Int[np.ndarray, " n"]]:
    """Return the substances, the first met first, and the number of each item's among them."""
    _, first, rank = np.unique(np.fromiter(map(id, made_of), np.int64), return_index=True, return_inverse=True)
    kinds = list(dict.fromkeys(made_of[k] for k in np.sort(first)))
    return kinds, np.array([kinds.index(made_of[k]) for k in first], np.int64)[rank]


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
    return replace(body, mass=mass, tensor=(tensor + tensor.T) / 2)
